// May this channel be hot? All of a channel's detectors, and nothing but they.
#pragma once

#include "board/measurement.hpp"
#include "supervisor/detectors/answer.hpp"
#include "supervisor/detectors/heater.hpp"
#include "supervisor/detectors/liveness.hpp"
#include "supervisor/detectors/muscle.hpp"
#include "supervisor/detectors/sensor.hpp"
#include "supervisor/supervision.hpp"
#include "supervisor/verdict.hpp"

namespace supercoil {

/// What a channel knows at this tick.
struct Evidence {
  board::Measured position;         ///< in m, calibrated
  double sensor_m = 0.0;            ///< the same as the sensor gives it
  double position_elapsed_s = 0.0;  ///< since the last fresh position; 0: this one is not fresh
  board::Measured current;          ///< in A, averaged
  double supply_V = 0.0;
  bool hot = false;      ///< the muscle may be warmer than the air
  bool heating = false;  ///< a command to heat is in force
  bool off = true;       ///< no duty is set, or the enable line is low
  double duty = 0.0;     ///< as the current sense averages it
  int set_step = 0;
  int read_back = -1;
  bool devices_ok = true;                           ///< every write of the last tick was taken
  detectors::NotResponding::Expected expected_m{};  ///< where the models of the muscle are
  bool unanswered = false;   ///< the muscle was asked to prove that it answers, and did not,
  detectors::Margin answer;  ///< and by how much
  double hottest_C = 0.0;
  double applied_W = 0.0;          ///< as it was set
  double measured_W = 0.0;         ///< the larger of that and what the senses tell
  double from_resistance_K = 0.0;  ///< the temperature that it tells; 0 when it tells none,
  double from_position_K = 0.0;    ///< and then this as well
  bool probed = false;             ///< a probe ended at this tick with the next value
  bool resistance_fresh = false;   ///< it was measured at this tick, by a probe or while heating
  double resistance_Ohm = 0.0;
  double least_Ohm = 0.0;  ///< between these it should be, at whichever temperature
  double most_Ohm = 0.0;
  bool probe_failed = false;  ///< a probe ended without a resistance
  bool renewed = false;
  bool damaged_command = false;
  bool refused_command = false;
  bool obeyed_command = false;
  double wanted_W = 0.0;  ///< by the controller, at the last tick
  bool limited = false;
};

class ChannelSupervisor {
 public:
  ChannelSupervisor(const ChannelSupervisor&) = delete;
  ChannelSupervisor& operator=(const ChannelSupervisor&) = delete;
  /// cold_resistance_Ohm and lowest_supply_V say what current is too little.
  ChannelSupervisor(const ChannelSupervision& settings, double cold_resistance_Ohm,
                    double lowest_supply_V, double step_s);

  /// One tick: the fault of this tick, or none.
  /// After an overrun it is called once for each period that passed.
  Fault step(const Evidence& e);
  const Verdict& verdict() const { return verdict_; }
  /// Whether a sensor that is well can give this.
  bool inside(double sensor_m) const {
    return sensor_m >= settings_.lowest_position_m && sensor_m <= settings_.highest_position_m;
  }
  /// The channel was armed anew. What watches the muscle goes on: re-arming proves nothing of it.
  void rearmed() { lost_.reset(); }
  /// A new calibration moved every position.
  void recalibrated() { not_responding_.reset(); }

 private:
  void judge_sensors(const Evidence& e);
  void judge_heater(const Evidence& e);
  void judge_muscle(const Evidence& e);
  void judge_commands(const Evidence& e);

  ChannelSupervision settings_;
  Verdict verdict_;
  detectors::Flag stale_;
  detectors::OutOfRange out_of_range_;
  detectors::Frozen frozen_;
  detectors::Jump jump_;
  detectors::Disagree disagree_;
  detectors::OpenLoad open_;
  detectors::Short short_;
  detectors::StuckOn stuck_on_;
  detectors::NotResponding not_responding_;
  detectors::Reported unanswered_;
  detectors::WrongDuty wrong_duty_;
  detectors::Limit temperature_;
  detectors::Limit travel_;
  detectors::EnergyBudget energy_;
  detectors::ResistanceDrift drift_;
  detectors::Above power_;
  detectors::Expired expired_;
  detectors::InARow damaged_;
  detectors::InARow refused_;
  detectors::ControllerLost lost_;
};

}  // namespace supercoil
