#include "apps/supercoil/setup/running_file.hpp"

#include <cmath>

#include "apps/supercoil/setup/figures.hpp"
#include "text/nearest.hpp"
#include "text/number_text.hpp"

namespace supercoil::operating {

namespace {

constexpr int file_digits = 6;

/// The key in the file for a quantity that the board tells.
std::string place_in_file(std::size_t quantity) {
  const std::string name(known_quantities[quantity]);
  if (quantity == known_max_set_point) return "limits.max_travel_m";
  if (quantity == known_configured_resistance) return "heater.cold_resistance_Ohm";
  const std::size_t prefix = name.find('_');
  if (quantity >= known_configured_bounds) return "thermal." + name.substr(prefix + 1);
  if (quantity >= known_configured_limits) return "limits." + name.substr(prefix + 1);
  if (quantity < known_joint_lever) return "muscle." + name.substr(prefix + 1);
  return "[[" + name.substr(0, prefix) + "]] " + name.substr(prefix + 1);
}

bool same(double a, double b) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
  return std::abs(a - b) <= float_rounding_ratio * std::abs(b);
}

std::string value_text(double value) {
  return std::isnan(value) ? "none" : number_text(value, file_digits);
}

}  // namespace

std::vector<std::string> differences(const KnownMuscle& board, const BoardSettings& file,
                                     std::size_t channel) {
  const ChannelSettings& c = file.channels[channel];
  const KnownMuscle expected =
      known_muscle(c.muscle, c.calibration, 0.0, 0.0, {}, configured_muscle(c, NAN));
  std::vector<std::string> all;
  for (std::size_t i = known_configured; i < known_quantities.size(); ++i) {
    // Not in the file: the first follows from the other muscle's limits, which are compared too.
    if (i == known_min_set_point || i == known_identified || same(board[i], expected[i])) continue;
    all.push_back(place_in_file(i) + " = " + value_text(expected[i]) +
                  " (the board: " + value_text(board[i]) + ")");
  }
  return all;
}

std::vector<std::size_t> heated_together(const BoardSettings& board, std::size_t channel) {
  if (const JointSettings* joint = board.joint_of(channel))
    return {joint->agonist, joint->antagonist};
  if (const BundleSettings* bundle = board.bundle_of(channel)) return bundle->channels;
  return {channel};
}

BoardLink::Answer differences_of_board(BoardLink& board, int first, const BoardSettings& file,
                                       std::size_t channel) {
  std::string all;
  for (const std::size_t one : heated_together(file, channel)) {
    const auto known = board.muscle(std::to_string(first + static_cast<int>(one)));
    if (!known) return tl::unexpected(known.error());
    const auto found = differences(*known, file, one);
    if (found.empty()) continue;
    all +=
        (all.empty() ? "channel " : "; channel ") + std::to_string(one + 1) + ": " + joined(found);
  }
  return all;
}

}  // namespace supercoil::operating
