#include "loop/matrix/cases/cases.hpp"

namespace supercoil::test {

namespace {

using enum Situation;

const std::vector<Situation> not_asked{disarmed, arming, armed, identify, calibrate, fault};
/// Everywhere but where a probe runs at a known moment.
const std::vector<Situation> not_probing{disarmed, armed,    pi,        pd_ff, mrac,
                                         power,    identify, calibrate, fault};
const std::vector<Situation> no_surplus{disarmed, arming,   armed,     pi,
                                        pd_ff,    identify, calibrate, fault};

/// At the muscle, or at the lever of its joint.
void load(Rig& rig, double load_N) {
  if (rig.board.joints() > 0) {
    host_sim::SimulatedJointSettings joint = rig.board.joint(0).settings();
    joint.load_Nm = load_N * joint.plant.lever.zero_radius_m();
    rig.board.joint(0).set(joint);
    return;
  }
  host_sim::MuscleChannelSettings settings = ordinary_muscle();
  settings.load_N = load_N;
  rig.muscle().set(settings);
}

void scale_demand(Rig& rig, double times_as_much) {
  rig.scale = times_as_much;
}

void hot_at_85_C(RigSettings& s) {
  ChannelSettings& channel = s.firmware.channels[Rig::tested];
  channel.supervision.trip_C = 85.0;
  channel.supervision.max_travel_m = 0.042;
}

void small_budget(RigSettings& s) {
  s.firmware.channels[Rig::tested].supervision.energy_J = 22.0;
  s.firmware.channels[Rig::tested].supervision.energy_window_s = 10.0;
}

void slow_power_stage(RigSettings& s) {
  ChannelSettings& channel = s.firmware.channels[Rig::tested];
  // The measured resistance lags: otherwise the power stage corrects itself within 0.2 s.
  channel.heater.resistance_filter_s = 10.0;
  channel.supervision.resistance_ratio = 0.9;
  channel.heater.temperature_coefficient_per_K = 0.0;
  channel.limiter.max_W = 4.0;
  channel.supervision.max_measured_W = 4.4;
  channel.supervision.max_travel_m = 0.042;
}

}  // namespace

std::vector<FaultCase> muscle_cases() {
  return {
      {.fault = Fault::over_temperature,
       .within = {3.0},
       .elsewhere = not_asked,
       .why_not = "nothing asks for more heat",
       .inject = [](Rig& r) { scale_demand(r, 2.0); },
       .remove = [](Rig& r) { scale_demand(r, 1.0); },
       .tune = hot_at_85_C},
      {.fault = Fault::over_travel,
       .within = {0.3},
       .inject = [](Rig& r) { load(r, -0.45); },
       .remove = [](Rig& r) { load(r, 0.0); }},
      {.fault = Fault::energy_budget_exceeded,
       .within = {10.0},
       .elsewhere = not_asked,
       .why_not = "nothing asks for more heat",
       .inject = [](Rig& r) { scale_demand(r, 1.6); },
       .remove = [](Rig& r) { scale_demand(r, 1.0); },
       .tune = small_budget},
      {.fault = Fault::resistance_drift,
       .within = {0.05},
       .elsewhere = not_probing,
       .why_not = "measured by the probe while cold",
       .inject = [](Rig& r) { resistance(r, 17.0); },
       .remove = [](Rig& r) { resistance(r, 10.0); }},
      {.fault = Fault::power_limit_exceeded,
       .within = {0.7},
       .elsewhere = no_surplus,
       .why_not = "nothing asks for power, or the controller takes the surplus back",
       .inject =
           [](Rig& r) {
             scale_demand(r, 1.4);
             resistance(r, 5.3);
           },
       .remove = [](Rig& r) { resistance(r, 10.0); },
       .tune = slow_power_stage},
  };
}

}  // namespace supercoil::test
