// Numbers, names and thresholds in docs/ agree with the code.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <CppUTest/TestHarness.h>

#include "loop/command.hpp"
#include "supervisor/fault.hpp"
#include "supervisor/limiter.hpp"
#include "supervisor/supervision.hpp"

using namespace supercoil;

namespace {

using Row = std::vector<std::string>;

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" `[");
  const auto last = text.find_last_not_of(" `]");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::string page(const std::string& path) {
  std::ifstream file(SUPERCOIL_DOCS "/" + path);
  CHECK_TEXT(file.good(), path.c_str());
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// The table's cells, without its header.
std::vector<Row> first_table_after(const std::string& heading, const std::string& path) {
  std::istringstream text(page(path));
  std::vector<Row> rows;
  std::string line;
  while (std::getline(text, line) && line != heading) {
  }
  while (std::getline(text, line) && (rows.empty() || !line.empty())) {
    if (line.rfind("| ", 0) != 0) continue;
    Row row;
    std::istringstream cells(line.substr(1));
    for (std::string cell; std::getline(cells, cell, '|');)
      row.push_back(trimmed(cell));
    rows.push_back(row);
  }
  CHECK_TEXT(!rows.empty(), heading.c_str());
  rows.erase(rows.begin());
  return rows;
}

template <class Name>
void check_names(const std::string& signal, const std::vector<Name>& all) {
  const auto rows = first_table_after("## Names of " + signal, "can-protocol.md");
  UNSIGNED_LONGS_EQUAL(rows.size(), all.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    LONGS_EQUAL(std::stol(rows[i].at(0)), static_cast<long>(all[i]));
    STRCMP_EQUAL(rows[i].at(1).c_str(), std::string(name(all[i])).c_str());
  }
}

/// The page has lines of a fixed width, so a space may be a line break. `text` has one `%g` for the
/// value.
void check_says(const std::string& fault, const char* text, double value) {
  char wanted[200];
  std::snprintf(wanted, sizeof wanted, text, value);
  std::string all = page("faults/" + fault + ".md");
  std::replace(all.begin(), all.end(), '\n', ' ');
  CHECK_TEXT(all.find(wanted) != std::string::npos, (fault + ": " + wanted).c_str());
}

}  // namespace

TEST_GROUP(Documented){};

TEST(Documented, FaultsMatchTheirTable) {
  const auto rows = first_table_after("# Faults", "faults/README.md");
  UNSIGNED_LONGS_EQUAL(rows.size(), all_faults().size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const FaultInfo& fault = all_faults()[i];
    const Row& row = rows[i];
    LONGS_EQUAL(std::stol(row.at(0)), static_cast<long>(fault.fault));
    STRCMP_EQUAL(row.at(1).c_str(), std::string(fault.name).c_str());
    STRCMP_EQUAL(row.at(2).c_str(), std::string(fault.group).c_str());
    STRCMP_EQUAL(row.at(3).c_str(), fault.scope == Scope::board ? "board" : "channel");
  }
}

TEST(Documented, NumbersOnTheBusMatchTheProtocol) {
  check_names<State>("state", {State::disarmed, State::armed, State::active, State::fault});
  check_names<Refusal>(
      "refusal",
      {Refusal::none, Refusal::wrong_state, Refusal::cause_persists, Refusal::no_edge,
       Refusal::not_ready, Refusal::busy, Refusal::out_of_range, Refusal::no_such_channel,
       Refusal::not_lease_holder, Refusal::no_lease, Refusal::wrong_counter, Refusal::queue_full,
       Refusal::claim_again, Refusal::protocol_mismatch, Refusal::unsuitable, Refusal::infeasible});
  check_names<LimitedBy>("limited_by", {LimitedBy::nothing, LimitedBy::minimum, LimitedBy::maximum,
                                        LimitedBy::slew, LimitedBy::temperature, LimitedBy::invalid,
                                        LimitedBy::cooling, LimitedBy::unproven});
  std::vector<Fault> faults{Fault::none};
  for (const FaultInfo& fault : all_faults())
    faults.push_back(fault.fault);
  check_names<Fault>("fault", faults);
}

TEST(Documented, ThresholdsOfAChannelAreTheDefaults) {
  const ChannelSupervision s;
  check_says("sensor_out_of_range", "below −%g mm", -1e3 * s.min_position_m);
  check_says("sensor_out_of_range", "above %g mm", 1e3 * s.max_position_m);
  check_says("sensor_out_of_range", "for %g ms without interruption", 1e3 * s.out_of_range_s);
  check_says("sensor_frozen", "`position.noise_rms_m` = %g µm", 1e6 * s.position_noise_rms_m);
  check_says("sensor_frozen", "for %g s", s.frozen_s);
  check_says("sensor_jump", "than %g m/s times", s.max_speed_m_per_s);
  check_says("sensors_disagree", "more than %g K", s.disagree_K);
  check_says("sensors_disagree", "K for %g s", s.disagree_s);
  check_says("heater_open", "is at least %g %%", 1e2 * s.open_min_duty);
  check_says("heater_open", "for %g ms", 1e3 * s.open_s);
  check_says("heater_short", "duty × supply / %g Ω", s.min_resistance_Ohm);
  check_says("heater_short", "for %g ms", 1e3 * s.short_s);
  check_says("heater_stuck_on", "is above %g mA", 1e3 * s.off_current_A);
  check_says("heater_stuck_on", "for %g ms without interruption", 1e3 * s.stuck_on_s);
  check_says("heater_not_responding", "window of %g s", s.responding_window_s);
  check_says("heater_not_responding", "less than %g of", s.responding_ratio);
  check_says("heater_not_responding", "at least %g mm", 1e3 * s.responding_min_m);
  check_says("duty_wrong", "for %g ms", 1e3 * s.wrong_duty_s);
  check_says("over_temperature", "is above %g °C (`trip_C`)", s.trip_C);
  check_says("over_travel", "is above %g mm", 1e3 * s.max_travel_m);
  check_says("energy_budget_exceeded", "%g J for 4.5 W", s.energy_J);
  check_says("energy_budget_exceeded", "4.5 W and %g s", s.energy_window_s);
  check_says("resistance_drift", "More than %g %% either way", 1e2 * s.resistance_ratio);
  check_says("power_limit_exceeded", "(%.2g W for 4.5 W)", s.max_measured_W);
  check_says("power_limit_exceeded", "for %g ms", 1e3 * s.over_power_s);
  check_says("command_timeout", "for more than %g s", s.command_timeout_s);
  LONGS_EQUAL(10, s.damaged_in_a_row);  // "the tenth tick in a row"
  LONGS_EQUAL(10, s.refused_in_a_row);
  check_says("controller_invalid", "for %g s without interruption", s.saturated_s);
  CHECK(s.proof_of_response);
}

TEST(Documented, ThresholdsOfABoardAreTheDefaults) {
  const BoardSupervision s;
  check_says("under_voltage", "below %g V", s.min_supply_V);
  check_says("under_voltage", "for %g ms", 1e3 * s.supply_s);
  check_says("over_voltage", "more than %g V", s.max_supply_V);
  check_says("tick_late", "%g ms", 1e3 * s.late_s);
  check_says("tick_late", "%g consecutive ticks", s.late_in_a_row);
  check_says("overrun", "when %g periods", s.overruns_in_a_row);
  check_says("emergency_stop", "the pump's decay, %g ms", 1e3 * s.charge_pump_decay_s);
  check_says("telemetry_dead", "%g s", s.telemetry_timeout_s);
  check_says("bus_off", "`can_bus_off_ms` is %g: at once", 1e3 * s.bus_off_s);
  check_says("bus_error_passive", "for %g s without interruption", s.bus_error_passive_s);
}

TEST(Documented, LimitsOfPowerAndTemperatureAreTheDefaults) {
  const LimiterSettings s;
  check_says("over_temperature", "from %g °C on, the power is derated", s.derate_from_C);
  check_says("over_temperature", "to zero at %g °C", s.derate_to_C);
  check_says("command_timeout", "full power (%g W)", s.max_W);
  DOUBLES_EQUAL(0.0, s.min_W, 0.0);
}

TEST(Documented, VerbsHaveTheNumbersOfTheProtocol) {
  const auto rows = first_table_after("## Names of opcode", "can-protocol.md");
  const std::vector<Verb> verbs{Verb::arm,       Verb::disarm, Verb::reset,      Verb::position,
                                Verb::power,     Verb::renew,  Verb::rest,       Verb::identify,
                                Verb::calibrate, Verb::scale,  Verb::controller, Verb::estimator,
                                Verb::store};
  for (std::size_t i = 0; i < verbs.size(); ++i) {
    LONGS_EQUAL(std::stol(rows.at(i + 1).at(0)), static_cast<long>(verbs[i]));
    STRCMP_EQUAL(rows[i + 1].at(1).c_str(), std::string(name(verbs[i])).c_str());
  }
}
