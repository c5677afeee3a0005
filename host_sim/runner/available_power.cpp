#include "runner/available_power.hpp"

#include <algorithm>
#include <cmath>

#include "loop/feasibility.hpp"
#include "runner/simulation.hpp"

namespace supercoil::host_sim {

namespace {

/// Only an identified muscle has to give a proof.
double provable_W(const ChannelSettings& channel, const BoardSettings& board) {
  const bool proves = channel.supervision.proof_of_response && channel.muscle_identified;
  if (!proves) return INFINITY;
  return plan_proof(proof_settings(channel, board), channel.muscle, board.rate_Hz).provable_W;
}

control::ThermalBounds thermal_bounds(const ChannelSettings& channel) {
  return board::known_thermal_bounds(channel.thermal, channel.heat).bounds;
}

/// As in RiseIntervalObserver, if no heat transfer is known more closely at some rises.
control::BasicIntervalEnd<double> board_hot_end(control::ThermalBounds bounds, double step_s) {
  const double lowest_W_per_K = bounds.min_transfer_W_per_K;
  bounds.max_mass_J_per_K = std::clamp(lowest_W_per_K * bounds.max_time_constant_s,
                                       bounds.min_mass_J_per_K, bounds.max_mass_J_per_K);
  return control::hot_end(lowest_W_per_K, bounds, step_s);
}

/// What is left of the rise that the muscle may have had at boot.
double first_rise_K(const ChannelSettings& channel, const BoardSettings& board,
                    const control::ThermalBounds& bounds) {
  const double armable_s = feasibility(channel, board).armable_s;
  const double cooled_s = armable_s > boot_s ? armable_s + boot_s : boot_s;
  return channel.thermal.boot_rise_K * std::exp(-cooled_s / control::max_time_constant_s(bounds));
}

}  // namespace

AvailablePower::AvailablePower(const BoardSettings& board, double supply_V, double step_s)
    : limiter_(board.channels[0].limiter, step_s),
      provable_W_(provable_W(board.channels[0], board)),
      warmest_C_(board.channels[0].thermal.air.warmest_C),
      max_power_ratio_(power_bounds(board.channels[0], board).true_over_measured(supply_V).max),
      hot_(board_hot_end(thermal_bounds(board.channels[0]), step_s)),
      hottest_K_(first_rise_K(board.channels[0], board, thermal_bounds(board.channels[0]))) {}

AvailablePower::Limit AvailablePower::at(double hottest_C) const {
  // Two variables: copying a pair at each bound would stall.
  double power_W = limiter_.max_W();
  LimitedBy by = LimitedBy::maximum;
  const auto bound = [&](double bound_W, LimitedBy limit) {
    if (!(bound_W < power_W)) return;
    power_W = bound_W;
    by = limit;
  };
  bound(limiter_.max_W(hottest_C), LimitedBy::temperature);
  bound(provable_W_, LimitedBy::unproven);
  return {power_W, by};
}

}  // namespace supercoil::host_sim
