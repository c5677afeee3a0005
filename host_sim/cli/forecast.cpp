#include "cli/forecast.hpp"

#include <cstdio>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "apps/common/feasibility_json.hpp"
#include "config/describe.hpp"
#include "runner/scenario_forecast.hpp"

namespace supercoil::host_sim {

namespace {

/// What to change; one line each.
std::vector<std::string> advice_of(const Scenario& scenario, const BoardSettings& board) {
  std::vector<std::string> lines = config::advice(board.channels[0], board);
  if (std::string line = describe_unseen_rest(scenario); !line.empty())
    lines.insert(lines.begin(), std::move(line));
  return lines;
}

void print_lines(const char* title, const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    if (!line.empty()) std::printf("%s: %s\n", title, line.c_str());
  }
}

}  // namespace

void print_forecast(const Scenario& scenario) {
  const ScenarioForecast forecast(scenario);
  const BoardSettings& board = forecast.board;
  print_lines("muscle", config::describe_feasibility(board, 0));
  print_lines("muscle", {describe_rest(scenario)});
  print_lines("recommended", config::describe_recommendation(board, 0));
  print_lines("reference", {describe_reference(forecast.reference, scenario),
                            describe_passed(forecast.reference), describe_out_of_range(scenario),
                            describe_ceiling(scenario), describe_promise(forecast.promise)});
  print_lines("advice", advice_of(scenario, board));
}

nlohmann::ordered_json forecast_json(const Scenario& scenario) {
  using Json = nlohmann::ordered_json;
  const ScenarioForecast forecast(scenario);
  const BoardSettings& board = forecast.board;
  Json reference;
  if (const auto& f = forecast.reference) {
    const auto& promise = forecast.promise;
    reference = {{"feasible", f->feasible()},
                 {"first_s", json_number(f->first_s)},
                 {"first_lasts_s", json_number(f->first_duration_s)},
                 {"first_ends", f->first_ends},
                 {"limited_by", name(f->limited_by)},
                 {"excess_W", f->excess_W},
                 {"behind_m", f->behind_m},
                 {"controller_invalid_s", json_number(f->invalid_s)},
                 {"infeasible_ratio", f->infeasible_ratio},
                 {"max_m", f->max_m},
                 {"held_m", f->held_m},
                 {"held_by", name(f->held_by)},
                 {"held_so_once_identified", f->once_identified},
                 {"feasible_motion_ratio", f->feasible_motion_ratio},
                 {"feasible_slowing", json_number(f->feasible_slowing)},
                 {"passed_ratio", f->passed_ratio},
                 {"passed_by_recommended_ratio", f->passed_by_recommended_ratio},
                 {"off_reference_rms_m", f->off_reference_rms_m},
                 {"promised_rms_m", promise ? Json(promise->parts.error_m()) : Json()},
                 {"out_of_range", describe_out_of_range(scenario)},
                 {"above_ceiling", describe_ceiling(scenario)},
                 {"text", describe_reference(f, scenario)}};
  }
  return {{"scenario", scenario.name},
          {"ticks", scenario.ticks()},
          {"events", scenario.events.size()},
          {"rest_m", rest_m(scenario)},
          {"feasibility", feasibility_json(board, 0)},
          {"reference", reference},
          {"advice", advice_of(scenario, board)}};
}

}  // namespace supercoil::host_sim
