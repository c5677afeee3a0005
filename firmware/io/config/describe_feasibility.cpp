#include <cmath>
#include <sstream>

#include "supercoil/control/tracking/loop_margin.hpp"
#include "supercoil/control/tracking/tunable.hpp"

#include "config/describe.hpp"
#include "config/recommended_controller.hpp"
#include "loop/feasibility.hpp"
#include "text/number_text.hpp"

namespace supercoil::config {

namespace {

/// To three digits: these are predictions.
std::string in_digits(double value) {
  return number_text(value, 3);
}

std::string in_mm(double metres) {
  return in_digits(1e3 * metres) + " mm";
}

std::string motion_line(const Feasibility& f, const ChannelSettings& c) {
  std::string line =
      "holds " + in_mm(f.travel_m) + " indefinitely, at " + in_digits(f.held_W) + " W";
  if (f.held_by != LimitedBy::maximum) line += " (limited_by " + std::string(name(f.held_by)) + ")";
  line += "; 10 to 90 % of it in " + in_digits(f.rise_s) + " s at " + in_digits(f.max_W) +
          " W, back in " + in_digits(f.fall_s) + " s";
  line += "; a sine over its middle half needs a period of at least " +
          in_digits(f.half_travel_period_s) + " s";
  return line +
         (c.joint.has_other() ? "; all by itself: the joint's other muscle pulls it back" : "");
}

std::string start_line(const Feasibility& f, const ChannelSettings& c) {
  std::string line = std::isfinite(f.armable_s)
                         ? "may be armed " + in_digits(f.armable_s) + " s after boot, at the latest"
                         : "can never be armed";
  if (f.air_shift_m > 0.0) {
    line += "; rests up to " + in_mm(f.air_shift_m) + " lower in the coldest air";
    if (!f.rest_seen)
      line += ", where the sensor reads no less than " + in_mm(c.supervision.min_position_m);
    line += ", and holds up to " + in_mm(f.cold_travel_m) + " above its zero there";
  }
  return line;
}

/// What happens to a set point that stays above the held travel; empty: none is accepted.
std::string beyond_text(const Feasibility& f, const FeasibleSteps& steps,
                        const ChannelSettings& c) {
  if (f.travel_m >= c.supervision.max_travel_m) return "";
  const std::string line = "; a set point that stays above " + in_mm(f.travel_m);
  // Shaping does not know the load.
  if (steps.shaped && c.simulated.load_N <= 0.0) return line + " comes back to it";
  return line + " ends in controller_invalid after " + in_digits(c.supervision.saturated_s) + " s";
}

/// Empty: the steps are too fine to mention.
std::string pwm_line(const ChannelSettings& c, const BoardSettings& board) {
  constexpr double fine_ratio = 1e-5;
  const double supply_V = board.supervision.max_supply_V;
  const double step_W = supply_V * supply_V / c.heater.cold_resistance_Ohm / c.heater.pwm_steps;
  if (step_W < fine_ratio * c.limiter.max_W) return "";
  return "power is set in PWM steps of up to " + in_digits(1e3 * step_W) + " mW, " +
         std::to_string(c.heater.pwm_steps) + " per period";
}

}  // namespace

double tolerated_ratio(const control::ControllerSettings& controller, const ChannelSettings& c,
                       double step_s) {
  const auto law = control::fixed_law(controller, c.muscle);
  return law ? control::tolerated_span(*law, c.muscle, step_s, loop_delay_s(c, step_s)) : NAN;
}

double noise_power_W(const control::ControllerSettings& controller, const ChannelSettings& c,
                     double step_s) {
  const auto law = control::fixed_law(controller, c.muscle);
  return law ? reading_noise_m(c) *
                   control::noise_gain_W_per_m(*law, c.muscle, step_s, loop_delay_s(c, step_s))
             : NAN;
}

double bandwidth_rad_per_s(const control::ControllerSettings& controller) {
  static const std::size_t place = control::tunable_named("bandwidth_rad_per_s");
  return control::tunables().at(place).get(controller);
}

std::string describe_margin(const control::ControllerSettings& controller, const ChannelSettings& c,
                            double step_s) {
  const auto margin = margin_of(controller, c, step_s);
  const double ratio = tolerated_ratio(controller, c, step_s);
  if (!margin || std::isnan(ratio)) return "";
  if (!margin->stable()) {
    const auto problem = check(controller, c, step_s);
    return problem ? problem->message : "is unstable on this muscle";
  }
  const bool adapts = control::adapts(controller.kind);
  std::ostringstream out;
  out << "margin " << std::nearbyint(100.0 * margin->modulus) / 100.0
      << (adapts ? " once adapted" : "") << ", holds if no parameter "
      << (adapts ? "moves" : "is off") << " by more than " << std::nearbyint(100.0 * ratio) << " %";
  const double bandwidth = bandwidth_rad_per_s(controller);
  if (!std::isnan(bandwidth)) out << ", bandwidth " << in_digits(bandwidth) << " rad/s";
  return out.str();
}

std::string describe_promise(const Promise& promise, const FirstMotion& motion) {
  const auto in_um = [](double metres) { return in_digits(1e-2 * std::nearbyint(1e8 * metres)); };
  return in_um(promise.error_m()) + " um rms on a sine of " +
         in_digits(1e3 * (motion.middle_m - motion.amplitude_m)) + " to " +
         in_mm(motion.middle_m + motion.amplitude_m) + ", period " + in_digits(motion.period_s) +
         " s (sensor " + in_um(promise.noise_m) + ", probes " + in_um(promise.probe_m) +
         ", dither " + in_um(promise.dither_m) + ", PWM " + in_um(promise.pwm_m) + ", delay " +
         in_um(promise.delay_m) + ", not linear " + in_um(promise.unexplained_m) + ")";
}

std::vector<std::string> describe_promises(const BoardSettings& board, std::size_t channel) {
  const ChannelSettings& c = board.channels[channel];
  if (board.joint_of(channel) != nullptr || is_led(c)) return {};
  const FirstMotion motion = plan_first_motion(feasibility(c, board), c.unexplained_ratio);
  if (!(motion.amplitude_m > 0.0)) return {"no error is promised: it can hold no travel"};
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < c.controllers.size(); ++i) {
    const control::ControllerSettings& controller = c.controllers[i];
    std::string line = "controller " + std::to_string(i);
    auto law = controller.learned_ff;
    if (!is_promised_for(controller, c, board.step_s())) {
      const bool rings = controller.kind == control::ControllerKind::learned_ff;
      const std::string kind(control::name_of(control::controller_names, controller.kind));
      line += " promises no error (" + (rings ? "its margin is too small" : kind) +
              "); the recommended one";
      law = recommended_controller(c, board).applied_to(controller).learned_ff;
    }
    const Promise promise = promise_error(law, c, board, motion);
    lines.push_back(line + " promises, once the muscle is identified, at most " +
                    describe_promise(promise, motion));
  }
  return lines;
}

std::vector<std::string> describe_feasibility(const BoardSettings& board, std::size_t channel) {
  const ChannelSettings& c = board.channels[channel];
  const Feasibility f = feasibility(c, board);
  std::vector<std::string> lines{start_line(f, c)};
  if (std::string line = pwm_line(c, board); !line.empty()) lines.push_back(std::move(line));
  if (c.bundle.follows()) return lines;
  lines.insert(lines.begin(), motion_line(f, c));
  if (is_led(c)) return lines;
  for (std::size_t i = 0; i < f.steps.size(); ++i) {
    if (!f.steps[i]) continue;
    const std::string margin = describe_margin(c.controllers[i], c, board.step_s());
    if (!margin.empty()) lines.push_back("controller " + std::to_string(i) + ": " + margin);
    const double down_m = f.steps[i]->down_m;
    lines.push_back("controller " + std::to_string(i) + " can follow steps of " +
                    in_mm(f.steps[i]->up_m) + " up from rest" +
                    (std::isnan(down_m) ? "" : " and " + in_mm(down_m) + " down from there") +
                    "; larger ones " +
                    (f.steps[i]->shaped ? "are shaped" : "ask for more than the muscle can do") +
                    beyond_text(f, *f.steps[i], c));
  }
  for (std::string& line : describe_promises(board, channel))
    lines.push_back(std::move(line));
  return lines;
}

}  // namespace supercoil::config
