// The joint that a channel's muscle turns, as far as a board's file tells it before it is complete.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "supercoil/control/joint/lever.hpp"

#include "apps/supercoil/setup/describe_muscle.hpp"

namespace supercoil::operating {

struct FileJoint {
  std::size_t place = 0;  ///< among [[joint]]
  bool agonist = true;
  bool has_other = true;  ///< another muscle opposes this one
  control::Lever lever{};
  /// How far it may turn back and forth; empty: the limits of its channels say it.
  std::optional<std::array<double, 2>> range_deg;

  /// How far range_deg lets this muscle contract.
  double max_travel_m() const;
  /// Of range_deg with this muscle's side changed. Never wider than travel_m.
  std::string range_literal(double travel_m) const;
};

/// text: TOML in order. channel: from 1. Empty: its muscle turns none, or what is told of it is
/// wrong.
std::optional<FileJoint> joint_in_file(const std::string& text, int channel);

/// The key that makes a muscle's travel smaller: of its channel or, where that bounds it, range_deg
/// of its joint. Empty: range_deg leaves it no more than that already.
std::optional<Entry> travel_entry(const std::string& text, int channel, double travel_m,
                                  const std::string& literal, const std::string& reason);

}  // namespace supercoil::operating
