#include "estimators/muscle_state.hpp"

#include <CppUTest/TestHarness.h>

#include "estimators/trial.hpp"

using namespace supercoil::host_sim::estimators;

namespace {

const double mass_kg = supercoil::control::PhysicalParameters{}.moving_mass_kg;

}  // namespace

TEST_GROUP(MuscleState){};

TEST(MuscleState, MovesLikeThePlant) {
  Bench bench(trials[0], 1);
  State state = bench.state();
  for (int i = 0; i < 5000; ++i) {
    const Bench::Tick tick = bench.next();
    state = propagated<double>(state, mass_kg, tick.power_W, tick_s);
  }
  const State plant = bench.state();
  CHECK(plant[at_position] > 5e-3);
  DOUBLES_EQUAL(plant[at_position], state[at_position], 1e-11);
  DOUBLES_EQUAL(plant[at_velocity], state[at_velocity], 1e-10);
  DOUBLES_EQUAL(plant[at_acceleration], state[at_acceleration], 1e-9);
}

TEST(MuscleState, BiasIsPowerThatDoesNotHeat) {
  State biased = state_of(trials[0].initial());
  biased[at_bias] = 0.5;
  State unbiased = biased;
  unbiased[at_bias] = 0.0;
  const State a = propagated<double>(biased, mass_kg, 2.0, tick_s);
  const State b = propagated<double>(unbiased, mass_kg, 1.5, tick_s);
  DOUBLES_EQUAL(b[at_acceleration], a[at_acceleration], 1e-15);
}

TEST(MuscleState, DerivativeMatchesFiniteDifferences) {
  Bench bench(trials[0], 1);
  for (int i = 0; i < 3000; ++i)
    bench.next();
  const State state = bench.state();
  const Propagated next = propagated_with_derivative(state, mass_kg, 3.0, tick_s);
  for (int column = 0; column < state_size; ++column) {
    constexpr double apart = 1e-6;
    State more = state;
    State less = state;
    more[column] += apart;
    less[column] -= apart;
    const State difference = (propagated<double>(more, mass_kg, 3.0, tick_s) -
                              propagated<double>(less, mass_kg, 3.0, tick_s)) /
                             (2.0 * apart);
    for (int row = 0; row < state_size; ++row)
      DOUBLES_EQUAL(difference[row], next.derivative(row, column), 1e-8);
  }
}
