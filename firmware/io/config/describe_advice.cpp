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
