// One muscle with its switch, its wires and its sensors.
#pragma once

#include <cstddef>
#include <optional>

#include "plant/plant.hpp"
#include "simulated_board/converter.hpp"
#include "simulated_board/lines.hpp"
#include "simulated_board/thermometer.hpp"

namespace supercoil::host_sim {

struct MuscleChannelSettings {
  control::PhysicalParameters plant;
  PlantEffects effects;
  double resistance_Ohm = 10.0;                ///< of the cold heater
  double temperature_coefficient_per_K = 0.0;  ///< of that resistance
  double load_N = 0.0;
  double power_gain = 1.0;  ///< heat in the muscle over electrical power, unmeasured
  double sense_filter_s = 0.0;
  int pwm_steps = (1 << 30);
  double pwm_delay_s = 0.0;
  ConverterSettings position{0.0, 0.040, 16, 10e-6};
  ConverterSettings current{-0.1, 6.0, 0, 0.0};
  std::optional<ThermometerReading> thermometer;
  double rise_from_C = 25.0;  ///< the air's temperature that the muscle's rise counts from
};

/// Faults that can be injected, besides its converters'.
struct MuscleFaults {
  bool wire_open = false;
  double short_Ohm = 0.0;  ///< across the muscle; 0: none
  bool switch_stuck_on = false;
  bool enable_stuck_on = false;
  bool slack = false;              ///< heat no longer moves the sensor's end
  double switch_leak_ratio = 0.0;  ///< of full conduction, while the switch is off
  bool torn = false;               ///< it pulls no more; a joint's muscle only
  double slack_m = 0.0;            ///< of its cable, likewise; see JointMuscle
};

/// What moves the muscles of several channels at once, as each of them sees it. muscle: its place
/// among them, from 0.
class SharedMotion {
 public:
  SharedMotion(const SharedMotion&) = delete;
  SharedMotion& operator=(const SharedMotion&) = delete;

  /// How far the muscle has contracted.
  virtual double position_m(std::size_t muscle) const = 0;
  /// What a position sensor of the muscle's channel sees.
  virtual double reading_m(std::size_t muscle) const { return position_m(muscle); }
  virtual double temperature_rise_K(std::size_t muscle) const = 0;
  virtual double peak_temperature_rise_K(std::size_t muscle) const = 0;

 protected:
  SharedMotion() = default;
  ~SharedMotion() = default;
};

class MuscleChannel {
 public:
  MuscleChannel(const MuscleChannelSettings& settings, hal::Duration step, const hal::Time& now,
                std::uint64_t seed);

  /// One step of the board, which begins at `from`: what heats the muscle over it. supply_V is 0
  /// while its switch is open.
  void heat(hal::Time from, double supply_V);
  /// And how the muscle has moved and what the sensors see at the step's end. What is in a joint or
  /// a bundle has been moved by it.
  void move(hal::Time to);
  /// Everything that may change under way; converters and PWM stay as they are.
  void set(const MuscleChannelSettings& settings);
  /// From now on the muscle moves with others, by what outlives the channel's steps. muscle: its
  /// place among them.
  void join(const SharedMotion& shared, std::size_t muscle) {
    shared_ = &shared;
    muscle_ = muscle;
  }

  /// The thermometer's reading; NaN without one.
  double thermometer_C() const { return thermometer_.reading_C(); }
  /// The air's temperature that the plant's rise counts from.
  double rise_from_C() const { return settings_.rise_from_C; }
  /// Of a muscle that moves alone.
  const Plant& plant() const { return plant_; }
  const MuscleChannelSettings& settings() const { return settings_; }
  /// Of the muscle, alone or with others.
  double position_m() const;
  double temperature_rise_K() const;
  double peak_temperature_rise_K() const;
  double true_power_W() const { return power_W_; }
  double current_A() const { return current_A_; }

  SimulatedPwm pwm;
  SimulatedOutput enable;
  SimulatedConverter position;
  SimulatedConverter current;
  MuscleFaults faults;

 private:
  /// What the position sensor sees: of a joint the angle, at the lever of 0.
  double reading_m() const;

  MuscleChannelSettings settings_;
  hal::Duration step_;
  Plant plant_;
  const SharedMotion* shared_ = nullptr;  ///< of which it is muscle_; null: it moves alone
  std::size_t muscle_ = 0;
  Thermometer thermometer_;
  double sense_gain_;
  double sense_A_ = 0.0;
  double power_W_ = 0.0;
  double current_A_ = 0.0;
  double slack_at_m_ = 0.0;
};

}  // namespace supercoil::host_sim
