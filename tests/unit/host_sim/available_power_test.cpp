// The power that the board's limiter leaves; the forecast computes it as the board itself does.
#include "runner/available_power.hpp"

#include <algorithm>
#include <cmath>

#include <CppUTest/TestHarness.h>

#include "supercoil/control/thermal/rise_interval_observer.hpp"

#include "runner/board_of.hpp"
#include "unit/host_sim/support/scenarios.hpp"

using namespace supercoil;
using namespace supercoil::host_sim;
using supercoil::test::read;

namespace {

/// Cold, and derated from the first kelvin on, so that every temperature affects the power.
BoardSettings derated(double max_time_constant_s) {
  BoardSettings board = firmware_of(read(""));
  ChannelSettings& channel = board.channels[0];
  channel.thermal.boot_rise_K = 0.0;
  channel.thermal.bounds.max_time_constant_s = max_time_constant_s;
  channel.limiter.derate_from_C = channel.thermal.air.warmest_C;
  channel.limiter.derate_to_C = channel.thermal.air.warmest_C + 200.0;
  return board;
}

/// The forecast agrees to the last bit, while heating and while cooling.
void check_follows_the_boards_interval(const BoardSettings& board) {
  constexpr double forecast_step_s = 5e-3;
  constexpr double measured_supply_V = 12.0;
  const ChannelSettings& channel = board.channels[0];
  AvailablePower left(board, measured_supply_V, forecast_step_s);
  control::RiseIntervalObserver interval(channel.thermal.bounds, forecast_step_s);
  const Limiter limiter(channel.limiter, forecast_step_s);
  const double max_ratio = power_bounds(channel, board).true_over_measured(measured_supply_V).max;
  double least_W = limiter.max_W();
  for (int i = 0; i < 20'000; ++i) {
    const double expected_W = limiter.max_W(channel.thermal.air.warmest_C + interval.max_K());
    DOUBLES_EQUAL(expected_W, left.now().power_W, 0.0);
    least_W = std::min(least_W, expected_W);
    const double power_W = i % 4000 < 2000 ? 2.0 : 0.1;
    left.step(power_W);
    interval.step(0.0, max_ratio * power_W);
  }
  CHECK_COMPARE(least_W, <, 0.9 * limiter.max_W());
}

}  // namespace

TEST_GROUP(AvailablePower){};

TEST(AvailablePower, FollowsTheHotEndOfTheBoardsInterval) {
  check_follows_the_boards_interval(derated(INFINITY));
}

TEST(AvailablePower, UsesTheBoardsSlowestTimeConstant) {
  check_follows_the_boards_interval(derated(2.0));
}
