// [[bundle]]: channels whose muscles pull together, with a heater each.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "config/board_config.hpp"
#include "config/read_joint.hpp"
#include "config/section.hpp"

namespace supercoil::config {

/// Read in two steps, as JointReader does.
class BundleReader {
 public:
  /// channels: how many the board has. None may be in a joint.
  BundleReader(std::vector<Section> sections, std::size_t channels, const JointReader& joints);

  /// The channel that leads the bundle in which this one follows; both from 0.
  std::optional<std::size_t> leader_of(std::size_t channel) const;
  /// A bundle's channels are wrong: that may be why a channel lacks something.
  bool is_wrong() const { return is_wrong_; }
  /// Call it after reading the channels. Finishes the sections.
  void finish(BoardConfig& config);

 private:
  struct Read {
    Section section;
    BundleSettings bundle;  ///< no channels: the table is wrong
  };
  std::vector<std::size_t> read_channels(Section& section, std::size_t channels,
                                         const JointReader& joints);

  std::vector<Read> bundles_;
  std::vector<std::size_t> taken_;  ///< channels that are in a bundle
  bool is_wrong_ = false;
};

}  // namespace supercoil::config
