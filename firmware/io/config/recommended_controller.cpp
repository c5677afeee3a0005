#include "config/recommended_controller.hpp"

#include <algorithm>
#include <cmath>

#include "supercoil/control/tracking/loop_margin.hpp"

#include "loop/promise.hpp"
#include "text/number_text.hpp"

namespace supercoil::config {

namespace {

using control::ControllerKind;
using control::ControllerSettings;

constexpr ControllerKind recommended_kind = ControllerKind::learned_ff;
constexpr double max_bandwidth_rad_per_s = 8.0;
constexpr double min_bandwidth_rad_per_s = 0.01;
/// Time constant of the paper's muscle, which the controllers' defaults are meant for.
constexpr double paper_time_constant_s = 1.82;
constexpr double significant_ratio = 0.1;
constexpr int text_digits = 4;

/// The min margin, well clear of ringing (docs/control.md). Without a delay, the muscles of
/// tests/setup have it.
constexpr double min_margin = 0.4;

/// A step of a quarter of the travel, from its middle, can use twice the power that it needs in the
/// end: falling, all the power that holds the middle; rising, at least as much.
constexpr double peak_ratio = 2.0;

constexpr std::string_view closest = "follows closest";
/// A promised error above this fraction of the one in use is no reason to change the bandwidth.
constexpr double clearly_less_ratio = 0.95;
/// Fraction of the recommended bandwidth. A slower loop corrects disturbances too late, whatever it
/// promises for a motion without any.
constexpr double slow_ratio = 0.5;
/// Bandwidths that differ by less are the same in text.
constexpr double same_ratio = 0.01;

bool differ(double value, double from) {
  return !(std::abs(value / from - 1.0) <= significant_ratio);
}

control::ReferenceModelSettings model_with(double pole_rad_per_s) {
  return control::poles_model({pole_rad_per_s, pole_rad_per_s, pole_rad_per_s});
}

/// The fastest pole whose model's step stays within peak_ratio, at most `max_rad_per_s`.
double fastest_pole_rad_per_s(const control::PhysicalParameters& muscle, double max_rad_per_s) {
  const auto fits = [&](double pole_rad_per_s) {
    return peak_W_per_m(model_with(pole_rad_per_s), muscle) * muscle.dc_gain_m_per_W() <=
           peak_ratio;
  };
  if (fits(max_rad_per_s)) return max_rad_per_s;
  double slow = -1e-2 * muscle.thermal_pole_rad_per_s();
  double fast = max_rad_per_s;
  while (fast > 1.001 * slow) {
    const double between = std::sqrt(slow * fast);
    (fits(between) ? slow : fast) = between;
  }
  return slow;
}

bool has_margin(const control::PhysicalParameters& muscle, const LoopTime& time,
                double bandwidth_rad_per_s) {
  ControllerSettings controller;
  controller.kind = recommended_kind;
  controller.learned_ff.bandwidth_rad_per_s = bandwidth_rad_per_s;
  const auto margin = control::loop_margin(control::fixed_law(controller, muscle).value(), muscle,
                                           time.step_s, time.delay_s);
  return margin.stable() && margin.modulus >= min_margin;
}

/// The greatest bandwidth with that margin: a lower bandwidth has more margin.
double bandwidth_with_margin(const control::PhysicalParameters& muscle, const LoopTime& time,
                             double max_rad_per_s) {
  if (has_margin(muscle, time, max_rad_per_s)) return max_rad_per_s;
  double low = min_bandwidth_rad_per_s;
  double high = max_rad_per_s;
  while (high > 1.002 * low) {
    const double between = std::sqrt(low * high);
    (has_margin(muscle, time, between) ? low : high) = between;
  }
  return low;
}

void choose_model(const control::PhysicalParameters& muscle, RecommendedController& recommended) {
  const double fall_s = std::log(9.0) / -muscle.thermal_pole_rad_per_s();
  recommended.pole_rad_per_s = fastest_pole_rad_per_s(muscle, recommended.bandwidth_rad_per_s);
  recommended.model_reason =
      recommended.pole_rad_per_s < recommended.bandwidth_rad_per_s
          ? "as fast as a step of a quarter of the travel, up or down from the middle, allows "
            "without shaping: the muscle falls from 90 to 10 % in " +
                number_text(fall_s, 3) + " s by itself"
          : "no faster than the feedback: the muscle, which falls from 90 to 10 % in " +
                number_text(fall_s, 3) + " s by itself, would allow more";
}

/// The controller in use promises an error too: one that promises more must not be called closer.
void compare_with(const ControllerSettings& in_use, const ChannelSettings& channel,
                  const BoardSettings& board, RecommendedController& recommended) {
  if (channel.joint.has_other() || !is_promised_for(in_use, channel, board.step_s())) return;
  const FirstMotion motion =
      plan_first_motion(feasibility(channel, board), channel.unexplained_ratio);
  if (!(motion.amplitude_m > 0.0)) return;
  const auto promised_m = [&](const ControllerSettings& controller) {
    return promise_error(controller.learned_ff, channel, board, motion).error_m();
  };
  const double now_m = promised_m(in_use);
  const double then_m = promised_m(recommended.applied_to(in_use));
  if (then_m < clearly_less_ratio * now_m) return;
  const double bandwidth = in_use.learned_ff.bandwidth_rad_per_s;
  const double ratio = bandwidth / recommended.bandwidth_rad_per_s;
  if (std::abs(ratio - 1.0) < same_ratio) return;
  const std::string own = number_text(bandwidth, text_digits) + " rad/s";
  std::string why(closest);
  if (ratio >= slow_ratio && ratio < 1.0) {
    why = "promises as small an error with " + own + " as with " +
          number_text(recommended.bandwidth_rad_per_s, text_digits);
    recommended.bandwidth_rad_per_s = bandwidth;
    choose_model(channel.muscle, recommended);
  } else if (then_m > now_m) {
    why = ratio < slow_ratio ? "corrects what disturbs it sooner than " + own
                             : "leaves more room than " + own;
    why += ", which promises a smaller error";
  }
  recommended.reason.replace(0, closest.size(), why);
}

}  // namespace

std::string RecommendedController::literal() const {
  return "{ kind = \"" +
         std::string(control::name_of(control::controller_names, recommended_kind)) +
         "\", shape_reference = true, bandwidth_rad_per_s = " +
         number_text(bandwidth_rad_per_s, text_digits) + " }";
}

std::string RecommendedController::model_literal() const {
  const std::string pole = number_text(pole_rad_per_s, text_digits);
  return "{ kind = \"poles\", poles_rad_per_s = [" + pole + ", " + pole + ", " + pole + "] }";
}

ControllerSettings RecommendedController::applied_to(ControllerSettings controller) const {
  controller.kind = recommended_kind;
  controller.shape_reference = true;
  controller.learned_ff.bandwidth_rad_per_s = bandwidth_rad_per_s;
  controller.model = model_with(pole_rad_per_s);
  return controller;
}

bool RecommendedController::has_bandwidth_of(const ControllerSettings& controller) const {
  return controller.kind == recommended_kind && controller.learned_ff.bandwidth_rad_per_s <=
                                                    (1.0 + significant_ratio) * bandwidth_rad_per_s;
}

bool RecommendedController::differs_from(const ControllerSettings& controller) const {
  return controller.kind != recommended_kind || !controller.shape_reference ||
         differ(controller.learned_ff.bandwidth_rad_per_s, bandwidth_rad_per_s) ||
         std::ranges::any_of(controller.model.poles_rad_per_s,
                             [&](double pole) { return differ(pole, pole_rad_per_s); });
}

RecommendedController recommended_controller(const control::PhysicalParameters& muscle,
                                             const LoopTime& time) {
  // A slow muscle's feedback need not be fast: at the default, noise and friction would show.
  const double tau_s = -1.0 / muscle.thermal_pole_rad_per_s();
  const double slowness = std::max(1.0, tau_s / paper_time_constant_s);
  const std::string paper = number_text(paper_time_constant_s, 3) + " s";
  const std::string own = number_text(tau_s, 3) + " s";
  const std::string why =
      own != paper && slowness > 1.0
          ? " over the square root of its time constant, " + own + ", in units of the paper's " +
                paper
          : ", as its time constant, " + own + ", does not exceed the paper's " + paper;
  RecommendedController recommended;
  const double nominal_bandwidth = max_bandwidth_rad_per_s / std::sqrt(slowness);
  recommended.bandwidth_rad_per_s = bandwidth_with_margin(muscle, time, nominal_bandwidth);
  recommended.reason =
      std::string(closest) + ", and asks for no motion that the muscle cannot make; ";
  if (recommended.bandwidth_rad_per_s < nominal_bandwidth) {
    recommended.reason += "with " + number_text(1e3 * time.delay_s, 3) +
                          " ms of delay, more bandwidth would leave a margin below " +
                          number_text(min_margin, 3);
  } else {
    recommended.reason += number_text(max_bandwidth_rad_per_s, 3) + " rad/s" + why;
  }
  choose_model(muscle, recommended);
  return recommended;
}

RecommendedController recommended_controller(const ChannelSettings& channel,
                                             const BoardSettings& board) {
  const double step_s = board.step_s();
  RecommendedController recommended =
      recommended_controller(channel.muscle, {step_s, loop_delay_s(channel, step_s)});
  if (!channel.controllers.empty())
    compare_with(channel.controllers.front(), channel, board, recommended);
  return recommended;
}

std::string problem_of(const RecommendedController& recommended, const ChannelSettings& channel,
                       double step_s) {
  const ControllerSettings base =
      channel.controllers.empty() ? ControllerSettings{} : channel.controllers.front();
  const auto problem = check(recommended.applied_to(base), channel, step_s);
  return problem ? "controller." + problem->key + " " + problem->message : "";
}

}  // namespace supercoil::config
