#include <algorithm>
#include <cmath>
#include <sstream>

#include "supercoil/control/actuator/conversions.hpp"

#include "board/applied_power.hpp"
#include "config/read_control.hpp"
#include "config/section.hpp"
#include "scenario/read_tables.hpp"

namespace supercoil::host_sim {

namespace {

using config::Diagnostics;
using config::refuse_misfit;
using config::Section;

/// A muscle other than the paper's may become longer than it was: its sensor sees some of that.
constexpr double default_min_ratio = -0.25;
constexpr double min_position_rate_Hz = 20.0;
/// Of a reading, whose counts are 32 bits wide.
constexpr int max_bits = 30;
/// To both sides.
constexpr double joint_range_m = 0.008;
constexpr double spring_joint_range_m = 0.011;

Moves what_moves(const Conditions& c) {
  if (c.joint) return c.joint->antagonist ? Moves::joint : Moves::spring_joint;
  return c.plant.effects.any() ? Moves::load : Moves::paper_load;
}

PositionSensorSettings read_position_sensor(Section section, Moves moves) {
  PositionSensorSettings sensor;
  if (moves == Moves::joint) sensor.range_m = joint_range_m;
  if (moves == Moves::spring_joint) sensor.range_m = spring_joint_range_m;
  sensor.noise_rms_m = section.number("noise_rms_m", sensor.noise_rms_m, {0.0, 0.1});
  sensor.resolution_bits =
      static_cast<int>(section.integer("resolution_bits", sensor.resolution_bits, 0, max_bits));
  sensor.range_m = section.number("range_m", sensor.range_m, {1e-4, 10.0});
  sensor.count_m = section.number("count_m", sensor.count_m, {0.0, 0.1 * sensor.range_m});
  if (sensor.count_m > 0.0 && section.has("resolution_bits")) {
    section.wrong("count_m",
                  "cannot be combined with resolution_bits: both set the size of a count");
  }
  sensor.rate_Hz = section.number("rate_Hz", sensor.rate_Hz, {0.0, 10e3});
  if (sensor.rate_Hz > 0.0 && sensor.rate_Hz < min_position_rate_Hz)
    section.wrong("rate_Hz", "must be 0 (whenever the board asks) or 20 to 10000");
  double min_m = moves == Moves::paper_load ? 0.0 : default_min_ratio * sensor.range_m;
  if (moves == Moves::joint) min_m = -sensor.range_m;
  // A joint moves to both sides, and its antagonist's travel is what lies below zero.
  sensor.min_m = section.number("min_m", min_m, {-10.0, moves == Moves::joint ? -1e-4 : 0.0});
  const double min_count_m = (sensor.range_m - sensor.min_m) / (1 << max_bits);
  if (sensor.count_m > 0.0 && sensor.count_m < min_count_m) {
    std::ostringstream message;
    message << "must be 0 or at least the sensor's span over 2^" << max_bits << ", " << min_count_m
            << " m";
    section.wrong("count_m", message.str());
  }
  section.finish();
  return sensor;
}

ThermometerSettings read_thermometer(Section section) {
  ThermometerSettings thermometer;
  thermometer.present = section.table() != nullptr;
  thermometer.lag_s = section.number("lag_s", thermometer.lag_s, {0.0, 1000.0});
  thermometer.offset_K = section.number("offset_K", thermometer.offset_K, {-50.0, 50.0});
  thermometer.noise_rms_K = section.number("noise_rms_K", thermometer.noise_rms_K, {0.0, 50.0});
  thermometer.rate_Hz = section.number("rate_Hz", thermometer.rate_Hz, {0.01, 10e3});
  section.finish();
  return thermometer;
}

/// Refuses powers that a supply over this resistance cannot give, and too coarse ones.
void check_power(Section& section, const PowerSettings& power, double resistance_Ohm) {
  const double full_scale_W = power.supply_V * power.supply_V / resistance_Ohm;
  std::ostringstream message;
  if (power.max_W > full_scale_W) {
    message << "must not exceed what the supply gives at a duty of 1: supply_V²/resistance_Ohm = "
            << full_scale_W << " W";
    return section.wrong("max_W", message.str());
  }
  if (power.pwm_steps == 0) return;
  const double step_W = full_scale_W / power.pwm_steps;
  if (std::ceil(power.min_W / step_W) > std::floor(power.max_W / step_W) || power.max_W < step_W) {
    message << "makes the power steps too coarse: one step is " << step_W
            << " W, and no step lies within min_W to max_W";
    section.wrong("pwm_bits", message.str());
  } else if (const double duty = HeaterSettings{}.probe_duty; duty * power.pwm_steps < 1.0) {
    message << "makes the power steps too coarse: a probe's duty, " << duty
            << ", is less than one of " << power.pwm_steps << " steps";
    section.wrong("pwm_bits", message.str());
  }
}

PowerSettings read_power(Section section, double resistance_Ohm, double step_s, Hardware hardware) {
  PowerSettings power;
  power.max_W = section.number("max_W", power.max_W, {1e-3, 1e3});
  power.min_W = section.number("min_W", power.min_W, {0.0, 1e3});
  if (!(power.min_W < power.max_W)) section.wrong("min_W", "must be less than max_W");
  const auto pwm_bits = static_cast<int>(section.integer("pwm_bits", 0, 0, 24));
  power.pwm_steps = (1 << pwm_bits) - 1;
  power.supply_V = section.number("supply_V", power.supply_V, {0.5, 60.0});
  if (hardware == Hardware::scenarios) check_power(section, power, resistance_Ohm);
  power.error_feedback = section.flag("error_feedback", power.error_feedback);
  const double max_s = static_cast<double>(board::OutputDelay::max_ticks) * step_s;
  power.delay_s = section.number("delay_s", power.delay_s, {0.0, max_s});
  power.gain = section.number("gain", power.gain, {0.01, 10.0});
  section.finish();
  return power;
}

std::array<double, 2> read_span(Section& section, const char* key,
                                const std::array<double, 2>& fallback) {
  const auto span = section.numbers(key, {fallback[0], fallback[1]}, {0.01, 100.0}, 2, 2);
  if (!(span[0] <= 1.0 && span[1] >= 1.0)) section.wrong(key, "must be [a, b] with a <= 1 <= b");
  return {span[0], span[1]};
}

ThermalSpans read_thermal(Section section) {
  ThermalSpans t;
  t.mass_ratio = read_span(section, "mass_ratio", t.mass_ratio);
  t.transfer_ratio = read_span(section, "transfer_ratio", t.transfer_ratio);
  t.power_ratio = read_span(section, "power_ratio", t.power_ratio);
  section.finish();
  return t;
}

Ambient read_ambient(Section section) {
  constexpr config::Range air{-40.0, 80.0};
  Ambient a;
  a.air_C = section.number("air_C", a.air_C, air);
  a.warmest_C = section.number("warmest_C", a.warmest_C, air);
  a.coldest_C = section.number("coldest_C", a.coldest_C, air);
  if (a.coldest_C > a.warmest_C) section.wrong("coldest_C", "must not exceed warmest_C");
  a.sensor_error_K = section.number("sensor_error_K", a.sensor_error_K, {0.0, 20.0});
  a.sensor_offset_K = section.number("sensor_offset_K", a.sensor_offset_K, {-100.0, 100.0});
  section.finish();
  return a;
}

/// The result of a comparison of the senses with a meter.
double read_senses(Section section) {
  const double error_ratio =
      section.number("error_ratio", Conditions{}.sense_error_ratio, {0.0, 0.2});
  section.finish();
  return error_ratio;
}

InjectedFaults read_injected_faults(Section section, const Conditions& c) {
  const auto refuse_missing = [&](const char* key, Needs needs) {
    if (!section.has(key) || needs == Needs::muscle) return;
    if (needs == Needs::bundle && c.companions.empty())
      return section.wrong(key, "needs a [bundle]");
    if (needs == Needs::bundle) return;
    if (!c.joint) return section.wrong(key, "needs a [joint]");
    if (needs == Needs::antagonist && c.antagonist() == nullptr)
      section.wrong(key, "needs [joint] opposed_by = \"muscle\"");
  };
  InjectedFaults injected_faults;
  for (const InjectedFaultName& known : injected_fault_names) {
    injected_faults.*known.member = section.flag(known.name, false);
    refuse_missing(known.name, known.needs);
  }
  for (const InjectedFaultNumber& known : injected_fault_numbers) {
    injected_faults.*known.member =
        section.number(known.name, InjectedFaults{}.*known.member, {known.min, known.max});
    refuse_missing(known.name, known.needs);
  }
  const double broken = injected_faults.open_heater_in_bundle;
  const double muscles = static_cast<double>(c.companions.size()) + 1.0;
  if (!c.companions.empty() && (broken != std::floor(broken) || broken > muscles)) {
    section.wrong("open_heater_in_bundle", "must be the number of a muscle, 1 to " +
                                               std::to_string(std::lround(muscles)) + ", or 0");
  }
  section.finish();
  return injected_faults;
}

OperatorAction read_operator(Section section) {
  const OperatorAction action =
      section.choice("action", OperatorAction::track, operator_action_names);
  section.finish();
  return action;
}

/// Refuses a reference that the muscle cannot reach, so that the run need not reveal it.
void check_reach(Section& section, const Conditions& c) {
  if (c.reference.kind == ReferenceKind::power) return;
  std::ostringstream message;
  if (c.joint) {
    const PlaceInJoint agonist{.direction = 1, .lever = c.joint->plant.lever};
    const auto contracted_m = [&](double reading_m) {
      return agonist.position_of_reading_m(Conditions::travel_ratio * reading_m);
    };
    const PositionSensorSettings& sensor = c.position_sensor;
    const bool pair = c.antagonist() != nullptr;  // against a spring the muscle only pulls
    const double min_m = pair ? std::max(contracted_m(sensor.min_m),
                                         agonist.position_m(c.joint->plant.min_angle_rad))
                              : 0.0;
    const double max_m =
        std::min(contracted_m(sensor.range_m), agonist.position_m(c.joint->plant.max_angle_rad));
    if (c.reference.min() >= min_m && c.reference.max() <= max_m) return;
    message << "the reference goes from " << c.reference.min() * 1e3 << " to "
            << c.reference.max() * 1e3 << " mm, but sensor.position and the joint's end stops "
            << "allow " << min_m * 1e3 << " to " << max_m * 1e3 << " mm";
  } else if (c.reference.min() < 0.0) {
    message << "the reference goes down to " << c.reference.min() * 1e3
            << " mm, but the muscle only contracts from 0";
  } else if (c.reference.max() > Conditions::travel_ratio * c.position_sensor.range_m) {
    message << "the reference goes up to " << c.reference.max() * 1e3
            << " mm, but sensor.position.range_m is " << c.position_sensor.range_m * 1e3 << " mm";
  } else {
    return;
  }
  section.wrong("kind", message.str());
}

}  // namespace

Conditions read_conditions(const toml::table& document, const BelievedMuscles& believed,
                           double step_s, Hardware hardware, Diagnostics& diagnostics) {
  Section root(&document, "", diagnostics);
  Conditions c;
  c.muscle = believed.muscle;
  root.allow({"simulation", "muscle", "joint", "bundle", "event"});  // read elsewhere
  c.plant = read_plant(root.section("plant"));
  c.joint = read_joint(document, c.plant, believed.antagonist, diagnostics);
  c.companions = read_companions(document, diagnostics);
  Section sensor = root.section("sensor");
  const Moves moves = what_moves(c);
  c.position_sensor = read_position_sensor(sensor.section("position"), moves);
  c.thermometer = read_thermometer(sensor.section("temperature"));
  sensor.finish();
  double max_Ohm = c.plant.resistance_Ohm;
  if (c.antagonist() != nullptr) max_Ohm = std::max(max_Ohm, c.antagonist()->plant.resistance_Ohm);
  for (const PlantSettings& companion : c.companions)
    max_Ohm = std::max(max_Ohm, companion.resistance_Ohm);
  c.power = read_power(root.section("power"), max_Ohm, step_s, hardware);
  if (c.antagonist() != nullptr) {
    c.joint->antagonist->co_contraction_W =
        read_co_contraction_W(document, c.power.max_W, diagnostics);
  }
  c.thermal = read_thermal(root.section("thermal"));
  c.ambient = read_ambient(root.section("ambient"));
  c.sense_error_ratio = read_senses(root.section("senses"));
  c.injected_faults = read_injected_faults(root.section("injected_fault"), c);
  c.action = read_operator(root.section("operator"));
  Section reference = root.section("reference");
  c.reference = read_reference(reference, moves);
  Section estimator = root.section("estimator");
  c.estimator = config::read_estimator(estimator, believed.muscle, c.power.max_W);
  const auto model = config::read_reference_model(root.section("reference_model"));
  Section controller = root.section("controller");
  c.controller = config::read_controller(controller, believed.muscle, model, c.power.max_W);
  if (c.controller.kind == control::ControllerKind::power &&
      c.reference.kind != ReferenceKind::power) {
    controller.wrong("kind", "open loop needs [reference] kind = \"power\"");
  }
  if (c.controller.kind != control::ControllerKind::power &&
      c.reference.kind == ReferenceKind::power) {
    reference.wrong("kind", "needs [controller] kind = \"power\": a controller follows a position");
  }
  if (hardware == Hardware::scenarios) check_reach(reference, c);
  const bool follows = c.reference.kind != ReferenceKind::power;
  const double max_reference_m = std::max(c.reference.max(), -c.reference.min());
  refuse_misfit(controller, control::check_fit(c.controller, step_s,
                                               follows ? max_reference_m : 0.0, c.power.max_W));
  refuse_misfit(estimator, control::check_fit(c.estimator, step_s, c.power.max_W));
  root.finish();
  return c;
}

}  // namespace supercoil::host_sim
