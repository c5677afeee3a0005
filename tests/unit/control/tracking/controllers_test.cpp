// PI, PD with feedforward and open loop, and the selection of a controller by its settings.
#include <CppUTest/TestHarness.h>

#include "supercoil/control/estimation/estimator.hpp"
#include "supercoil/control/tracking/controller.hpp"

#include "unit/control/support/muscle.hpp"
#include "unit/control/support/reference.hpp"

using namespace supercoil::control;

namespace {

/// The largest differences in position and model from scipy's closed loop for a step of 10 mm.
std::pair<double, double> difference(ControllerKind kind, const nlohmann::json& run,
                                     double step_s) {
  ControllerSettings settings;
  settings.kind = kind;
  settings.model = design_model();
  Controller controller(settings, step_s);
  const std::vector<double> times = run.at("time_s");
  const std::vector<double> positions = run.at("position_m");
  const std::vector<double> models = run.at("model_m");
  std::size_t next = 0;
  std::pair<double, double> worst{};
  supercoil::test::run_closed_loop(
      controller, step_s, times.back(), supercoil::test::no_limits, [](double) { return 0.010; },
      [&](const supercoil::test::Tick& tick) {
        if (next == times.size() || std::abs(tick.time_s - times[next]) > 0.5 * step_s) return;
        worst.first = std::fmax(worst.first, std::abs(tick.position_m - positions[next]));
        worst.second = std::fmax(worst.second, std::abs(tick.model_m - models[next]));
        ++next;
      });
  LONGS_EQUAL(times.size(), next);
  return worst;
}

void expect_scipy_response(ControllerKind kind, const char* name) {
  const auto run = supercoil::test::reference("tracking", name);
  const auto coarse = difference(kind, run, 1e-3);
  const auto fine = difference(kind, run, 0.5e-3);
  CHECK(coarse.second < 1e-9);
  CHECK(coarse.first < 20e-6);
  DOUBLES_EQUAL(2.0, coarse.first / fine.first, 0.2);
}

}  // namespace

TEST_GROUP(Controllers){};

TEST(Controllers, PiMatchesScipysClosedLoopToFirstOrderInTheStep) {
  expect_scipy_response(ControllerKind::pi, "pi");
}

TEST(Controllers, PdWithFeedforwardMatchesScipysClosedLoopToFirstOrder) {
  expect_scipy_response(ControllerKind::pd_ff, "pd_ff");
}

TEST(Controllers, PiHoldsItsIntegralAtTheLimitAndLetsItOnlyLeadOut) {
  Pi<double> pi({.proportional_W_per_m = 2.0, .integral_W_per_m_s = 1.0}, 1.0, 0.01);
  const auto step = [&](double error, double applied, bool limited) {
    LawInput<double> in;
    in.model.position = error;
    in.applied = applied;
    in.limited = limited;
    return pi.step(in);
  };
  DOUBLES_EQUAL(6.03, step(3.0, 0.0, false), 1e-12);
  for (int k = 0; k < 1000; ++k)  // above the upper limit, pushing further: held
    DOUBLES_EQUAL(6.03, step(3.0, 4.5, true), 1e-12);
  // Still above the limit, but the error has changed sign and leads out at once.
  DOUBLES_EQUAL(-2.0 + 0.03 - 0.01, step(-1.0, 4.5, true), 1e-12);
  for (int k = 0; k < 1000; ++k)  // below the lower limit: also held
    DOUBLES_EQUAL(-1.98, step(-1.0, 0.0, true), 1e-12);
  DOUBLES_EQUAL(2.0 + 0.02 + 0.01, step(1.0, 0.0, true), 1e-12);
}

TEST(Controllers, PiRecoversFromALimitWithoutWindup) {
  ControllerSettings settings;
  settings.kind = ControllerKind::pi;
  settings.model = poles_model({4.0, 5.0, 6.0});
  Controller controller(settings, 1e-3);
  double late = 0.0;
  // 40 mm are out of reach (27 mm at 4.5 W) for 20 s, then 10 mm.
  supercoil::test::run_closed_loop(
      controller, 1e-3, 40.0, PowerRange{}, [](double t) { return t < 20.0 ? 0.040 : 0.010; },
      [&](const supercoil::test::Tick& tick) {
        if (tick.time_s > 26.0) late = std::fmax(late, std::abs(tick.position_m - 0.010));
      });
  CHECK(late < 0.3e-3);
}

TEST(Controllers, LearningLawsTakeOverAHeldPower) {
  using enum ControllerKind;
  for (const ControllerKind kind : {mrac_ls, adaptive_ff, learned_ff}) {
    ControllerSettings settings;
    settings.kind = kind;
    Controller controller(settings, 1e-3);
    controller.start({.reference_m = 0.01,
                      .position_m = 0.0101,
                      .power_W = 1.7,
                      .motion = {0.01, 0.0, 0.0},
                      .hold = true});
    const auto out = controller.step(
        {.reference_m = 0.01, .position_m = 0.0101, .applied_power_W = 1.7, .limited = false});
    DOUBLES_EQUAL(1.7, out.demanded_power_W, 1e-3);
  }
}

TEST(Controllers, OpenLoopPassesThePowerOn) {
  ControllerSettings settings;
  settings.kind = ControllerKind::power;
  for (const auto& [name, arithmetic] : arithmetic_names) {
    settings.arithmetic = arithmetic;
    Controller controller(settings, 1e-3);
    ControllerInput input;
    input.reference_power_W = 1.2345678901;
    DOUBLES_EQUAL(1.2345678901, controller.step(input).demanded_power_W, 0.0);
  }
}

TEST(Controllers, NamesAndKindsRoundTrip) {
  CHECK(find_named(controller_names, "pd_ff") == ControllerKind::pd_ff);
  CHECK(find_named(arithmetic_names, "q8.24") == Arithmetic::q8_24);
  CHECK(find_named(estimator_names, "gradient") == EstimatorKind::gradient);
  CHECK_FALSE(find_named(controller_names, "PI").has_value());
  CHECK(name_of(controller_names, ControllerKind::mrac) == "mrac");
  CHECK(name_of(arithmetic_names, Arithmetic::float32) == "float");
}
