// [[joint]]: two channels whose muscles pull one lever against each other.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "config/board_config.hpp"
#include "config/read_lever.hpp"
#include "config/section.hpp"

namespace supercoil::config {

/// max_pull_N and pretension_N. Refuses a joint whose co-contraction may exceed what a muscle
/// bears. joint: with its co-contraction.
void read_pull(Section& section, const BoardSettings& board, const JointSettings& joint,
               JointLabel& label);

/// Read in two steps: which channels a joint has must be known before they are read, and what their
/// muscles may have only afterwards.
class JointReader {
 public:
  /// channels: that the board has.
  JointReader(std::vector<Section> sections, std::size_t channels);

  /// The agonist of the joint in which this channel is the antagonist; both from 0.
  std::optional<std::size_t> agonist_of(std::size_t channel) const;
  /// Likewise, of any channel.
  PlaceInJoint place_of(std::size_t channel) const;
  /// How far the joint's range_deg lets this channel's muscle contract; empty: it has none.
  std::optional<double> max_travel_m(std::size_t channel) const;
  /// A joint's channels or its range are wrong: what a channel then lacks may come from its joint.
  bool is_wrong() const;
  /// After the channels. Finishes the sections.
  void finish(BoardConfig& config);

 private:
  /// Of a joint that a spring draws back.
  struct Turned {
    std::size_t channel;
    control::Lever lever;
  };
  void read_places(std::size_t channels);
  void read_turned(Section& section, std::size_t channels);
  std::optional<std::size_t> read_place(Section& section, const char* key, std::size_t channels);

  std::vector<Section> sections_;
  std::vector<std::optional<JointSettings>> joints_;  ///< empty: its channels are wrong, or
  std::vector<std::optional<Turned>> turned_;         ///< as many: a spring opposes its muscle
  std::vector<std::optional<JointTravel>> travels_;   ///< as many; empty: by the channels' limits
  bool has_wrong_range_ = false;
  std::vector<std::size_t> taken_;  ///< channels that are in a joint
};

}  // namespace supercoil::config
