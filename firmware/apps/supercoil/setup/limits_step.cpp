#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include <nlohmann/json.hpp>

#include "apps/common/progress.hpp"
#include "apps/supercoil/setup/channel_steps.hpp"
#include "apps/supercoil/setup/heated.hpp"
#include "apps/supercoil/setup/stall_watch.hpp"
#include "loop/feasibility.hpp"
#include "text/number_text.hpp"

namespace supercoil::operating {

namespace {

using Json = nlohmann::ordered_json;

/// With this ratio the muscle's end lags behind its power by a twentieth of the way.
constexpr double time_constants_to_rise = 20.0;
constexpr double time_constants_to_settle = 5.0;
constexpr double min_rise_s = 30.0;
/// Fraction of the rising power for each comparison by StallWatch.
constexpr double stall_step_ratio = 0.04;
/// Beyond the configured travel the board faults.
constexpr double stop_ratio = 0.97;
constexpr double report_step_ratio = 0.05;

/// Distance of the limit from where the end was.
constexpr double min_distance_m = 0.5e-3;
constexpr double distance_ratio = 0.02;
constexpr double min_limit_m = 1e-3;
/// So that the printed and the written value agree in few digits.
constexpr double limit_step_m = 1e-5;
constexpr double min_limit_noises = 2.0;

constexpr double first_position_s = 1.0;
constexpr int digits = 4;

constexpr Question at_limit{
    "at_limit",
    "1: its end has come as far as it may, or touches something; 0: let go, and change nothing",
    {0.0, 1.0},
    1.0};

enum class Ending { answered, left, touched, at_travel, at_power };

std::string in_mm(double metres) {
  return number_text(1e3 * metres, digits) + " mm";
}

struct SlowPull {
  double top_W;
  double rise_s;
  double settle_s;
  double stop_m;
  double scripted_m = INFINITY;  ///< where a script answers that it has come far enough

  double power_W(double time_s) const { return top_W * std::min(1.0, time_s / rise_s); }
};

SlowPull plan_slow_pull(const ChannelSettings& channel, const BoardSettings& board) {
  const double tau_s = -1.0 / channel.muscle.thermal_pole_rad_per_s();
  // With more power the board would sooner or later reduce it, and the end would stop rising.
  return {feasibility(channel, board).held_W, std::max(min_rise_s, time_constants_to_rise * tau_s),
          time_constants_to_settle * tau_s, stop_ratio * channel.supervision.max_travel_m};
}

struct Pulled {
  double position_m;
  Ending ending;
};

double distance_m(double position_m) {
  return std::max(min_distance_m, distance_ratio * position_m);
}

double min_limit(const ChannelSettings& channel) {
  return std::max(min_limit_m, min_limit_noises * channel.supervision.position_noise_rms_m);
}

/// Waits for a person's answer; a script has answered already, and look() compares with it.
Operator::Answer wait_for_answer(BoardLink& board, const SlowPull& plan, Operator& user,
                                 const std::function<Operator::Done()>& look) {
  if (std::isinf(plan.scripted_m)) return user.ask(at_limit, look);
  for (;;) {
    if (auto goes_on = look(); !goes_on) return tl::unexpected(goes_on.error());
    board.wait(Operator::look_every);
  }
}

Result<Pulled> pull_slowly(BoardLink& board, const std::string& channel, const SlowPull& plan,
                           double noise_m, Operator& user) {
  Heated heated(board, channel, user);
  StallWatch stall(stall_step_ratio * plan.top_W, noise_m);
  double position_m = NAN;
  std::optional<Ending> ending;
  double reported_m = 0.0;
  const double begin_s = heated.time_s();
  const auto end = [&](Ending why) -> Operator::Done {
    ending = why;
    return failure("ended");
  };
  const auto look = [&]() -> Operator::Done {
    const double time_s = heated.time_s() - begin_s;
    const double power_W = plan.power_W(time_s);
    if (auto heats = heated.heat(power_W); !heats) return heats;
    const auto newest_m = board.position_m(channel);
    if (!newest_m) return tl::unexpected(newest_m.error());
    position_m = *newest_m;
    if (std::isnan(position_m)) {
      if (time_s < first_position_s) return {};
      return failure("the board reports no position");
    }
    if (position_m >= reported_m + report_step_ratio * plan.stop_m) {
      reported_m = position_m;
      user.show(in_mm(reported_m) + " at " + number_text(power_W, 3) + " W");
    }
    if (position_m >= plan.scripted_m) return end(Ending::answered);
    if (position_m >= plan.stop_m) return end(Ending::at_travel);
    if (stall.step(power_W, position_m)) return end(Ending::touched);
    return time_s < plan.rise_s + plan.settle_s ? Operator::Done() : end(Ending::at_power);
  };
  const auto answer = wait_for_answer(board, plan, user, look);
  if (answer) ending = *answer == 0.0 ? Ending::left : Ending::answered;
  if (!ending) return tl::unexpected(answer.error());
  return Pulled{position_m, *ending};
}

StepResult limit_at(double position_m, const ChannelSettings& channel, Operator& user) {
  const double kept_m = position_m - distance_m(position_m);
  const double limit_m = limit_step_m * std::floor(kept_m / limit_step_m);
  const double least_m = min_limit(channel);
  if (!(limit_m >= least_m)) {
    return failure("a limit of " + in_mm(limit_m) + " leaves no travel, less than " +
                   in_mm(least_m) + "; nothing changed");
  }
  // It pulled less far than the configured limit, so this limit is smaller.
  user.show("limit: " + in_mm(limit_m) +
            " (configured: " + in_mm(channel.supervision.max_travel_m) + ")");
  return Json{{"position_m", position_m}, {travel_key, number_text(limit_m, digits)}};
}

}  // namespace

StepResult find_travel_limit(BoardLink& board, const std::string& channel, const ChannelNow& now,
                             const BoardSettings& settings, Operator& user) {
  const ChannelSettings& configured = now.settings;
  SlowPull plan = plan_slow_pull(configured, settings);
  const double least_m = min_limit(configured);
  const auto scripted_mm =
      user.scripted({"stop_mm",
                     "position at which its end has come as far as it may, in mm",
                     {1e3 * (least_m + distance_m(least_m) + limit_step_m), 1e3 * plan.stop_m},
                     NAN});
  if (scripted_mm && !*scripted_mm) return tl::unexpected(scripted_mm->error());
  if (scripted_mm) plan.scripted_m = 1e-3 * **scripted_mm;
  user.show("pulls with a power that rises to " + number_text(plan.top_W, 3) + " W in " +
            number_text(plan.rise_s, 3) + " s, and lets go " +
            (scripted_mm ? "where the script says" : "when you answer") +
            ", when its end stops rising, at " + in_mm(plan.stop_m) + ", or after " +
            duration_text(plan.rise_s + plan.settle_s));
  const auto pulled =
      pull_slowly(board, channel, plan, configured.supervision.position_noise_rms_m, user);
  if (!pulled) return tl::unexpected(pulled.error());
  if (std::isnan(pulled->position_m)) {
    if (pulled->ending == Ending::answered) {
      return failure("answered before the board reported a position; nothing changed");
    }
    user.show("let go before the board reported a position; the limit stays");
    return Json{{"position_m", nullptr}};
  }
  const std::string where = in_mm(pulled->position_m);
  switch (pulled->ending) {
    case Ending::left:
      user.show("let go at " + where + "; the limit stays");
      return Json{{"position_m", pulled->position_m}};
    case Ending::at_travel:
      user.show("reached " + where + " and touched nothing: the limit stays");
      return Json{{"position_m", pulled->position_m}};
    case Ending::at_power:
      user.show("reaches " + where +
                " at its maximum continuous power, and touched nothing: the limit stays");
      return Json{{"position_m", pulled->position_m}};
    case Ending::touched:
      user.show("it seems to touch something at " + where);
      break;
    case Ending::answered:
      user.show("let go at " + where);
  }
  return limit_at(pulled->position_m, configured, user);
}

}  // namespace supercoil::operating
