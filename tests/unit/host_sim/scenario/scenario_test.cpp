#include <string>

#include <CppUTest/TestHarness.h>

#include "scenario/builtin.hpp"
#include "scenario/read_scenario.hpp"
#include "unit/host_sim/support/scenarios.hpp"

using namespace supercoil;
using namespace supercoil::host_sim;
using supercoil::test::read;

namespace {

/// Reads a scenario that must be in order.
}  // namespace

TEST_GROUP(ReadScenario){};

TEST(ReadScenario, EmptyTextIsThePapersMuscleWithTheDefaultController) {
  const Scenario s = read("");
  CHECK(s.start.plant.parameters == control::PhysicalParameters{});
  CHECK(s.start.controller.kind == control::ControllerKind::mrac);
  CHECK(s.start.estimator.kind == control::EstimatorKind::gradient);
  LONGS_EQUAL(200000, s.ticks());
  DOUBLES_EQUAL(0.0060393, s.start.controller.dc_gain_m_per_W, 1e-7);
}

TEST(ReadScenario, EveryKeySetsItsSetting) {
  const Scenario s = read(R"(
[simulation]
duration_s = 12.5
rate_Hz = 500
seed = 42
substeps = 4
[plant]
thermal_mass_J_per_K = 0.2
heat_transfer_W_per_K = 0.1
stiffness_N_per_m = 20.0
damping_Ns_per_m = 3.0
moving_mass_kg = 0.05
force_per_kelvin_N_per_K = 0.01
resistance_Ohm = 8.0
load_N = 0.01
[muscle]
stiffness_N_per_m = 18.0
[sensor.position]
noise_rms_m = 5e-6
resolution_bits = 12
range_m = 0.030
[power]
max_W = 4.0
min_W = 0.1
pwm_bits = 12
supply_V = 10.0
error_feedback = false
delay_s = 0.004
gain = 0.9
[thermal]
mass_ratio = [0.8, 1.2]
transfer_ratio = [0.5, 2.0]
power_ratio = [0.9, 1.1]
[ambient]
air_C = 21.0
warmest_C = 30.0
coldest_C = 10.0
sensor_error_K = 1.5
sensor_offset_K = -0.5
[senses]
error_ratio = 0.05
[injected_fault]
heater_open = true
[operator]
action = "identify"
[reference]
kind = "multisine"
offset_m = 0.010
amplitudes_m = [0.001, 0.002]
angular_frequencies_rad_per_s = [0.5, 2.0]
[reference_model]
kind = "poles"
poles_rad_per_s = [2.0, 3.0, 6.0]
[controller]
kind = "pd_ff"
arithmetic = "float"
proportional_W_per_m = 1500.0
derivative_Ws_per_m = 200.0
feedforward_W_per_m = 150.0
derivative_filter_rad_per_s = 50.0
[estimator]
kind = "gradient"
arithmetic = "q8.24"
gain = [1e6, 2e6, 3e6, 4e5]
initial = [10.0, 20.0, 200.0, 100.0]
lower = [1.0, 2.0, 3.0, 4.0]
upper = [100.0, 200.0, 3000.0, 1000.0]
normalisation = 1.0
window_s = 30.0
trusted_error = 0.1
)");
  LONGS_EQUAL(6250, s.ticks());
  LONGS_EQUAL(42, static_cast<long>(s.seed));
  LONGS_EQUAL(4, s.substeps);
  const Conditions& c = s.start;
  CHECK(c.plant.parameters == (control::PhysicalParameters{0.2, 0.1, 20.0, 3.0, 0.05, 0.01}));
  DOUBLES_EQUAL(0.01, c.plant.load_N, 0.0);
  DOUBLES_EQUAL(18.0, c.muscle.stiffness_N_per_m, 0.0);
  DOUBLES_EQUAL(0.2, c.muscle.thermal_mass_J_per_K, 0.0);
  PositionSensorSettings sensor;
  sensor.noise_rms_m = 5e-6;
  sensor.resolution_bits = 12;
  sensor.range_m = 0.030;
  CHECK(c.position_sensor == sensor);
  CHECK(c.power == (PowerSettings{4.0, 0.1, 4095, 10.0, false, 0.004, 0.9}));
  CHECK(c.thermal == (ThermalSpans{{0.8, 1.2}, {0.5, 2.0}, {0.9, 1.1}}));
  CHECK(c.ambient == (Ambient{21.0, 30.0, 10.0, 1.5, -0.5}));
  DOUBLES_EQUAL(0.05, c.sense_error_ratio, 0.0);
  CHECK(c.injected_faults == InjectedFaults{.heater_open = true});
  CHECK(c.action == OperatorAction::identify);
  CHECK(c.reference.kind == ReferenceKind::multisine);
  DOUBLES_EQUAL(0.013, c.reference.max(), 1e-15);
  DOUBLES_EQUAL(36.0, c.controller.model.gain, 1e-12);
  DOUBLES_EQUAL(11.0, c.controller.model.denominator[2], 1e-12);
  CHECK(c.controller.arithmetic == control::Arithmetic::float32);
  DOUBLES_EQUAL(0.01 / (0.1 * 18.0), c.controller.dc_gain_m_per_W, 1e-15);
  DOUBLES_EQUAL(1500.0, c.controller.pd_ff.proportional_W_per_m, 0.0);
  DOUBLES_EQUAL(50.0, c.controller.pd_ff.derivative_filter_rad_per_s, 0.0);
  CHECK(c.estimator.arithmetic == control::Arithmetic::q8_24);
  DOUBLES_EQUAL(3e6, c.estimator.gradient.gain[2], 0.0);
  DOUBLES_EQUAL(1000.0, c.estimator.gradient.bounds->upper[3], 0.0);
  DOUBLES_EQUAL(30.0, c.estimator.excitation.window_s, 0.0);
}

TEST(ReadScenario, NumericInjectedFaultsSetTheirSettings) {
  const InjectedFaults injected_faults =
      read("injected_fault = {current_gain = 0.8, supply_gain = 1.1, switch_leak_ratio = 0.05}")
          .start.injected_faults;
  CHECK(injected_faults ==
        (InjectedFaults{.current_gain = 0.8, .supply_gain = 1.1, .switch_leak_ratio = 0.05}));
}

TEST(ReadScenario, MracTakesAPresetAndOverrides) {
  const Scenario s = read(R"(
[controller]
kind = "mrac"
preset = "printed"
adaptation_scale = 10.0
damping = 1.5
gain = [1, 2, 3, 4, 5, 6]
lambda = [40.0, 400.0]
dead_zone_W = 0.001
)");
  const control::MracSettings& m = s.start.controller.mrac;
  DOUBLES_EQUAL(60.0, m.scaled_gain()[5], 1e-12);
  DOUBLES_EQUAL(40.0, m.scaled_sigma_gain(), 1e-12);
  DOUBLES_EQUAL(1.5, m.damping, 0.0);
  DOUBLES_EQUAL(40.0, m.lambda[1], 0.0);
  DOUBLES_EQUAL(400.0, m.lambda[0], 0.0);
  DOUBLES_EQUAL(0.001, m.dead_zone_W, 0.0);
}

TEST(ReadScenario, DefaultReferenceModelIsThatOfTheController) {
  DOUBLES_EQUAL(0.8, read("controller.kind = \"pi\"").start.controller.model.gain, 0.0);
  DOUBLES_EQUAL(16.0, read("controller.kind = \"mrac\"").start.controller.model.gain, 1e-12);
}

TEST(ReadScenario, EveryBuiltInScenarioIsValidAndHasADescription) {
  CHECK(builtin_scenarios().size() >= 5);
  for (const BuiltinScenario& builtin : builtin_scenarios()) {
    const auto scenario = read_scenario(std::string(builtin.name));
    CHECK_TEXT(scenario.has_value(), std::string(builtin.name).c_str());
    CHECK(description(builtin).size() > 20);
  }
}
