// [[joint]]: two channels whose muscles pull one lever against each other, or one channel whose
// muscle pulls against a spring or gravity.
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
void read_pull(Section& section, const BoardSettings& board, JointSettings& joint,
               JointLabel& label);

/// weight_Nm and hangs_at_deg.
void read_weight(Section& section, PlaceInJoint& joint);
/// Refuses an arm that nothing draws back, or whose muscle is described without the weight. number:
/// the channel's, from 1.
void refuse_weight(Section& section, const ChannelSettings& channel, std::size_t number);

/// Read in two steps: a joint's channels must be known before they are read; what their muscles may
/// get can be checked only afterwards.
class JointReader {
 public:
  /// channels: how many the board has.
  JointReader(std::vector<Section> sections, std::size_t channels);

  /// The agonist of the joint in which this channel is the antagonist; both from 0.
  std::optional<std::size_t> agonist_of(std::size_t channel) const;
  /// The place of any channel in its joint.
  PlaceInJoint place_of(std::size_t channel) const;
  /// How far the joint's range_deg lets this channel's muscle contract; empty: it has none.
  std::optional<double> max_travel_m(std::size_t channel) const;
  /// A joint's channels or its range are wrong: that may be why a channel lacks something.
  bool is_wrong() const { return is_wrong_; }
  /// Call it after reading the channels. Finishes the sections.
  void finish(BoardConfig& config);

 private:
  struct Read {
    Section section;
    std::optional<JointSettings> pair{};     ///< empty: one muscle turns it, or it is wrong
    std::optional<JointTravel> travel{};     ///< empty: from the limits of its channels
    std::optional<std::size_t> turned_by{};  ///< the channel that turns it alone
    PlaceInJoint alone{};                    ///< of that channel
    control::Lever lever{};
  };
  void read(Read& joint, std::size_t channels);
  std::optional<std::size_t> read_place(Section& section, const char* key, std::size_t channels);

  std::vector<Read> joints_;
  bool is_wrong_ = false;
  std::vector<std::size_t> taken_;  ///< channels that are in a joint
};

}  // namespace supercoil::config
