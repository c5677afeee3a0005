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
  double rise_from_C = 25.0;  ///< air temperature that the muscle's rise is relative to
};

/// Faults that can be injected, in addition to the converters'.
struct MuscleFaults {
  bool wire_open = false;
  double short_Ohm = 0.0;  ///< across the muscle; 0: none
  bool switch_stuck_on = false;
  bool enable_stuck_on = false;
  bool slack = false;              ///< heat no longer moves the sensor's end
  double switch_leak_ratio = 0.0;  ///< of full conduction, while the switch is off
  bool torn = false;               ///< it no longer pulls; only in a joint
  double slack_m = 0.0;            ///< of its cable, only in a joint; see JointMuscle
};

/// The common motion of several channels' muscles, as each of them sees it. muscle: its place among
/// them, from 0.
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

  /// First half of a board step that begins at `from`: the heating power. supply_V is 0 while the
  /// supply switch is open.
  void heat(hal::Time from, double supply_V);
  /// Second half: the muscle's motion, and the sensors at the step's end. A joint or a bundle has
  /// already moved its own muscles.
  void move(hal::Time to);
  /// Changes all settings that may change during a run; converters and PWM keep theirs.
  void set(const MuscleChannelSettings& settings);
  /// From now on the muscle moves as one of `shared`, which must outlive the channel's steps.
  /// muscle: its place there.
  void join(const SharedMotion& shared, std::size_t muscle) {
    shared_ = &shared;
    muscle_ = muscle;
  }

  /// The thermometer's reading; NaN without one.
  double thermometer_C() const { return thermometer_.reading_C(); }
  /// Air temperature that the plant's rise is relative to.
  double rise_from_C() const { return settings_.rise_from_C; }
  /// For a muscle that moves alone.
  const Plant& plant() const { return plant_; }
  const MuscleChannelSettings& settings() const { return settings_; }
  /// The muscle's, whether it moves alone or with others.
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
  /// What the position sensor sees: in a joint, the angle times the lever at angle 0.
  double reading_m() const;

  MuscleChannelSettings settings_;
  hal::Duration step_;
  Plant plant_;
  const SharedMotion* shared_ = nullptr;  ///< contains this as muscle_; null: it moves alone
  std::size_t muscle_ = 0;
  Thermometer thermometer_;
  double sense_gain_;
  double sense_A_ = 0.0;
  double power_W_ = 0.0;
  double current_A_ = 0.0;
  double slack_at_m_ = 0.0;
};

}  // namespace supercoil::host_sim
