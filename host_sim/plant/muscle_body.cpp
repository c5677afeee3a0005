#include "plant/muscle_body.hpp"

#include <algorithm>

namespace supercoil::host_sim {

void MuscleBody::set(const control::PhysicalParameters& parameters, const PlantEffects& effects,
                     double step_s) {
  heat_.set(parameters, effects, step_s);
  hysteresis_.set(effects);
  force_.set(parameters, effects);
  softening_.set(parameters, effects);
  creep_.set(parameters, effects, step_s);
  lonely_.set(effects);
  ageing_.set(effects);
  moisture_.set(effects, step_s);
  wears_ = effects.ageing_ratio > 0.0 || effects.water_ratio > 0.0 || moisture_.water_ratio() > 0.0;
  spring_ = spring_now();
}

void MuscleBody::start_from(double rise_K, double peak_rise_K, double position_m) {
  heat_.start_from(rise_K);
  peak_K_ = peak_rise_K;
  hysteresis_.rest_at(rise_K);
  creep_.rest_at(position_m);
  spring_ = spring_now();
}

MuscleBody::Spring MuscleBody::spring_now() {
  const double rise_K = heat_.rise_K();
  const double stiffness = softening_.stiffness_N_per_m(rise_K);
  const double lost = stiffness - softening_.cold_N_per_m();
  double active = force_.force_N(hysteresis_.step(rise_K));
  if (wears_) active *= ageing_.force_ratio() * moisture_.force_ratio();
  // k(x − x0 − xs) + k0 xs
  return {stiffness, active + stiffness * lonely_.rest_m(peak_K_) + lost * softening_.stretch_m()};
}

Drive MuscleBody::step(double power_W, double load_N, double position_m) {
  const double rise_before_K = heat_.rise_K();
  const double rise_K = heat_.step(power_W);
  peak_K_ = std::max(peak_K_, rise_K);
  if (wears_) {
    ageing_.step(rise_K - rise_before_K);
    moisture_.step(0.5 * (rise_before_K + rise_K));
  }
  const Spring before = spring_;
  spring_ = spring_now();

  const double pull_N = creep_.pull_N() - load_N;
  const double pull_end_N = pull_N + creep_.pull_change_N(position_m);
  const double beside_N_per_m = creep_.stiffness_N_per_m();
  return {before.stiffness_N_per_m + beside_N_per_m, spring_.stiffness_N_per_m + beside_N_per_m,
          before.force_N + pull_N, spring_.force_N + pull_end_N};
}

}  // namespace supercoil::host_sim
