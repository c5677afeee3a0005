#include "runner/scenario_forecast.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "config/describe.hpp"
#include "config/recommended_controller.hpp"
#include "runner/board_of.hpp"

namespace supercoil::host_sim {

namespace {

/// Wide: the built-in scenario `c`, whose reference asks for too much, has six times the promise
/// and a twentieth of the motion.
constexpr double far_above_promise = 10.0;
constexpr double large_part = 0.25;

std::optional<FirstMotion> feasible_sine_of(const Scenario& scenario,
                                            const std::optional<ReferenceFeasibility>& f) {
  if (!f || f->feasible_motion_ratio < 1.0 || f->leads_too_far()) return std::nullopt;
  if (!describe_out_of_range(scenario).empty()) return std::nullopt;
  const Reference& reference = scenario.start.reference;
  if (reference.kind != ReferenceKind::sine || reference.terms.empty()) return std::nullopt;
  const Sinusoid& sine = reference.terms.front();
  if (sine.amplitude == 0.0 || sine.angular_frequency_rad_per_s == 0.0) return std::nullopt;
  // The muscle is only asked to follow what passes the reference model.
  const double left_ratio = f->attenuates() ? f->passed_ratio : 1.0;
  return FirstMotion{reference.offset, left_ratio * std::abs(sine.amplitude),
                     2.0 * std::numbers::pi / std::abs(sine.angular_frequency_rad_per_s)};
}

std::optional<ScenarioPromise> promise_of(const Scenario& scenario, const BoardSettings& board,
                                          const std::optional<ReferenceFeasibility>& reference) {
  if (!follows_position(scenario.start)) return std::nullopt;
  const ChannelSettings& channel = board.channels[0];
  ScenarioPromise promise;
  const auto sine = feasible_sine_of(scenario, reference);
  promise.of_reference = sine.has_value();
  promise.motion =
      sine.value_or(plan_first_motion(feasibility(channel, board), channel.unexplained_ratio));
  if (!(promise.motion.amplitude_m > 0.0)) return std::nullopt;
  control::ControllerSettings controller = scenario.start.controller;
  promise.of_own_controller = is_promised_for(controller, channel, board.step_s());
  if (!promise.of_own_controller) {
    controller = config::recommended_controller(channel, board).applied_to(controller);
  }
  promise.parts = promise_error(controller.learned_ff, channel, board, promise.motion);
  return promise;
}

}  // namespace

ScenarioForecast::ScenarioForecast(const Scenario& scenario)
    : board(forecast_board_of(scenario)),
      reference(reference_feasibility(scenario)),
      promise(promise_of(scenario, board, reference)) {}

std::string describe_promise(const std::optional<ScenarioPromise>& promise) {
  if (!promise || !promise->of_reference) return {};
  return std::string(promise->of_own_controller ? "promised is"
                                                : "the recommended controller promises") +
         " at most " + config::describe_promise(promise->parts, promise->motion);
}

double unfollowed_m(const std::optional<ScenarioPromise>& promise, double motion_m) {
  return std::max(promise ? far_above_promise * promise->parts.error_m() : 0.0,
                  large_part * motion_m);
}

}  // namespace supercoil::host_sim
