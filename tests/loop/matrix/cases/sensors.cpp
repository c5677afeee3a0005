#include "loop/matrix/cases/cases.hpp"

namespace supercoil::test {

namespace {

using host_sim::ConverterFaults;

std::function<void(Rig&)> position(const ConverterFaults& faults) {
  return [faults](Rig& rig) { rig.muscle().position.set(faults); };
}

/// A third more than the muscle's motion in a period and the noise can add up to.
void jump(Rig& rig) {
  const ChannelSupervision limits;
  const double noise_m = 50e-6 + 12.0 * limits.position_noise_rms_m;
  const double allowed_m = limits.max_speed_m_per_s * rig.period_s() + noise_m;
  rig.muscle().position.set({.offset = 1.3 * allowed_m});
}

}  // namespace

std::vector<FaultCase> sensor_cases() {
  const auto well = position({});
  return {
      {.fault = Fault::sensor_out_of_range,
       .within = {0.005},
       .inject = position({.loose = true}),
       .remove = well},
      {.fault = Fault::sensor_stale,
       .within = {0.010},
       .inject = position({.silent = true}),
       .remove = well},
      {.fault = Fault::sensor_frozen,
       .within = {1.0},
       .elsewhere = cold,
       .why_not = "a cold muscle's sensor may rest",
       .inject = position({.frozen = true}),
       .remove = well},
      {.fault = Fault::sensor_jump, .within = {0.0}, .inject = jump, .remove = well},
      {.fault = Fault::sensors_disagree,
       .within = {2.4},
       .elsewhere = cold,
       .why_not = "without current the resistance is not known",
       // As if it were 75 K warmer.
       .inject = [](Rig& r) { resistance(r, 11.5); },
       .remove = [](Rig& r) { resistance(r, 10.0); }},
  };
}

}  // namespace supercoil::test
