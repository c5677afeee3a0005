#include "apps/supercoil/setup/sense_comparison.hpp"

#include <algorithm>
#include <chrono>

#include "apps/common/progress.hpp"
#include "apps/supercoil/setup/heated.hpp"
#include "board/meter_comparison.hpp"
#include "text/number_text.hpp"

namespace supercoil::operating {

namespace {

using board::MeterComparison;
/// The error: why it ended.

constexpr std::chrono::milliseconds probing{300};
/// The board requires a second at steady power; a meter needs some time too.
constexpr std::chrono::milliseconds settling{2500};
constexpr double max_question_s = 300.0;

constexpr int shown_digits = 3;

std::string shown(double value) {
  return number_text(value, shown_digits);
}

Result<void> send_reading(Heated& heated, const std::string& verb, double value) {
  auto taken = heated.ask(verb + " " + number_text(value, 9));
  if (taken) return taken;
  return failure(taken.error().text() +
                 ". This reading contradicts the others, the senses or the configured resistance; "
                 "the board has discarded them all and uses what it used before");
}

/// The questions at one power.
Result<void> compare_at(double power_W, const ComparisonPlan& plan, Heated& heated,
                        Operator& user) {
  user.show("channel " + plan.channel + " gets " + shown(power_W) + " W");
  if (auto held = heated.hold(power_W, settling); !held) return held;
  double question_s = heated.time_s();
  const auto goes_on = [&]() -> Result<void> {
    if (heated.time_s() - question_s > max_question_s) return failure("no answer within 5 minutes");
    return heated.heat(power_W);
  };
  const auto meter_V =
      user.ask({"supply_V", "volts at the supply terminals", plan.supply_V, NAN}, goes_on);
  if (!meter_V) return tl::unexpected(meter_V.error());
  if (auto taken = send_reading(heated, "compare_supply", *meter_V); !taken) return taken;
  // The measured power is the product of both senses, and each may be off by its gain.
  const double reported_A = power_W / *meter_V;
  question_s = heated.time_s();
  const std::string question = "amperes in the line of channel " + plan.channel;
  const config::Range allowed{reported_A * MeterComparison::min_gain * MeterComparison::min_gain,
                              reported_A * MeterComparison::max_gain * MeterComparison::max_gain};
  const auto meter_A = user.ask({"current_A", question, allowed, NAN}, goes_on);
  if (!meter_A) return tl::unexpected(meter_A.error());
  return send_reading(heated, "compare_current", *meter_A);
}

}  // namespace

ComparisonPlan plan_comparison(std::string channel, ChannelSettings settings,
                               const BoardSettings& board) {
  settings.senses = {};
  const double unseen = power_bounds(settings, board).true_over_measured().max;
  const double rise_K = settings.limiter.derate_from_C - settings.thermal.air.warmest_C;
  const double true_W = rise_K * 0.25 * settings.thermal.bounds.min_transfer_W_per_K;
  return {
      std::move(channel),
      rounded_down(std::min(settings.limiter.max_W, std::max(0.0, true_W) / unseen), shown_digits),
      {board.supervision.min_supply_V, board.supervision.max_supply_V}};
}

std::string describe_plan(const ComparisonPlan& plan) {
  const double settling_s = std::chrono::duration<double>(settling).count();
  return "heats it with " + shown(0.5 * plan.power_W) + " W and then " + shown(plan.power_W) +
         " W, each for " + shown(settling_s) +
         " s and then while you answer two questions, at most " + duration_text(max_question_s) +
         " each";
}

Result<board::SenseComparison> compare_senses(BoardLink& board, const ComparisonPlan& plan,
                                              Operator& user) {
  Heated heated(board, plan.channel, user);
  const auto ended = [&](const std::string& why) {
    // Looking for a fault takes so long that the command to heat would expire, and be one.
    static_cast<void>(heated.ask("rest"));
    return failure(with_present_fault(why, board, plan.channel));
  };
  if (const auto armed = heated.ask("arm"); !armed) return ended(armed.error().text());
  // The probe that follows arming must not be disturbed.
  board.wait(probing);
  for (const double part : {0.5, 1.0}) {
    if (const auto compared = compare_at(part * plan.power_W, plan, heated, user); !compared)
      return ended(compared.error().text());
  }
  auto found = board.senses(plan.channel);
  if (found && !found->compared()) return failure("the board has no comparison");
  return found;
}

std::string describe_comparison(const board::SenseComparison& found) {
  return "true over measured: supply " + number_text(found.supply_gain, 4) + ", current " +
         number_text(found.current_gain, 4) + "; " + shown(100.0 * found.error_ratio) +
         " % may remain of each";
}

std::string power_bounds_text(ChannelSettings settings, const BoardSettings& board,
                              const board::SenseComparison& senses) {
  settings.senses = senses;
  const auto ratio = power_bounds(settings, board).true_over_measured();
  return "the true power is " + shown(ratio.min) + " to " + shown(ratio.max) +
         " times the measured power; calibrate and identify this channel again";
}

}  // namespace supercoil::operating
