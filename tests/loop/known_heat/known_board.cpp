#include "loop/known_heat/known_board.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <string>

#include "loop/executive.hpp"
#include "simulated_board/simulated_board.hpp"

namespace supercoil::test {

namespace {

constexpr double air_C = 20.0;
constexpr double air_error_K = 2.0;
constexpr double sense_error_ratio = 0.02;
constexpr double mass_error_ratio = 0.03;
constexpr double thermometer_error_K = 1.0;
/// Far more than any muscle needs for 160 °C, so that only the hot end limits the power.
constexpr double ample_ratio = 6.0;
constexpr double peak_W = 25.0;
constexpr double heater_Ohm = 5.0;
constexpr int max_identify_s = 2000;

/// True values of what the board knows with an error.
struct Truth {
  double air_C;
  double supply_gain;  ///< true over measured
  double current_gain;
  double weighed_ratio;  ///< weighed over true
  double read_error_K;

  explicit Truth(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto up_to = [&](double error) {
      return std::uniform_real_distribution<double>(-error, error)(random);
    };
    air_C = test::air_C + up_to(air_error_K);
    supply_gain = 1.0 + up_to(sense_error_ratio);
    current_gain = 1.0 + up_to(sense_error_ratio);
    weighed_ratio = 1.0 / (1.0 + up_to(mass_error_ratio));
    read_error_K = up_to(thermometer_error_K);
  }
};

/// Gives a converter a gain error that the board does not know of.
void set_gain_error(host_sim::ConverterSettings& converter, double true_over_measured) {
  converter.low *= true_over_measured;
  converter.high *= true_over_measured;
}

board::Scaling scaling(const host_sim::ConverterSettings& converter) {
  return {converter.per_count(), converter.low};
}

control::ControllerSettings pi() {
  control::ControllerSettings c;
  c.kind = control::ControllerKind::pi;
  c.model = control::design_model();
  return c;
}

/// The board and its muscle from one start to the next.
class Life {
 public:
  Life(const MuscleCase& muscle, Knowledge knowledge, const Truth& truth, double max_W,
       const board::ThermalFacts& facts, std::uint64_t seed, Findings& findings)
      : muscle_(muscle),
        truth_(truth),
        findings_(findings),
        simulated_(simulated(muscle, truth, seed)),
        settings_(firmware(muscle, knowledge, truth, max_W, facts)),
        board_(simulated_),
        loop_(settings_, board_.devices()),
        executive_(loop_, board_, settings_.rate_Hz) {
    host_sim::MuscleChannelSettings miscalibrated = simulated_.channels[0];
    set_gain_error(miscalibrated.current, truth.current_gain);
    board_.channel(0).current.set(miscalibrated.current);
    host_sim::ConverterSettings supply = simulated_.supply;
    set_gain_error(supply, truth.supply_gain);
    board_.supply.set(supply);
    run(Verb::none, 0.0, 1.0);
    run(Verb::none, 0.0, 2.0 * believed_s());
    command(Verb::arm, 0.0);
    run(Verb::none, 0.0, 0.3);
  }

  /// Repeats the command all the time; its value may depend on time.
  template <class Value>
  void run_with(Verb verb, const Value& value, double time_s) {
    const double start_s = this->time_s();
    while (this->time_s() < start_s + time_s) {
      const bool ended = verb == Verb::renew && state() != State::active;
      if (ticks_++ % 50 == 0 && verb != Verb::none && !ended)
        command(verb, value(this->time_s() - start_s));
      tick();
    }
  }
  void run(Verb verb, double value, double time_s) {
    run_with(
        verb, [value](double) { return value; }, time_s);
  }
  void command(Verb verb, double value) { loop_.send({0, verb, value}); }
  void note_widths(std::vector<double>* widths_K) { widths_K_ = widths_K; }
  /// The last learned update that the channel handed over.
  std::optional<board::Learned> update() {
    std::optional<board::Learned> last;
    for (board::LearnedUpdate update; loop_.channel(0).take_learned_update(update);)
      last = update;
    return last;
  }
  bool active() const { return state() == State::active; }
  double rise_K() const { return board_.channel(0).plant().temperature_rise_K(); }
  /// The believed time constant.
  double believed_s() const {
    return settings_.channels[0].muscle.thermal_mass_J_per_K /
           settings_.channels[0].muscle.heat_transfer_W_per_K;
  }
  double slowest_s() const {
    const control::ThermalBounds& b = settings_.channels[0].thermal.bounds;
    return b.max_mass_J_per_K / b.min_transfer_W_per_K;
  }

 private:
  static host_sim::SimulatedBoardSettings simulated(const MuscleCase& muscle, const Truth& truth,
                                                    std::uint64_t seed) {
    const host_sim::PresetMuscle preset = host_sim::preset_muscle(muscle.preset);
    host_sim::SimulatedBoardSettings s;
    s.seed = seed;
    s.supply = {0.0, 30.0, 16, 0.005};
    host_sim::MuscleChannelSettings& channel = s.channels[0];
    channel.plant = preset.parameters;
    channel.plant.heat_transfer_W_per_K *= muscle.cooling_ratio;
    channel.effects = preset.effects;
    channel.effects.air_C = channel.rise_from_C = truth.air_C;
    channel.pwm_steps = 65535;
    channel.resistance_Ohm = heater_Ohm;
    channel.position = {-0.05, 0.75, 18, 10e-6};
    channel.current = {-0.1, 6.0, 16, 0.001};
    return s;
  }
  BoardSettings firmware(const MuscleCase& muscle, Knowledge knowledge, const Truth& truth,
                         double max_W, const board::ThermalFacts& facts) const {
    BoardSettings s;
    s.supply.scaling = scaling(simulated_.supply);
    ChannelSettings& c = s.channels[0];
    const control::PhysicalParameters believed = host_sim::preset_muscle(muscle.preset).parameters;
    c.muscle = believed;
    c.heat = facts;
    c.position.scaling = scaling(simulated_.channels[0].position);
    c.heater.current.scaling = scaling(simulated_.channels[0].current);
    c.heater.cold_resistance_Ohm = c.calibration.cold_resistance_Ohm = heater_Ohm;
    c.supervision.min_resistance_Ohm = 0.5 * heater_Ohm;
    c.supervision.min_position_m = -0.05;
    c.supervision.max_position_m = 0.75;
    c.supervision.max_travel_m = muscle.preset == host_sim::MusclePreset::b ? 0.1 : 0.7;
    c.supervision.max_measured_W = default_max_measured_W(max_W);
    c.supervision.energy_J = default_energy_J(max_W, c.supervision.energy_window_s);
    c.limiter.max_W = max_W;
    c.supervision.saturated_s = 600.0;  // the test demands too much on purpose
    c.controllers = {pi()};
    c.estimators[0].kind = control::EstimatorKind::none;

    board::ThermalSettings& t = c.thermal;
    const double least = std::min(0.45, 0.4 * muscle.cooling_ratio);
    t.bounds = {0.75 * believed.thermal_mass_J_per_K, 1.35 * believed.thermal_mass_J_per_K,
                least * believed.heat_transfer_W_per_K, 2.2 * believed.heat_transfer_W_per_K};
    t.boot_rise_K = 20.0;  // the muscle is known to be cold
    const bool knows_air = knowledge != Knowledge::defaults;
    t.air.coldest_C = knows_air ? air_C - air_error_K : 15.0;
    t.air.warmest_C = knows_air ? air_C + air_error_K : 35.0;
    if (knows_air) c.senses.error_ratio = sense_error_ratio;
    if (knowledge == Knowledge::weighed || knowledge == Knowledge::thermometer) {
      t.thermal_mass_J_per_K = believed.thermal_mass_J_per_K * truth.weighed_ratio;
      t.mass_error_ratio = mass_error_ratio;
    } else {
      t.thermal_mass_J_per_K = believed.thermal_mass_J_per_K;
    }
    t.thermometer_error_K = thermometer_error_K;
    return s;
  }

  double time_s() const { return hal::seconds(board_.true_time()); }
  State state() const { return loop_.channel(0).state().state(); }
  void tick() {
    executive_.run_tick();
    loop_.health().telemetry_heartbeats.store(++beats_);
    for (Row row; loop_.take(row);) {
    }
    for (Answer answer; loop_.answer(answer);) {
    }
    watch();
  }
  void watch() {
    const Snapshot& s = loop_.channel(0).snapshot();
    const double true_C = truth_.air_C + rise_K();
    const double outside_K = std::max(true_C - s.hottest_C, s.coldest_C - true_C);
    findings_.outside_K = std::max(findings_.outside_K, outside_K);
    if (outside_K > 1e-9) ++findings_.outside_ticks;
    if (widths_K_ != nullptr) widths_K_->push_back(s.hottest_C - s.coldest_C);
    const ChannelState& state = loop_.channel(0).state();
    if (state.first_cause() != Fault::none) findings_.fault = state.first_cause();
  }

  MuscleCase muscle_;
  Truth truth_;
  Findings& findings_;
  host_sim::SimulatedBoardSettings simulated_;
  BoardSettings settings_;
  host_sim::SimulatedBoard board_;
  Loop loop_;
  Executive executive_;
  std::vector<double>* widths_K_ = nullptr;
  std::uint32_t beats_ = 0;
  long ticks_ = 0;
};

/// Runs identify, then reads a thermometer in steady heat, as far as `knowledge` includes them.
board::ThermalFacts found_out(const MuscleCase& muscle, Knowledge knowledge, const Truth& truth,
                              std::uint64_t seed, Findings& findings) {
  board::ThermalFacts facts;
  if (knowledge == Knowledge::defaults || knowledge == Knowledge::air_and_senses) return facts;
  Life life(muscle, knowledge, truth, muscle.max_W, facts, seed, findings);
  if (knowledge != Knowledge::thermometer_alone) {
    life.run(Verb::identify, 0.0, 0.1);
    for (int i = 0; i < max_identify_s && life.active(); ++i)
      life.run(Verb::renew, 0.0, 1.0);
    if (const auto update = life.update()) facts = update->heat;
    findings.cooling_found = facts.has_time_constant();
  }
  if (knowledge == Knowledge::weighed) return facts;
  life.run(Verb::power, 0.29 * muscle.max_W, 5.2 * life.slowest_s());
  life.command(Verb::compare_rise, life.rise_K() + truth.read_error_K);
  life.run(Verb::power, 0.29 * muscle.max_W, 0.1);
  if (const auto update = life.update()) facts = update->heat;
  findings.read = facts.has_reading();
  return facts;
}

/// Power levels from 0 to max_W, with steps between them.
double level_W(double time_s, double max_W) {
  constexpr std::array<double, 8> levels{0.1, 0.5, 0.2, 0.8, 0.0, 1.0, 0.3, 0.05};
  return max_W * levels[static_cast<std::size_t>(time_s / 5.0) % levels.size()];
}

}  // namespace

Findings measure(const MuscleCase& muscle, Knowledge knowledge, std::uint64_t seed) {
  Findings findings;
  const Truth truth(seed);
  const board::ThermalFacts facts = found_out(muscle, knowledge, truth, seed, findings);
  const double ample_W = std::min(peak_W, ample_ratio * muscle.max_W);
  Life life(muscle, knowledge, truth, ample_W, facts, seed, findings);
  std::vector<double> widths_K;
  const bool as_the_paper = muscle.max_W == 4.5 * std::min(1.0, muscle.cooling_ratio);
  const auto move = [&](double time_s) {
    const double wave = std::sin(0.25 * time_s);
    return as_the_paper ? 0.011 + 0.009 * wave : muscle.max_W * (0.29 + 0.27 * wave);
  };
  const Verb verb = as_the_paper ? Verb::position : Verb::power;
  life.run_with(verb, move, 30.0);
  life.note_widths(&widths_K);
  life.run_with(verb, move, 75.0);
  life.note_widths(nullptr);
  life.run_with(
      Verb::power, [&](double t) { return level_W(t, muscle.max_W); }, 80.0);
  life.run(Verb::power, ample_W, std::max(110.0, 8.0 * life.believed_s()));
  findings.reach_ratio = life.rise_K() / (160.0 - truth.air_C);
  life.run(Verb::power, 0.0, 20.0);
  std::nth_element(widths_K.begin(), widths_K.begin() + static_cast<long>(widths_K.size() / 2),
                   widths_K.end());
  findings.median_width_K = widths_K[widths_K.size() / 2];
  return findings;
}

}  // namespace supercoil::test
