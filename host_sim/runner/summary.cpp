#include "runner/summary.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>

#include <nlohmann/json.hpp>

#include "supercoil/control/actuator/conversions.hpp"

#include "runner/mode_outcome.hpp"
#include "text/documentation.hpp"
#include "text/margin_unit.hpp"
#include "text/number_text.hpp"
#include "text/program_version.hpp"

namespace supercoil::host_sim {

namespace {

using nlohmann::ordered_json;

/// Of summary.json: incremented when a key is renamed or its meaning changes. Version 0.1.0 of the
/// programs wrote schema 1 without saying so.
constexpr int schema_version = 6;

std::string page_of(Fault fault) {
  return "docs/faults/" + std::string(name(fault)) + ".md";
}

/// For a person.
std::string explanation_of(Fault fault) {
  return documentation_page("faults/" + std::string(name(fault)));
}

/// JSON has no infinity: null.
ordered_json finite(double value) {
  return std::isfinite(value) ? ordered_json(value) : nullptr;
}

ordered_json physical_json(const control::PhysicalParameters& p) {
  return {{"thermal_mass_J_per_K", p.thermal_mass_J_per_K},
          {"heat_transfer_W_per_K", p.heat_transfer_W_per_K},
          {"stiffness_N_per_m", p.stiffness_N_per_m},
          {"damping_Ns_per_m", p.damping_Ns_per_m}};
}

ordered_json learned_json(const board::Learned& learned) {
  ordered_json json = physical_json(learned.muscle);
  json["position_offset_m"] = learned.calibration.position_offset_m;
  json["position_scale"] = learned.calibration.position_scale;
  json["cold_resistance_Ohm"] = learned.calibration.cold_resistance_Ohm;
  json["response_ratio"] = learned.response_ratio;
  json["unexplained_ratio"] = learned.unexplained_ratio;
  return json;
}

/// How the last identify or calibrate ended, and identify's notes.
ordered_json mode_result_json(const Snapshot& snapshot) {
  ordered_json notes = ordered_json::array();
  for (std::size_t i = 0; i < identify_note_names.size(); ++i) {
    if ((snapshot.identify_notes >> i & 1U) != 0) notes.push_back(identify_note_names.at(i));
  }
  const std::string text = describe_mode(snapshot);
  return {{"result", mode_result_names.at(static_cast<std::size_t>(snapshot.result))},
          {"notes", notes},
          {"text", text.empty() ? ordered_json() : ordered_json(text)}};
}

ordered_json estimate_json(const control::Estimate& e, const control::PhysicalParameters& muscle) {
  ordered_json result{{"theta", {e.theta[0], e.theta[1], e.theta[2], e.theta[3]}},
                      {"trusted", e.trusted},
                      {"relative_error_bound", finite(e.relative_error_bound)},
                      {"excitation_W2s", e.excitation_W2s},
                      {"physical", nullptr}};
  const auto physical = control::physical_from(
      e.theta, control::KnownParameters{muscle.force_per_kelvin_N_per_K, muscle.moving_mass_kg});
  if (physical) result["physical"] = physical_json(*physical);
  return result;
}

/// The share of all ticks at each limit that occurred.
ordered_json limits_json(const LimitCount& limits, std::int64_t all_ticks) {
  ordered_json json = ordered_json::object();
  for (std::size_t i = 1; i < limit_names.size(); ++i) {
    if (limits.ticks.at(i) == 0) continue;
    json[std::string(limit_names.at(i))] =
        static_cast<double>(limits.ticks.at(i)) / static_cast<double>(all_ticks);
  }
  return json;
}

}  // namespace

std::string fault_text(Fault fault) {
  return "fault " + std::to_string(static_cast<int>(fault)) + " " + std::string(name(fault)) +
         "; see " + explanation_of(fault);
}

std::string Summary::FaultEvent::text() const {
  std::array<char, 64> at{};
  std::snprintf(at.data(), at.size(), " at %.3f s", time_s);
  std::string line = "fault " + std::to_string(static_cast<int>(fault)) + " ";
  line += name(fault);
  line += at.data();
  if (std::isfinite(margin.measured) && std::isfinite(margin.limit)) {
    const bool rounding = std::abs(margin.measured) < 1e-9 * std::abs(margin.limit);
    line += ": " + number_text(rounding ? 0.0 : margin.measured, 3) + " measured, limit ";
    line += number_text(margin.limit, 3) + margin_unit_after(fault);
  }
  return line + " (see " + explanation_of(fault) + ")";
}

std::string Summary::never_armed_because(const Scenario& scenario,
                                         const Simulation& simulation) const {
  if (armed_) return {};
  if (const Fault fault = ended_in(); fault != Fault::none) return fault_text(fault);
  if (!arms(scenario.start.action))
    return "[operator] action is none or disarm at the start, and the operator arms only there";
  return simulation.loop().self_test().passed()
             ? "with these [thermal] bounds the muscle may still be hot from before the start"
             : "the self-test did not finish";
}

std::string Summary::did_not_follow_because(const Scenario& scenario,
                                            const std::optional<ScenarioPromise>& promise) const {
  // A motion that has just begun is small, and its error is largest at the beginning.
  constexpr double min_s = 10.0;
  if (static_cast<double>(tracking_.count()) * scenario.step_s() < min_s) return {};
  const double limit_m = unfollowed_m(promise, motion_.size_m());
  if (!(tracking_.rms() > limit_m)) return {};
  std::string text = number_text(1e3 * tracking_.rms(), 3) +
                     " mm rms from its reference model, for a motion of " +
                     number_text(1e3 * motion_.size_m(), 3) + " mm";
  if (promise)
    text += " and a promise of " + number_text(1e3 * promise->parts.error_m(), 3) + " mm";
  if (oscillated()) return text + ": the loop oscillated";
  if (const double period_s = limit_cycle_period_s(scenario); !std::isnan(period_s))
    return text + ": the loop oscillates with a period of " + number_text(period_s, 2) + " s";
  if (behind_by_reference()) return text + ": the reference asked for more than the muscle can do";
  if (diverged()) {
    return text +
           ": the loop oscillated or diverged, its power at a limit while the reference "
           "asked for no more than the muscle can do";
  }
  return text +
         ": the controller is too weak, or the muscle differs from the one that the board assumes";
}

double Summary::limit_cycle_period_s(const Scenario& scenario) const {
  double max_period_s = scenario.start.reference.min_period_s();
  for (const Event& event : scenario.events)
    max_period_s = std::fmin(max_period_s, event.conditions.reference.min_period_s());
  return limit_cycle_.period_s(max_period_s);
}

bool Summary::behind_by_reference() const {
  constexpr double most = 0.5;
  return infeasible_.found() && infeasible_tracking_.square_sum() > most * tracking_.square_sum();
}

ordered_json Summary::to_json(const Scenario& scenario,
                              const std::optional<ScenarioPromise>& promise,
                              const Simulation& simulation, double wall_s) const {
  const bool measured = tracking_.count() > 0;
  ordered_json json;
  json["schema_version"] = schema_version;
  json["program_version"] = program_version();
  json["scenario"] = scenario.name;
  json["scenario_crc32"] = scenario.crc32;
  json["board_crc32"] = scenario.board ? ordered_json(scenario.board_crc32) : nullptr;
  json["seed"] = scenario.seed;
  json["controller"] = control::name_of(control::controller_names, scenario.start.controller.kind);
  json["arithmetic"] =
      control::name_of(control::arithmetic_names, scenario.start.controller.arithmetic);
  json["events"] = scenario.events.size();
  // An interrupted run ended before its scenario.
  const double reached_s = static_cast<double>(ticks_) * scenario.step_s();
  json["window_s"] = {window_.from_s,
                      std::fmax(window_.from_s, std::fmin(window_.to_s, reached_s))};
  json["tracking_rms_m"] = measured ? finite(tracking_.rms()) : nullptr;
  json["tracking_max_m"] = measured ? finite(tracking_.max()) : nullptr;
  json["off_reference_rms_m"] = measured ? finite(off_reference_.rms()) : nullptr;
  json["tracking_shown_rms_m"] = measured ? finite(shown_.rms()) : nullptr;
  json["promised_rms_m"] = promise ? finite(promise->parts.error_m()) : nullptr;
  json["promised_by"] = nullptr;
  if (promise) json["promised_by"] = promise->of_own_controller ? "own" : "recommended";
  json["promised_on"] = nullptr;
  if (promise) json["promised_on"] = promise->of_reference ? "reference" : "first_motion";
  const std::string unfollowed = did_not_follow_because(scenario, promise);
  json["did_not_follow_because"] = unfollowed.empty() ? ordered_json() : ordered_json(unfollowed);
  if (scenario.start.joint) {
    const double deg_per_m =
        180.0 / std::numbers::pi / scenario.start.joint->plant.lever.zero_radius_m();
    json["tracking_rms_deg"] = measured ? finite(tracking_.rms() * deg_per_m) : nullptr;
    json["tracking_max_deg"] = measured ? finite(tracking_.max() * deg_per_m) : nullptr;
  }
  const auto estimate = simulation.estimate();
  json["estimates"] =
      estimate ? estimate_json(*estimate, simulation.conditions().muscle) : ordered_json();
  json["armed"] = armed_;
  const std::string never_armed = never_armed_because(scenario, simulation);
  json["never_armed_because"] = never_armed.empty() ? ordered_json() : ordered_json(never_armed);
  json["faults"] = ordered_json::array();
  for (const FaultEvent& f : faults_) {
    json["faults"].push_back({{"text", f.text()},
                              {"at_s", f.time_s},
                              {"number", static_cast<int>(f.fault)},
                              {"name", std::string(name(f.fault))},
                              {"measured", finite(f.margin.measured)},
                              {"limit", finite(f.margin.limit)},
                              {"page", page_of(f.fault)}});
  }
  const auto& learned = simulation.learned();
  json["learned"] = learned ? learned_json(*learned) : ordered_json();
  if (scenario.start.antagonist() != nullptr) {
    const auto& other = simulation.learned(1);
    json["learned_antagonist"] = other ? learned_json(*other) : ordered_json();
  }
  json["first_motion"] = ordered_json();
  if (const auto& motion = simulation.first_motion()) {
    json["first_motion"] = {{"promised_rms_m", finite(motion->promised_rms_m())},
                            {"rms_m", finite(motion->rms_m())}};
  }
  json["mode_result"] = mode_result_json(simulation.loop().channel(0).snapshot());
  json["ticks_outside_temperature_interval"] = outside_interval_ticks_;
  json["hottest_temperature_rise_K"] = finite(simulation.peak_temperature_rise_K());
  json["limited_ticks"] = limited_ticks_;
  json["limited_by_ratio"] = limits_json(limits_, ticks_);
  if (scenario.start.antagonist() != nullptr)
    json["antagonist_limited_by_ratio"] = limits_json(antagonist_limits_, ticks_);
  json["not_finite_ticks"] = not_finite_ticks_;
  json["oscillated_at_s"] = finite(oscillated_at_s_);
  json["oscillation_period_s"] = finite(oscillation_period_s_);
  const InfeasibleTime* too_much = infeasible();
  json["infeasible_ratio"] = too_much != nullptr ? finite(too_much->ratio()) : nullptr;
  json["infeasible_from_s"] = too_much != nullptr ? finite(too_much->first_s()) : nullptr;
  json["infeasible_lasts_s"] = too_much != nullptr ? finite(too_much->first_duration_s()) : nullptr;
  json["unasked_limit_ratio"] = finite(unasked_limit_ratio());
  json["limit_cycle_period_s"] = finite(limit_cycle_period_s(scenario));
  json["power_noise_W"] = finite(power_noise_W());
  json["ticks"] = ticks_;
  json["wall_s"] = wall_s;
  json["realtime_factor"] =
      wall_s > 0.0 ? finite(static_cast<double>(ticks_) * scenario.step_s() / wall_s) : nullptr;
  return json;
}

}  // namespace supercoil::host_sim
