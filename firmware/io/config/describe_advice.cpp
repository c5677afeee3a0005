#include <algorithm>

#include "config/describe.hpp"
#include "config/findings.hpp"
#include "config/recommended_controller.hpp"
#include "loop/feasibility.hpp"
#include "text/number_text.hpp"

namespace supercoil::config {

namespace {

/// To three digits: these are predictions.
std::string length_text(double metres) {
  return number_text(1e3 * metres, 3) + " mm";
}

/// A smaller part of the travel is little.
constexpr double little_ratio = 0.25;

/// What allows more power for good.
std::string remedy(LimitedBy held_by) {
  switch (held_by) {
    case LimitedBy::temperature:
      return "narrower bounds in [thermal] allow more, and what tells how hot it is "
             "(docs/safety.md)";
    case LimitedBy::unproven:
      return "senses that are compared with a meter and a sensor with less noise allow more "
             "(docs/faults/heater_not_responding.md)";
    default:
      return "a greater max_W, or supply, allows more";
  }
}

void advise_travel(const ChannelSettings& c, const Feasibility& f,
                   std::vector<std::string>& lines) {
  const double max_m = c.supervision.max_travel_m;
  if (f.travel_m < little_ratio * max_m) {
    lines.push_back("of max_travel_m = " + length_text(max_m) + " it holds " +
                    length_text(f.travel_m) + " for good (limited_by " +
                    std::string(name(f.held_by)) + "): " + remedy(f.held_by));
  }
  if (f.cold_travel_m < little_ratio * f.travel_m) {
    lines.push_back("in the coldest air it holds no more than " + length_text(f.cold_travel_m) +
                    " above a zero that was taken in the warmest, where it holds " +
                    length_text(f.travel_m) +
                    ": calibrate in the air in which it works, or narrow [ambient]");
  }
}

}  // namespace

std::vector<std::string> describe_recommendation(const BoardSettings& board, std::size_t channel,
                                                 bool in_brief) {
  const ChannelSettings& c = board.channels[channel];
  if (is_led(c) || c.controllers.empty()) return {};
  const RecommendedController suits = recommended_controller(c.muscle);
  for (std::size_t i = 0; i < c.controllers.size(); ++i) {
    if (suits.differs_from(c.controllers[i])) continue;
    if (in_brief) return {};
    return {"controller " + std::to_string(i) + ", as it is: it " + suits.reason};
  }
  const std::string law = "controller = " + suits.literal();
  const std::string model = "reference_model = " + suits.model_literal();
  if (const auto problem = check(suits.in_place_of(c.controllers.front()), c, board.step_s()))
    return {law + " with " + model + ", but here " + problem->key + " " + problem->message};
  if (in_brief) return {law + " with " + model};
  return {law + ": " + suits.reason, model + ": " + suits.model_reason};
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
  if (c.bundle.follows()) return lines;
  advise_travel(c, f, lines);
  if (is_led(c)) return lines;
  for (std::size_t i = 0; i < f.steps.size(); ++i) {
    const auto& steps = f.steps[i];
    const bool small = steps && std::min(steps->up_m, steps->down_m) < 0.5 * f.travel_m;
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
