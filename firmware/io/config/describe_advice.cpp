#include <algorithm>
#include <cmath>

#include "config/describe.hpp"
#include "config/findings.hpp"
#include "config/recommended_controller.hpp"
#include "loop/feasibility.hpp"
#include "text/documentation.hpp"
#include "text/number_text.hpp"

namespace supercoil::config {

namespace {

/// To three digits: these are predictions.
std::string length_text(double metres) {
  return number_text(1e3 * metres, 3) + " mm";
}

/// Less than this fraction of the travel deserves advice.
constexpr double little_ratio = 0.25;

/// What allows more continuous power.
std::string remedy(LimitedBy held_by) {
  switch (held_by) {
    case LimitedBy::temperature:
      return "narrower bounds in [thermal], or measurements that show how hot it is, allow more "
             "(see " +
             documentation_page("safety") + ")";
    case LimitedBy::unproven:
      return "senses compared with a meter and a sensor with less noise allow more "
             "(see " +
             documentation_page("faults/heater_not_responding") + ")";
    default:
      return "a higher max_W, or supply voltage, allows more";
  }
}

void advise_travel(const ChannelSettings& c, const Feasibility& f,
                   std::vector<std::string>& lines) {
  const double max_m = c.supervision.max_travel_m;
  if (f.travel_m < little_ratio * max_m) {
    lines.push_back("it holds only " + length_text(f.travel_m) +
                    " of max_travel_m = " + length_text(max_m) + " indefinitely (limited_by " +
                    std::string(name(f.held_by)) + "): " + remedy(f.held_by));
  }
  if (f.cold_travel_m < little_ratio * f.travel_m) {
    lines.push_back("in the coldest air it holds no more than " + length_text(f.cold_travel_m) +
                    " above a zero that was taken in the warmest, where it holds " +
                    length_text(f.travel_m) +
                    ": calibrate in the air in which it works, or narrow [ambient]");
  }
}

/// The current must be seen before a probe ends.
void advise_probe(const ChannelSettings& c, double step_s, std::vector<std::string>& lines) {
  constexpr double rounding_s = 1e-9;
  const HeaterSettings& h = c.heater;
  if (h.delay_s + step_s < h.probe_s - rounding_s) return;
  lines.push_back("its power acts " + number_text(1e3 * h.delay_s, 3) +
                  " ms late, and a probe of the heater takes " + number_text(1e3 * h.probe_s, 3) +
                  " ms: it ends in heater_open before any current is seen, and the muscle is never "
                  "armed; shorten the delay");
}

/// After a muscle softened on a sine, adaptive_ff left 46 um with the gradient estimator, as much
/// as with none, and 1 um with least squares (November 2026).
void advise_estimator(const ChannelSettings& c, std::vector<std::string>& lines) {
  using control::EstimatorKind;
  const bool adapts = std::ranges::any_of(c.estimators, [](const control::EstimatorSettings& e) {
    return e.kind == EstimatorKind::least_squares;
  });
  if (adapts) return;
  for (std::size_t i = 0; i < c.controllers.size(); ++i) {
    if (c.controllers[i].kind != control::ControllerKind::adaptive_ff) continue;
    lines.push_back("controller " + std::to_string(i) +
                    ": adaptive_ff needs an estimator of kind least_squares; with any other it "
                    "hardly adapts when the muscle changes");
  }
}

/// For controllers whose power swings with the sensor's noise.
void advise_noise(const ChannelSettings& c, const BoardSettings& board,
                  std::vector<std::string>& lines) {
  const double range_W = c.limiter.max_W - c.limiter.min_W;
  for (std::size_t i = 0; i < c.controllers.size(); ++i) {
    const double swing_W = noise_power_W(c.controllers[i], c, board.step_s());
    if (!(swing_W > high_noise_ratio * range_W)) continue;
    lines.push_back("controller " + std::to_string(i) + ": the sensor's noise of " +
                    number_text(1e6 * reading_noise_m(c), 3) + " um rms makes the power swing by " +
                    number_text(swing_W, 3) + " W rms, " +
                    number_text(100.0 * swing_W / range_W, 3) +
                    " % of its range: " + noise_remedy(c.controllers[i], c, board));
  }
}

}  // namespace

std::string noise_remedy(const control::ControllerSettings& controller,
                         const ChannelSettings& channel, const BoardSettings& board) {
  if (recommended_controller(channel, board).has_bandwidth_of(controller)) {
    return "a sensor with less noise reduces it; a bandwidth below the recommended one would "
           "follow less closely";
  }
  return "lower gains (bandwidth_rad_per_s, derivative_Ws_per_m, derivative_filter_rad_per_s), or "
         "a sensor with less noise, reduce it";
}

std::vector<std::string> describe_recommendation(const BoardSettings& board, std::size_t channel) {
  const ChannelSettings& c = board.channels[channel];
  if (is_led(c) || c.controllers.empty()) return {};
  const RecommendedController recommended = recommended_controller(c, board);
  for (std::size_t i = 0; i < c.controllers.size(); ++i) {
    if (recommended.differs_from(c.controllers[i])) continue;
    return {"controller " + std::to_string(i) + ", as configured: it " + recommended.reason};
  }
  const std::string law = "controller = " + recommended.literal();
  const std::string model = "reference_model = " + recommended.model_literal();
  std::vector<std::string> lines{law + ": " + recommended.reason,
                                 model + ": " + recommended.model_reason};
  if (const std::string problem = problem_of(recommended, c, board.step_s()); !problem.empty())
    lines.push_back("not possible on this channel as configured: " + problem);
  return lines;
}

std::vector<std::string> advice(const ChannelSettings& c, const BoardSettings& board) {
  const Feasibility f = feasibility(c, board);
  std::vector<std::string> lines;
  if (!f.rest_seen) {
    lines.push_back("in the coldest air it rests " + length_text(f.air_shift_m) +
                    " below its zero, and the sensor reads no less than " +
                    length_text(c.supervision.min_position_m) +
                    ": a colder start looks like a fault");
  }
  advise_probe(c, board.step_s(), lines);
  if (c.bundle.follows()) return lines;
  advise_travel(c, f, lines);
  advise_weight(c, lines);
  if (is_led(c)) return lines;
  advise_noise(c, board, lines);
  advise_estimator(c, lines);
  for (std::size_t i = 0; i < f.steps.size(); ++i) {
    const auto& steps = f.steps[i];
    const bool small = steps && std::fmin(steps->up_m, steps->down_m) < 0.5 * f.travel_m;
    if (small && !steps->shaped) {
      lines.push_back("controller " + std::to_string(i) +
                      ": a step over half of the travel asks for more than the muscle can do; "
                      "shape_reference = true makes it feasible");
    }
  }
  return lines;
}

std::vector<std::string> advice(const BoardConfig& config) {
  Findings findings;
  for (std::size_t i = 0; i < config.settings.channels.size(); ++i) {
    findings.enter(i + 1);
    for (const std::string& line : advice(config.settings.channels[i], config.settings))
      findings.add(line);
  }
  std::vector<std::string> lines = findings.lines();
  for (std::size_t i = 0; i < config.settings.joints.size(); ++i) {
    for (const std::string& line : joint_advice(config, i))
      lines.push_back("joint " + std::to_string(i + 1) + ": " + line);
  }
  return lines;
}

}  // namespace supercoil::config
