#include "setup/held_out.hpp"

#include <cmath>
#include <numbers>
#include <random>
#include <sstream>

#include "supercoil/control/actuator/parameters.hpp"

namespace supercoil::test {

namespace {

using operating::QuestionId;

class Dice {
 public:
  explicit Dice(unsigned seed) : random_(seed) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  /// Equally likely in each octave.
  double over(double low, double high) { return low * std::pow(high / low, between(0.0, 1.0)); }

 private:
  std::mt19937 random_;
};

struct Drawn {
  control::PhysicalParameters muscle;
  double travel_m = 0.0;  ///< at full_K
  double max_W = 0.0;
  double cold_Ohm = 0.0;
};

/// The rise above the air at which a muscle of thread has the travel that it can make for long.
constexpr double full_K = 80.0;
constexpr double supply_V = 12.0;
constexpr double gravity_m_per_s2 = 9.81;

Drawn drawn_muscle(Dice& dice, double slower) {
  Drawn d;
  control::PhysicalParameters& m = d.muscle;
  m.thermal_mass_J_per_K = dice.over(0.05, 0.5);
  m.heat_transfer_W_per_K = m.thermal_mass_J_per_K / dice.over(1.0, 12.0);
  m.thermal_mass_J_per_K *= slower;
  m.stiffness_N_per_m = dice.over(8.0, 80.0);
  m.moving_mass_kg = dice.over(0.03, 0.3);
  m.damping_Ns_per_m =
      2.0 * dice.over(0.25, 2.0) * std::sqrt(m.stiffness_N_per_m * m.moving_mass_kg);
  d.travel_m = dice.over(0.003, 0.02);
  m.force_per_kelvin_N_per_K = d.travel_m * m.stiffness_N_per_m / full_K;
  d.max_W = dice.between(1.2, 1.8) * full_K * m.heat_transfer_W_per_K;
  // Even the min supply can give more than max_W.
  d.cold_Ohm = dice.between(0.4, 0.7) * supply_V * supply_V / d.max_W;
  return d;
}

std::string effects_of(Dice& dice, const Drawn& d) {
  // A softer muscle hangs lower, but by less than it contracts: otherwise it would not be a muscle.
  const double hangs_m = d.muscle.moving_mass_kg * gravity_m_per_s2 / d.muscle.stiffness_N_per_m;
  const double softening = std::fmin(0.4, 0.4 * d.travel_m / hangs_m);
  std::ostringstream text;
  text << "convection_ratio = " << dice.between(0.0, 0.7)
       << "\nradiation_ratio = " << dice.between(0.0, 0.3)
       << "\nforce_ratio = " << dice.between(1.0, 3.0)
       << "\nhysteresis_ratio = " << dice.between(0.0, 0.08)
       << "\ncreep_ratio = " << dice.between(0.0, 0.04)
       << "\nsoftening_ratio = " << dice.between(0.0, softening) << '\n';
  return text.str();
}

}  // namespace

HeldOut held_out_muscle(unsigned seed, double error, double slower) {
  Dice dice(seed * 7919U);
  const Drawn d = drawn_muscle(dice, slower);
  HeldOut h;
  h.time_constant_s = -1.0 / d.muscle.thermal_pole_rad_per_s();
  h.linear = seed % 2 == 0;
  std::ostringstream text;
  text << "simulation = {seed = " << seed << ", duration_s = 1e6}\noperator.action = 'none'\n"
       << "power = {supply_V = " << supply_V << ", max_W = " << d.max_W << "}\n[plant]\n"
       << "resistance_Ohm = " << d.cold_Ohm << '\n';
  for (const control::PhysicalRange& range : control::physical_ranges)
    text << range.name << " = " << d.muscle.*range.member << '\n';
  if (!h.linear)
    text << effects_of(dice, d) << "hanging_mass_kg = " << d.muscle.moving_mass_kg << '\n';
  h.scenario = text.str();

  const auto says = [&](QuestionId what, double truth, double wrong) {
    h.answers.set(static_cast<std::size_t>(what), truth * dice.between(1.0 - wrong, 1.0 + wrong));
  };
  constexpr double weight_g = 50.0;
  const double heated_W = 0.5 * full_K * d.muscle.heat_transfer_W_per_K;
  says(QuestionId::cold_resistance_Ohm, d.cold_Ohm, 0.02);
  says(QuestionId::load_g, 1e3 * d.muscle.moving_mass_kg, error);
  says(QuestionId::stretch_weight_g, weight_g, 0.0);
  says(QuestionId::stretch_mm, weight_g * gravity_m_per_s2 / d.muscle.stiffness_N_per_m, error);
  says(QuestionId::heated_W, heated_W, 0.0);
  says(QuestionId::heated_mm, 1e3 * heated_W * d.muscle.dc_gain_m_per_W(), error);
  says(QuestionId::half_cooling_s, h.time_constant_s * std::numbers::ln2, error);
  says(QuestionId::thread_g, d.muscle.thermal_mass_J_per_K / 1.65, error);
  says(QuestionId::heated_K, 0.0, 0.0);
  says(QuestionId::max_W, d.max_W, 0.0);
  says(QuestionId::max_travel_mm, 1e3 * d.travel_m, 0.0);
  says(QuestionId::uncertainty_percent, 1e2 * error, 0.0);
  return h;
}

std::string held_out_board(double cold_resistance_Ohm, double max_W) {
  std::ostringstream text;
  text << R"([board]
name = "held out"
rate_Hz = 1000.0
charge_pump_decay_ms = 20.0
[lines]
chip = "chip"
heartbeat = { line = "heartbeat" }
stop_circuit = { line = "stop" }
[ambient]
coldest_C = 25.0
warmest_C = 25.0
[supply]
device = "adc"
input = "voltage0"
V_per_count = 0.005
min_V = 10.8
max_V = 13.2
[[channel]]
enable = { line = "enable" }
pwm = { device = "pwm", number = 0, steps = 10000 }
position = { device = "adc", input = "voltage1", m_per_count = 1e-6, min_m = -0.02, max_m = 0.04 }
current = { device = "adc", input = "voltage2", A_per_count = 1e-4, off_A = 0.01 }
thermal = { min_mass_J_per_K = 0.1, max_mass_J_per_K = 1.0, min_transfer_W_per_K = 0.05, max_transfer_W_per_K = 1.0 }
heater = { cold_resistance_Ohm = )"
       << cold_resistance_Ohm << " }\nlimits = { max_W = " << max_W << ", max_travel_m = 0.02 }\n";
  return text.str();
}

}  // namespace supercoil::test
