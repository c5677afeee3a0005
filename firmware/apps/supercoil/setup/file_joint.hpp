// The joint that a channel's muscle turns, as far as an incomplete board file tells it.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "supercoil/control/joint/lever.hpp"

#include "apps/supercoil/setup/describe_muscle.hpp"

namespace supercoil::operating {

struct FileJoint {
  std::size_t place = 0;  ///< index among [[joint]]
  bool agonist = true;
  bool has_other = true;  ///< another muscle opposes this one
  control::Lever lever{};
  /// How far it may turn back and forth; empty: its channels' limits determine it.
  std::optional<std::array<double, 2>> range_deg;

  /// How far range_deg lets this muscle contract.
  double max_travel_m() const;
  /// range_deg with this muscle's side changed. Never wider than travel_m.
  std::string range_literal(double travel_m) const;
};

/// text: valid TOML. channel: from 1. Empty: its muscle turns no joint, or the joint's entries are
/// wrong.
std::optional<FileJoint> joint_in_file(const std::string& text, int channel);

/// The key that reduces a muscle's travel: its channel's or, where that is the bound, range_deg of
/// its joint. Empty: range_deg already allows no more than that.
std::optional<Entry> travel_entry(const std::string& text, int channel, double travel_m,
                                  const std::string& literal, const std::string& reason);

}  // namespace supercoil::operating
