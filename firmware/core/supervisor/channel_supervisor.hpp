// May this channel be hot? Holds all of a channel's detectors and nothing else.
#pragma once

#include "supervisor/channel_inputs.hpp"
#include "supervisor/detectors/heater.hpp"
#include "supervisor/detectors/joint.hpp"
#include "supervisor/detectors/liveness.hpp"
#include "supervisor/detectors/muscle.hpp"
#include "supervisor/detectors/response.hpp"
#include "supervisor/detectors/sensor.hpp"
#include "supervisor/supervision.hpp"
#include "supervisor/verdict.hpp"

namespace supercoil {

/// All detectors of one channel.
class ChannelSupervisor {
 public:
  ChannelSupervisor(const ChannelSupervisor&) = delete;
  ChannelSupervisor& operator=(const ChannelSupervisor&) = delete;
  /// cold_resistance_Ohm and min_supply_V set the current that is too low; sense_filter_s is how
  /// long the current sense still shows earlier current.
  ChannelSupervisor(const ChannelSupervision& settings, double cold_resistance_Ohm,
                    double min_supply_V, double sense_filter_s, double step_s);

  /// One tick: the fault of this tick, or none.
  /// After an overrun it is called once for each period that passed.
  Fault step(const AxisInputs& axis, const HeaterInputs& heater, const CommandInputs& commands);
  const Verdict& verdict() const { return verdict_; }
  /// Whether a working sensor can give this reading.
  bool inside(double sensor_m) const {
    return sensor_m >= settings_.min_position_m && sensor_m <= settings_.max_position_m;
  }

 private:
  void judge_sensors(const AxisInputs& axis, const HeaterInputs& heater);
  void judge_heater(const HeaterInputs& e);
  void judge_answer(const AxisInputs& axis, const HeaterInputs& heater);
  void judge_muscle(const AxisInputs& axis, const HeaterInputs& heater);
  void judge_commands(const CommandInputs& commands, const AxisInputs& axis,
                      const HeaterInputs& heater);

  ChannelSupervision settings_;
  Verdict verdict_;
  detectors::Flag stale_;
  detectors::OutOfRange out_of_range_;
  detectors::Frozen frozen_;
  detectors::Jump jump_;
  detectors::SensorsDisagree disagree_;
  detectors::OpenLoad open_;
  detectors::Short short_;
  detectors::StuckOn stuck_on_;
  detectors::NotResponding not_responding_;
  detectors::ReportedMargin unanswered_;
  detectors::MuscleLoose loose_;
  detectors::WrongDuty wrong_duty_;
  detectors::Limit temperature_;
  detectors::Limit travel_;
  detectors::EnergyBudget energy_;
  detectors::ResistanceDrift drift_;
  detectors::Above power_;
  detectors::CommandTimeout expired_;
  detectors::ConsecutiveCount damaged_;
  detectors::ConsecutiveCount refused_;
  detectors::ControllerSaturated lost_;
};

}  // namespace supercoil
