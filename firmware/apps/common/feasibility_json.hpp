// What a channel's muscle can do, as JSON: the figures that config::describe_feasibility() prints
// as text.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>

#include <nlohmann/json.hpp>

#include "config/describe.hpp"
#include "config/recommended_controller.hpp"
#include "loop/promise.hpp"

namespace supercoil {

/// null: not known, or does not exist.
inline nlohmann::ordered_json json_number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

inline nlohmann::ordered_json promise_json(const Promise& promise) {
  return {{"promised_m", promise.error_m()},
          {"noise_m", promise.noise_m},
          {"probe_m", promise.probe_m},
          {"dither_m", promise.dither_m},
          {"pwm_m", promise.pwm_m},
          {"delay_m", promise.delay_m},
          {"unexplained_m", promise.unexplained_m}};
}

/// One controller of a channel, without its promise.
inline nlohmann::ordered_json controller_json(const control::ControllerSettings& controller,
                                              const ChannelSettings& channel, double step_s,
                                              const std::optional<FeasibleSteps>& steps) {
  const auto margin = margin_of(controller, channel, step_s);
  return {{"kind", control::name_of(control::controller_names, controller.kind)},
          {"margin", json_number(margin ? margin->modulus : NAN)},
          {"tolerated_ratio", json_number(config::tolerated_ratio(controller, channel, step_s))},
          {"bandwidth_rad_per_s", json_number(config::bandwidth_rad_per_s(controller))},
          {"noise_power_W", json_number(config::noise_power_W(controller, channel, step_s))},
          {"step_up_m", json_number(steps ? steps->up_m : NAN)},
          {"step_down_m", json_number(steps ? steps->down_m : NAN)},
          {"shaped", steps && steps->shaped}};
}

/// The recommended controller for the channel's muscle. problem: why the channel cannot have it.
/// in_use: the first of its controllers that matches the recommendation.
inline nlohmann::ordered_json recommendation_json(const ChannelSettings& channel,
                                                  const BoardSettings& board) {
  if (is_led(channel)) return nullptr;
  const config::RecommendedController recommended = config::recommended_controller(channel, board);
  const control::ControllerSettings controller = recommended.applied_to({});
  const std::string problem = problem_of(recommended, channel, board.step_s());
  nlohmann::ordered_json in_use;
  for (std::size_t i = channel.controllers.size(); i-- > 0;) {
    if (!recommended.differs_from(channel.controllers[i])) in_use = i;
  }
  return {{"kind", control::name_of(control::controller_names, controller.kind)},
          {"shape_reference", controller.shape_reference},
          {"bandwidth_rad_per_s", recommended.bandwidth_rad_per_s},
          {"reason", recommended.reason},
          {"model_poles_rad_per_s", controller.model.poles_rad_per_s},
          {"model_reason", recommended.model_reason},
          {"problem", problem.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(problem)},
          {"in_use", in_use}};
}

/// channel: from 0. For a joint's antagonist `controllers` is empty; nothing is promised for a
/// joint.
inline nlohmann::ordered_json feasibility_json(const BoardSettings& board, std::size_t channel) {
  const ChannelSettings& c = board.channels[channel];
  const Feasibility f = feasibility(c, board);
  const FirstMotion motion = plan_first_motion(f, c.unexplained_ratio);
  nlohmann::ordered_json controllers = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < c.controllers.size() && !is_led(c); ++i) {
    nlohmann::ordered_json entry = controller_json(c.controllers[i], c, board.step_s(), f.steps[i]);
    if (is_promised_for(c.controllers[i], c, board.step_s()) &&
        board.joint_of(channel) == nullptr && motion.amplitude_m > 0.0)
      entry.update(promise_json(promise_error(c.controllers[i].learned_ff, c, board, motion)));
    controllers.push_back(std::move(entry));
  }
  return {{"travel_m", f.travel_m},
          {"held_W", f.held_W},
          {"limited_by", name(f.held_by)},
          {"max_W", f.max_W},
          {"rise_s", json_number(f.rise_s)},
          {"fall_s", json_number(f.fall_s)},
          {"half_travel_period_s", json_number(f.half_travel_period_s)},
          {"armable_s", json_number(f.armable_s)},
          {"air_shift_m", f.air_shift_m},
          {"cold_travel_m", f.cold_travel_m},
          {"rest_seen", f.rest_seen},
          {"first_motion",
           {{"middle_m", motion.middle_m},
            {"amplitude_m", motion.amplitude_m},
            {"period_s", motion.period_s}}},
          {"controllers", controllers},
          {"recommended", recommendation_json(c, board)}};
}

}  // namespace supercoil
