// The paper's closed loops: its plant, its signals, its laws.
#pragma once

#include <cmath>
#include <cstdint>

#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/control/tracking/law.hpp"

namespace supercoil::host_sim::paper {

inline constexpr double step_s = 1e-3;
inline constexpr double change_at_s = 80.0;
inline constexpr double end_s = 140.0;
inline constexpr double stiffness_after_N_per_m = 12.0;

/// The plant of Sec. 5.2: numerator 1/(ψm̂) = 68.587 (γ dropped, so that "position" is x/γ), as a
/// transfer function whose coefficients change: x, ẋ and ẍ stay continuous. A muscle's temperature
/// stays continuous instead; with that, the MRAC's rows after the change come out a third larger.
class TransferFunctionPlant {
 public:
  explicit TransferFunctionPlant(const control::PhysicalParameters& parameters) { set(parameters); }

  /// γ is taken as 1 whatever the parameters say.
  void set(control::PhysicalParameters parameters) {
    parameters.force_per_kelvin_N_per_K = 1.0;
    const control::TransferFunction f = control::transfer_function_from(parameters);
    const control::Companion<3> system({f.b0, f.b1, f.b2, 1.0});
    discrete_ = control::zero_order_hold<3, 1>(system.a, system.b, step_s);
    numerator_ = f.b3;
  }
  void step(double power) {
    state_ = (discrete_.transition * state_ + discrete_.held * power).eval();
  }
  double position() const { return numerator_ * state_[0]; }

 private:
  control::ZeroOrderHold<3, 1> discrete_;
  control::Vector<double, 3> state_ = control::Vector<double, 3>::Zero();
  double numerator_ = 0.0;
};

/// r(t) = sin 0.25t + 1.01, or a step of 1 (Sec. 5.2), in the paper's unit.
enum class Signal { sine, step };

inline double value(Signal signal, double t) {
  return signal == Signal::sine ? std::sin(0.25 * t) + 1.01 : 1.0;
}
inline double slope(Signal signal, double t) {
  return signal == Signal::sine ? 0.25 * std::cos(0.25 * t) : 0.0;
}

/// What a law is to follow.
enum class Target { reference, model };

struct Moment {
  double time_s;
  double reference;
  double target;
  double position;
  double power;
};

/// Runs a law, power = law(LawInput), for end_s; the stiffness falls from 16 to 12 N/m at
/// change_at_s. range: Eq. (19), or an unlimited range. observe(Moment) is called once a tick.
template <class Law, class Observe>
void run(Law&& law, Target target, const control::ReferenceModelSettings& model_settings,
         Signal signal, const control::PowerRange& range, Observe observe) {
  control::PhysicalParameters parameters;
  TransferFunctionPlant plant(parameters);
  control::ReferenceModel<double> model(model_settings, step_s);
  control::LawInput<double> in;
  const std::int64_t ticks = std::llround(end_s / step_s);
  const std::int64_t change = std::llround(change_at_s / step_s);
  for (std::int64_t tick = 0; tick <= ticks; ++tick) {
    const double t = static_cast<double>(tick) * step_s;
    if (tick == change) {
      parameters.stiffness_N_per_m = stiffness_after_N_per_m;
      plant.set(parameters);
    }
    model.step(in.reference);
    in.reference = value(signal, t);
    in.position = plant.position();
    in.model = target == Target::model
                   ? model.motion()
                   : control::ModelMotion<double>{in.reference, slope(signal, t), 0.0};
    const double demanded = law(in);
    in.applied = range.clip(demanded);
    in.limited = in.applied != demanded;
    observe(Moment{t, in.reference, in.model.position, in.position, in.applied});
    plant.step(in.applied);
  }
}

}  // namespace supercoil::host_sim::paper
