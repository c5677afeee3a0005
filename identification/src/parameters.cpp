#include "supercoil/identification/parameters.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace supercoil::identification {

namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();
/// Limit of fits and starts, in prior deviations: time constants of 0.034 to 742 s.
constexpr double max_deviations = 5.0;
/// Part of the force comes without play, and at least half of the motion without creep.
constexpr double max_play_ratio = 0.9;
constexpr double max_creep = 0.5;
/// Radians per sample: faster mechanics cannot be seen.
constexpr double max_phase_step_rad = 1.5;

double limited(const Parameter& parameter, double number) {
  return std::clamp(number, -max_deviations * parameter.deviation,
                    max_deviations * parameter.deviation);
}

double value_of(const Parameter& p, double number) {
  return p.logarithmic ? std::min(p.max, p.unit * std::exp(limited(p, number)))
                       : p.centre + p.unit * limited(p, number);
}

/// Collects the parameters of a model.
class List {
 public:
  void positive(std::string_view name, double Muscle::*member, double middle, double deviation,
                double highest = unbounded) {
    parameters.push_back({name, member, true, middle, highest, deviation, true});
  }
  void either_sign(std::string_view name, double Muscle::*member, double unit, double deviation,
                   bool of_muscle, double centre = 0.0) {
    parameters.push_back({name, member, false, unit, unbounded, deviation, of_muscle, centre});
  }

  std::vector<Parameter> parameters;
};

void add_effects(List& list, const Effects& effects, const Sizes& s) {
  if (effects.has(Effect::drift)) {
    list.either_sign("drift_m_per_s", &Muscle::drift_m_per_s, s.stroke_m / s.duration_s, 0.3, true);
    list.either_sign("heat_drift_m_per_J", &Muscle::heat_drift_m_per_J, s.stroke_m / s.energy_J,
                     0.3, true);
  }
  if (effects.has(Effect::force)) list.positive("force_ratio", &Muscle::force_ratio, 1.0, 0.7);
  if (effects.has(Effect::heat_transfer))
    list.positive("transfer_ratio", &Muscle::transfer_ratio, 1.0, 0.5);
  if (effects.has(Effect::heated_air))
    list.positive("heated_ratio", &Muscle::heated_ratio, 1.0, 0.5);
  if (effects.has(Effect::hysteresis)) {
    list.positive("play_ratio", &Muscle::play_ratio, 0.1, 1.0, max_play_ratio);
    list.positive("play_range_W", &Muscle::play_range_W, 0.3 * s.full_W, 1.0);
  }
  if (effects.has(Effect::creep)) {
    list.positive("creep_ratio", &Muscle::creep_ratio, 0.1, 1.0, max_creep);
    list.positive("creep_s", &Muscle::creep_s, 20.0, 1.0);
  }
  if (effects.has(Effect::lonely_stroke)) {
    list.positive("lonely_stroke_m", &Muscle::lonely_stroke_m, 0.1 * s.stroke_m, 1.5);
    list.positive("lonely_stroke_W", &Muscle::lonely_stroke_W, 0.5 * s.full_W, 1.0);
  }
  if (effects.has(Effect::transformation)) {
    list.positive("transformation_W", &Muscle::transformation_W, 0.3 * s.full_W, 1.5);
    list.positive("transformed_W", &Muscle::transformed_W, 0.05 * s.full_W, 1.5);
  }
}

}  // namespace

std::vector<Parameter> parameters_of(const Effects& effects, const Sizes& s) {
  List list;
  list.positive("gain_m_per_W", &Muscle::gain_m_per_W, s.stroke_m / s.full_W, 3.0);
  list.positive("time_constant_s", &Muscle::time_constant_s, 5.0, 1.0);
  list.positive("natural_frequency_rad_per_s", &Muscle::natural_frequency_rad_per_s, 15.0, 0.8,
                max_phase_step_rad / s.step_s);
  list.positive("damping_ratio", &Muscle::damping_ratio, 0.8, 1.0);
  add_effects(list, effects, s);
  // An absolute sensor may be far from zero.
  list.either_sign("rest_m", &Muscle::rest_m, s.stroke_m, 3.0, false, s.first_m);
  list.either_sign("start_W", &Muscle::start_W, s.full_W, 0.3, false);
  list.either_sign("start_offset_m", &Muscle::start_offset_m, s.stroke_m, 0.03, false);
  list.either_sign("start_m_per_s", &Muscle::start_m_per_s, s.stroke_m, 0.03, false);
  return std::move(list.parameters);
}

Muscle muscle_from(const std::vector<Parameter>& parameters, const Eigen::VectorXd& numbers) {
  Muscle muscle;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    muscle.*parameters[i].member = value_of(parameters[i], numbers[static_cast<Eigen::Index>(i)]);
  return muscle;
}

Eigen::VectorXd numbers_from(const std::vector<Parameter>& parameters, const Muscle& muscle) {
  Eigen::VectorXd numbers(static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const Parameter& p = parameters[i];
    const double ratio = (muscle.*p.member - p.centre) / p.unit;
    double number = ratio;
    // A parameter that the muscle does not have yet starts in the middle.
    if (p.logarithmic) number = ratio > 0.0 ? std::log(ratio) : 0.0;
    numbers[static_cast<Eigen::Index>(i)] = limited(p, number);
  }
  return numbers;
}

bool is_at_limit(const Parameter& parameter, double number) {
  return std::abs(number) > 0.999 * max_deviations * parameter.deviation;
}

double slope(const Parameter& parameter, double number) {
  return parameter.logarithmic ? value_of(parameter, number) : parameter.unit;
}

}  // namespace supercoil::identification
