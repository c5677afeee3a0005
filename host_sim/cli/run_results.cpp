#include "cli/run_results.hpp"

#include <algorithm>
#include <array>
#include <cinttypes>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>

#include <nlohmann/json.hpp>

#include "config/describe.hpp"
#include "runner/board_of.hpp"
#include "runner/mode_outcome.hpp"
#include "runner/reference_feasibility.hpp"

namespace supercoil::host_sim {

namespace {

volatile std::sig_atomic_t signalled = 0;

void note_signal(int) {
  signalled = 1;
}

/// "at a limit in 12.3 % of the ticks: maximum 10.0 %, slew 2.3 %"
void print_limits(const char* label, const LimitCount& count, const Summary& summary) {
  std::string limits;
  const auto percent = [&](std::int64_t ticks) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.1f %%",
                  100.0 * static_cast<double>(ticks) / static_cast<double>(summary.ticks()));
    return std::string(text.data());
  };
  std::int64_t all = 0;
  for (std::size_t i = 1; i < limit_names.size(); ++i) {
    const std::int64_t ticks = count.ticks.at(i);
    if (ticks == 0) continue;
    all += ticks;
    limits += (limits.empty() ? "" : ", ") + std::string(limit_names[i]) + " " + percent(ticks);
  }
  if (all == 0) return;
  std::printf("%sat a limit in %s of the ticks: %s\n", label, percent(all).c_str(), limits.c_str());
}

/// A position in µm, with at least three digits.
std::string um_text(double position_m) {
  constexpr double small_um = 10.0;
  const double position_um = 1e6 * position_m;
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), position_um < small_um ? "%.3g" : "%.1f", position_um);
  return text.data();
}

/// Oscillation or divergence that the loop causes without the reference asking for it.
void print_divergence(const Summary& summary, const Scenario& scenario) {
  if (summary.oscillated()) return;
  if (const double period_s = summary.limit_cycle_period_s(scenario); !std::isnan(period_s)) {
    std::printf(
        "the loop oscillates with a period of %.2g s: its power went from one limit to the other "
        "and back, where the reference asked for no more than the muscle can do; lower the gains, "
        "slow the adaptation or identify the muscle again\n",
        period_s);
    return;
  }
  if (!summary.diverged()) return;
  std::printf(
      "its power was at a limit in %.1f %% of all ticks that followed, for 0.2 s or longer at a "
      "time, where the reference asked for no more than the muscle can do: the loop oscillates or "
      "diverges; lower the gains, slow the adaptation or identify the muscle again\n",
      100.0 * summary.unasked_limit_ratio());
}

void print_noise(const Summary& summary, const Scenario& scenario) {
  const double noise_W = summary.power_noise_W();
  const double range_W = scenario.start.power.max_W - scenario.start.power.min_W;
  if (!std::isnan(summary.limit_cycle_period_s(scenario))) return;
  if (!summary.has_power_noise() || !(noise_W > config::high_noise_ratio * range_W)) return;
  const BoardSettings board = firmware_of(scenario);
  const ChannelSettings& channel = board.channels.front();
  std::printf(
      "the controller's power swung by %.3g W rms, %.0f %% of its range, which no motion asked "
      "for: sensor noise, or a small margin; %s\n",
      noise_W, 100.0 * noise_W / range_W,
      config::noise_remedy(channel.controllers.front(), channel, board).c_str());
}

/// The error that was promised for the run.
void print_promise(const nlohmann::ordered_json& json) {
  if (json["promised_rms_m"].is_null() || json["tracking_rms_m"].is_null()) return;
  std::printf("promised: %s um rms%s%s, as the sensor shows it; ",
              um_text(json["promised_rms_m"].get<double>()).c_str(),
              json["promised_by"] == "own" ? "" : " by the recommended controller",
              json["promised_on"] == "reference" ? "" : ", on the first motion of supercoil setup");
  const auto& shown_rms_m = json["tracking_shown_rms_m"];
  if (shown_rms_m.is_null()) {
    std::puts("the sensor had no reading in some ticks");
  } else {
    std::printf("the sensor showed %s um\n", um_text(shown_rms_m.get<double>()).c_str());
  }
}

/// How identify, calibrate and the first motion ended, if there were any.
void print_modes(const nlohmann::ordered_json& json) {
  const auto& text = json["mode_result"]["text"];
  if (!text.is_null())
    std::printf("the last identify or calibrate: %s\n", text.get<std::string>().c_str());
  const auto& motion = json["first_motion"];
  if (motion.is_null() || motion["rms_m"].is_null()) return;
  const double rms_m = motion["rms_m"].get<double>();
  std::printf("first motion: followed within %s um rms", um_text(rms_m).c_str());
  if (!motion["promised_rms_m"].is_null()) {
    const double promised_m = motion["promised_rms_m"].get<double>();
    std::printf("; the promise of %s um is %s", um_text(promised_m).c_str(),
                rms_m <= promised_m ? "kept" : "not kept");
  }
  std::puts("");
}

bool arms_later(const Scenario& scenario) {
  return std::any_of(scenario.events.begin(), scenario.events.end(),
                     [](const Event& event) { return arms(event.conditions.action); });
}

void print_summary(const Summary& summary, const Scenario& scenario,
                   const ScenarioForecast& forecast, const nlohmann::ordered_json& json,
                   const std::string& folder) {
  std::printf("%s: %" PRId64 " ticks in %.2f s, %.0f x real time\n",
              json["scenario"].get<std::string>().c_str(), json["ticks"].get<std::int64_t>(),
              json["wall_s"].get<double>(), json["realtime_factor"].get<double>());
  if (!json["tracking_rms_m"].is_null()) {
    std::printf("tracking error %s um rms, %s um at most (%g to %g s)\n",
                um_text(json["tracking_rms_m"].get<double>()).c_str(),
                um_text(json["tracking_max_m"].get<double>()).c_str(),
                json["window_s"][0].get<double>(), json["window_s"][1].get<double>());
  }
  print_promise(json);
  if (const std::string passed = describe_passed(forecast.reference);
      !passed.empty() && !json["off_reference_rms_m"].is_null()) {
    std::printf("it was %.3g mm rms from the reference itself: %s\n",
                1e3 * json["off_reference_rms_m"].get<double>(), passed.c_str());
  }
  if (json.contains("tracking_rms_deg") && !json["tracking_rms_deg"].is_null()) {
    std::printf("that is %.3f degrees rms, %.3f at most\n", json["tracking_rms_deg"].get<double>(),
                json["tracking_max_deg"].get<double>());
  }
  print_limits("", summary.limits(), summary);
  print_limits("antagonist ", summary.antagonist_limits(), summary);
  if (summary.infeasible() != nullptr) {
    const std::string infeasible = describe_infeasible(*summary.infeasible(), scenario);
    if (!infeasible.empty()) std::printf("%s\n", infeasible.c_str());
  }
  print_divergence(summary, scenario);
  print_noise(summary, scenario);
  print_modes(json);
  for (const auto& fault : json["faults"])
    std::puts(fault["text"].get<std::string>().c_str());
  std::printf("hottest %.1f K above ambient\nwritten to %s\n",
              json["hottest_temperature_rise_K"].get<double>(), folder.c_str());
}

}  // namespace

void catch_interrupts() {
  std::signal(SIGINT, note_signal);
  std::signal(SIGTERM, note_signal);
}

bool interrupted() {
  return signalled != 0;
}

std::string reached(const Simulation& simulation, const Scenario& scenario) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%g s of %g s",
                static_cast<double>(simulation.tick()) * scenario.step_s(), scenario.duration_s);
  return text.data();
}

std::string prefix(const RunOptions& options, const Scenario& scenario) {
  return options.several_boards() ? scenario.name + ": " : "";
}

void finish(recorder::FlightRecorder& recorder, const RunOptions& options) {
  recorder.finish();
  for (const recorder::RecorderNote& note : recorder.take_notes()) {
    if (note.problem || !options.quiet)
      std::fprintf(note.problem ? stderr : stdout, "%s\n", note.text.c_str());
  }
}

Result<std::string> conclude(const Summary& summary, const Scenario& scenario,
                             const ScenarioForecast& forecast, const Simulation& simulation,
                             double wall_s, OutputFolder& folder, bool quiet) {
  const auto json = summary.to_json(scenario, forecast.promise, simulation, wall_s);
  const std::string text =
      json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  if (auto written = folder.write("summary.json", text); !written)
    return tl::unexpected(written.error());
  if (auto done = folder.commit(); !done) return tl::unexpected(done.error());
  if (!quiet) print_summary(summary, scenario, forecast, json, folder.path().string());
  return text;
}

bool ever_arms(const Scenario& scenario) {
  return arms(scenario.start.action) || arms_later(scenario);
}

int report_outcome(const Summary& summary, const Scenario& scenario,
                   const ScenarioForecast& forecast, const Simulation& simulation,
                   const RunOptions& options) {
  const Fault fault = summary.ended_in();
  const auto& motion = simulation.first_motion();
  const bool unfinished = motion && std::isnan(motion->rms_m());
  const std::string unfollowed = summary.did_not_follow_because(scenario, forecast.promise);
  const std::string nothing_found = mode_failed_because(scenario, simulation);
  const bool ended_well = summary.armed() && fault == Fault::none && !unfinished;
  if (ended_well && unfollowed.empty() && nothing_found.empty()) return exit_done;
  std::string text = prefix(options, scenario);
  if (!summary.armed()) {
    text += "never armed: " + summary.never_armed_because(scenario, simulation);
  } else if (ended_well && !unfollowed.empty()) {
    text += "it did not follow: " + unfollowed;
  } else if (ended_well) {
    text += "identify or calibrate found nothing: " + nothing_found;
  } else if (fault == Fault::none) {
    text += "the first motion did not finish";
  } else {
    text += "the run ended in " + fault_text(fault);
  }
  const bool intended = !summary.armed() && fault == Fault::none && !ever_arms(scenario);
  if (!options.allow_fault && !intended)
    return fail(exit_failed, text + " (--allow-fault: exit status 0)");
  if (!options.quiet) std::puts(text.c_str());
  return exit_done;
}

std::string write_svg(OutputFolder& folder, const Figure& figure, const std::string& name) {
  const auto path = folder.temporary(name);
  if (const auto drawn = draw(figure, path); !drawn) {
    folder.drop(name);
    std::fprintf(stderr, "supercoil-sim: %s was not written: %s\n", name.c_str(),
                 drawn.error().text().c_str());
    return {};
  }
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace supercoil::host_sim
