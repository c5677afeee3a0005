// A muscle follows a sine, with the control library alone: no board, no files, no clock.
#include <cmath>
#include <cstdio>
#include <supercoil/control/actuator/state_space.hpp>
#include <supercoil/control/linear/discretize.hpp>
#include <supercoil/control/tracking/controller.hpp>

using namespace supercoil::control;

int main() {
  constexpr double step_s = 0.001;
  const PhysicalParameters muscle;  // the paper's; for yours see docs/setup.md
  ControllerSettings settings{.kind = ControllerKind::learned_ff};
  settings.set_nominal(muscle, 4.5);
  Controller controller(settings, step_s);

  const ActuatorStateSpace model = state_space(muscle);
  const ZeroOrderHold<3, 2> held = zero_order_hold<3, 2>(model.a, model.b, step_s);
  Vector<double, 3> x = Vector<double, 3>::Zero();  // temperature rise, position, velocity
  double power_W = 0.0, squares_m2 = 0.0;
  for (int tick = 0; tick < 60'000; ++tick) {
    const double reference_m = 0.010 - 0.005 * std::cos(0.5 * tick * step_s);
    const ControllerOutput out = controller.step(
        {.reference_m = reference_m, .position_m = x[1], .applied_power_W = power_W});
    power_W = PowerRange{}.clip(out.demanded_power_W);
    x = held.transition * x + held.held * Vector<double, 2>(power_W, 0.0);
    if (tick % 5000 == 0)
      std::printf("%4.0f s %6.3f mm %5.2f W\n", tick * step_s, 1e3 * x[1], power_W);
    if (tick >= 30'000) squares_m2 += (x[1] - out.model_m) * (x[1] - out.model_m);
  }
  std::printf("position - reference model: %.2f um rms\n", 1e6 * std::sqrt(squares_m2 / 30'000));
}
