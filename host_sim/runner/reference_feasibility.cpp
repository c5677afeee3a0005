#include "runner/reference_feasibility.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/control/tracking/reference_model.hpp"

namespace supercoil::host_sim {

namespace {

constexpr double max_step_s = 5e-3;
constexpr double steps_per_period = 100.0;
/// By then the model has come from rest to the reference.
constexpr double settled_time_constants = 8.0;
constexpr double max_slowing = 100.0;
/// What a sine needs comes again; several are looked at for so long.
constexpr double max_looked_at_s = 1000.0;

bool is_periodic(const Reference& reference) {
  return reference.kind == ReferenceKind::sine || reference.kind == ReferenceKind::multisine;
}

double fastest_rad_per_s(const Reference& reference) {
  double fastest = 0.0;
  for (const Sinusoid& term : reference.terms)
    fastest = std::fmax(fastest, std::abs(term.angular_frequency_rad_per_s));
  return fastest;
}

double slowest_rad_per_s(const Reference& reference) {
  double slowest = INFINITY;
  for (const Sinusoid& term : reference.terms)
    slowest = std::fmin(slowest, std::abs(term.angular_frequency_rad_per_s));
  return slowest;
}

/// Of one reference after the other through one controller's model.
class Needed {
 public:
  explicit Needed(const Conditions& c)
      : model_(c.controller.model),
        inverse_(model_, {control::theta_from(c.muscle), {}, c.muscle.moving_mass_kg}) {}

  /// look: takes the time and the power, at each step of a run of that length.
  template <class Look>
  void run(const Reference& reference, double duration_s, Look look) const {
    const double fastest = fastest_rad_per_s(reference);
    const double step_s =
        fastest > 0.0 ? std::fmin(max_step_s, 2.0 * std::numbers::pi / (steps_per_period * fastest))
                      : max_step_s;
    control::ReferenceModel<double> model(model_, step_s);
    for (double time_s = 0.0; time_s < duration_s; time_s += step_s) {
      const double reference_m = reference.at(time_s);
      look(time_s, inverse_.power_W(reference_m, model.motion()));
      model.step(reference_m);
    }
  }

  /// a1/a0 is the sum of the model's time constants.
  double settled_s() const {
    return settled_time_constants * model_.denominator[1] / model_.denominator[0];
  }

 private:
  control::ReferenceModelSettings model_;
  control::ReferenceShaper inverse_;
};

struct Extremes {
  double min_W = INFINITY;
  double max_W = -INFINITY;
};

/// Once it is settled, over the longest period of several.
Extremes extremes(const Needed& needed, const Reference& reference) {
  Extremes e;
  const double begin_s = needed.settled_s();
  const double period_s = 2.0 * std::numbers::pi / slowest_rad_per_s(reference);
  const double looked_at_s = std::fmin(4.0 * period_s, std::fmax(max_looked_at_s, period_s));
  needed.run(reference, begin_s + looked_at_s, [&](double time_s, double power_W) {
    if (time_s < begin_s) return;
    e.min_W = std::fmin(e.min_W, power_W);
    e.max_W = std::fmax(e.max_W, power_W);
  });
  return e;
}

Reference slowed(Reference reference, double slowing) {
  for (Sinusoid& term : reference.terms)
    term.angular_frequency_rad_per_s /= slowing;
  return reference;
}

double feasible_slowing(const Needed& needed, const Reference& reference,
                        const PowerSettings& power) {
  const auto fits = [&](double slowing) {
    const Extremes e = extremes(needed, slowed(reference, slowing));
    return e.min_W >= power.min_W && e.max_W <= power.max_W;
  };
  if (fits(1.0)) return 1.0;
  if (!fits(max_slowing)) return INFINITY;
  double too_fast = 1.0;
  double slow = max_slowing;
  while (slow > 1.02 * too_fast) {
    const double middle = std::sqrt(too_fast * slow);
    (fits(middle) ? slow : too_fast) = middle;
  }
  return slow;
}

/// The power is that of the middle and, in proportion to it, that of the motion about it.
double feasible_motion_ratio(const Needed& needed, const Reference& reference,
                             const Conditions& c) {
  const double middle_W = reference.offset / c.muscle.dc_gain_m_per_W();
  if (middle_W <= c.power.min_W || middle_W >= c.power.max_W) return 0.0;
  const Extremes e = extremes(needed, reference);
  const double heated = (c.power.max_W - middle_W) / std::fmax(0.0, e.max_W - middle_W);
  const double cooled = (middle_W - c.power.min_W) / std::fmax(0.0, middle_W - e.min_W);
  return std::min({1.0, heated, cooled});
}

std::string in_digits(double value) {
  std::ostringstream out;
  out.precision(3);
  out << value;
  return out.str();
}

}  // namespace

std::optional<ReferenceFeasibility> reference_feasibility(const Scenario& scenario) {
  const Conditions& c = scenario.start;
  const bool follows = c.action == OperatorAction::track &&
                       c.controller.kind != control::ControllerKind::power &&
                       c.antagonist() == nullptr;
  if (!follows) return std::nullopt;
  const Needed needed(c);
  ReferenceFeasibility f;
  std::int64_t steps = 0;
  std::int64_t infeasible = 0;
  // An event may change all of it.
  const double end_s = scenario.events.empty() ? scenario.duration_s : scenario.events[0].at_s;
  needed.run(c.reference, end_s, [&](double time_s, double power_W) {
    ++steps;
    if (power_W >= c.power.min_W && power_W <= c.power.max_W) return;
    if (++infeasible > 1) return;
    f.first_s = time_s;
    f.first = power_W < c.power.min_W ? control::Infeasible::cooling : control::Infeasible::heating;
  });
  f.infeasible_ratio =
      static_cast<double>(infeasible) / static_cast<double>(std::max<std::int64_t>(1, steps));
  if (is_periodic(c.reference) && infeasible > 0) {
    f.feasible_motion_ratio = feasible_motion_ratio(needed, c.reference, c);
    f.feasible_slowing = feasible_slowing(needed, c.reference, c.power);
  }
  return f;
}

std::string describe_reference(const Scenario& scenario, bool in_brief) {
  const auto f = reference_feasibility(scenario);
  if (!f) return {};
  if (f->infeasible_ratio <= told_infeasible_ratio)
    return in_brief ? "" : "asks for no more than the muscle can do";
  std::string line =
      "asks for more than the muscle can do for " + in_digits(100.0 * f->infeasible_ratio) +
      " % of the time, first at " + in_digits(f->first_s) + " s, when it would have to be " +
      (f->first == control::Infeasible::cooling
           ? "cooled"
           : "heated with more than " + in_digits(scenario.start.power.max_W) + " W");
  if (f->feasible_motion_ratio == 0.0) return line + "; not even its middle can be held";
  if (f->feasible_motion_ratio < 1.0) {
    line +=
        "; " + in_digits(f->feasible_motion_ratio) + " of its motion about the middle is feasible";
    if (std::isfinite(f->feasible_slowing))
      line += ", or all of it " + in_digits(f->feasible_slowing) + " times as slow";
  }
  return line + (scenario.start.controller.shape_reference
                     ? "; it is shaped, so that the muscle follows it as it can"
                     : "; with shape_reference = true the muscle follows it as it can");
}

std::string describe_unseen_rest(const Scenario& scenario) {
  const Conditions& c = scenario.start;
  const double rest_m = -c.plant.load_N / c.plant.parameters.stiffness_N_per_m;
  const double min_m = c.position_sensor.min_m;
  if (c.joint || rest_m >= min_m) return {};
  return "plant.load_N holds the muscle at " + in_digits(1e3 * rest_m) +
         " mm while it is cold, and the sensor reads no less than " + in_digits(1e3 * min_m) +
         " mm: it stands still there and looks frozen (docs/faults/sensor_frozen.md); lower "
         "sensor.position.min_m";
}

}  // namespace supercoil::host_sim
