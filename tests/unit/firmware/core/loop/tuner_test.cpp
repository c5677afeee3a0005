// The prepared, used, configured and stored values of a controller or an estimator.
#include "loop/tuner.hpp"

#include <cmath>
#include <utility>

#include <CppUTest/TestHarness.h>

#include "supercoil/control/actuator/conversions.hpp"

#include "unit/firmware/core/support/tick.hpp"

using namespace supercoil;
using supercoil::test::tick_s;

TEST_GROUP(Tuner) {
  const std::size_t integral = control::tunable_named("integral_W_per_m_s");
  ChannelSettings channel;
  control::PhysicalParameters muscle;
  double configured = 0.0;

  void setup() override {
    channel.controllers[0].kind = control::ControllerKind::pi;
    configured = channel.controllers[0].pi.integral_W_per_m_s;
  }
  static Command command(Verb verb, double value) {
    return {0, verb, value};
  }
};

TEST(Tuner, HasNoValueForMissingPlaces) {
  supercoil::Tuner tuner(channel, tick_s);
  for (const TuningSet set :
       {TuningSet::prepared, TuningSet::in_use, TuningSet::configured, TuningSet::stored}) {
    DOUBLES_EQUAL(configured, tuner.value(set, 0, integral), 0.0);
    CHECK(std::isnan(tuner.value(set, 1, integral)));
    CHECK(std::isnan(tuner.value(set, 0, control::tunable_count)));
    CHECK_FALSE(tuner.prepare_from(set, 1));
  }
  CHECK(tuner.prepare(1, integral, 800.0).refusal == Refusal::out_of_range);
}

TEST(Tuner, StoredValuesAreThoseOfTheNextStart) {
  channel.tuning.controllers[0].values[integral] = 800.0;
  supercoil::Tuner tuner(channel, tick_s);
  DOUBLES_EQUAL(800.0, tuner.value(TuningSet::stored, 0, integral), 0.0);
  DOUBLES_EQUAL(configured, tuner.value(TuningSet::configured, 0, integral), 0.0);
  CHECK(tuner.prepare_from(TuningSet::stored, 0));
  DOUBLES_EQUAL(800.0, tuner.value(TuningSet::prepared, 0, integral), 0.0);
  DOUBLES_EQUAL(configured, tuner.value(TuningSet::in_use, 0, integral), 0.0);
}

TEST(Tuner, AcceptedValuesAreInUseAndAreStored) {
  supercoil::Tuner tuner(channel, tick_s);
  CHECK(tuner.prepare(0, integral, 800.0).refusal == Refusal::none);
  DOUBLES_EQUAL(800.0, tuner.value(TuningSet::prepared, 0, integral), 0.0);
  for (const Refusal refusal : {Refusal::busy, Refusal::none}) {
    Command tune = command(Verb::tune, 0.0);
    tuner.add_to(tune, muscle);
    CHECK(tune.tuned_controller != nullptr);
    DOUBLES_EQUAL(configured, tuner.value(TuningSet::in_use, 0, integral), 0.0);
    tuner.conclude({tune, refusal});
  }
  DOUBLES_EQUAL(800.0, tuner.value(TuningSet::in_use, 0, integral), 0.0);

  Command store = command(Verb::store, store_tuning);
  tuner.add_to(store, muscle);
  CHECK(store.tuning != nullptr);
  if (store.tuning == nullptr) return;
  for (std::size_t i = 0; i < control::tunable_count; ++i)
    CHECK_EQUAL(i == integral, store.tuning->controllers[0].values[i].has_value());
  DOUBLES_EQUAL(800.0, *store.tuning->controllers[0].values[integral], 0.0);
  // Nothing more is stored before the loop has answered.
  Command meanwhile = command(Verb::store, clear_tuning);
  tuner.add_to(meanwhile, muscle);
  CHECK(meanwhile.tuning == nullptr);
  DOUBLES_EQUAL(configured, tuner.value(TuningSet::stored, 0, integral), 0.0);
  tuner.conclude({store, Refusal::none});
  DOUBLES_EQUAL(800.0, tuner.value(TuningSet::stored, 0, integral), 0.0);
}

TEST(Tuner, ClearedValuesAreNoLongerStoredOnceTheLoopHasExecutedIt) {
  channel.tuning.controllers[0].values[integral] = 800.0;
  supercoil::Tuner tuner(channel, tick_s);
  for (const Refusal refusal : {Refusal::queue_full, Refusal::none}) {
    DOUBLES_EQUAL(800.0, tuner.value(TuningSet::stored, 0, integral), 0.0);
    Command clear = command(Verb::store, clear_tuning);
    tuner.add_to(clear, muscle);
    CHECK(clear.tuning != nullptr && *clear.tuning == board::StoredTuning{});
    tuner.conclude({clear, refusal});
  }
  DOUBLES_EQUAL(configured, tuner.value(TuningSet::stored, 0, integral), 0.0);
  // Commands that store or forget the muscle do not affect the tuning.
  for (const double muscles : {0.0, 1.0}) {
    Command other = command(Verb::store, muscles);
    tuner.add_to(other, muscle);
    CHECK(other.tuning == nullptr);
  }
  LONGS_EQUAL(2, static_cast<int>(store_tuning));
  LONGS_EQUAL(3, static_cast<int>(clear_tuning));
}

TEST(Tuner, ChecksASetAgainstTheCurrentMuscle) {
  supercoil::Tuner tuner(channel, tick_s);
  control::PhysicalParameters strong = muscle;
  strong.force_per_kelvin_N_per_K *= 100.0;
  Command tune = command(Verb::tune, 0.0);
  tuner.add_to(tune, strong);
  CHECK(tune.tuned_controller == nullptr);
  STRCMP_CONTAINS("unstable", tuner.problem().c_str());
  tuner.add_to(tune, muscle);
  CHECK(tune.tuned_controller != nullptr);
  STRCMP_EQUAL("", tuner.problem().c_str());
}

TEST(Tuner, AnEstimatorStartsAtTheCurrentMuscle) {
  const std::size_t trusted = control::tunable_named("trusted_error");
  const std::size_t place = first_estimator_place;
  supercoil::Tuner tuner(channel, tick_s);
  CHECK(std::isnan(tuner.value(TuningSet::in_use, place + 1, trusted)));
  CHECK(std::isnan(tuner.value(TuningSet::in_use, place - 1, trusted)));
  CHECK(std::isnan(tuner.value(TuningSet::in_use, place, integral)));
  CHECK(std::isnan(tuner.value(TuningSet::in_use, 0, trusted)));
  CHECK(tuner.prepare(place, trusted, 0.1).refusal == Refusal::none);
  control::PhysicalParameters known = muscle;
  known.stiffness_N_per_m *= 1.25;
  Command tune = command(Verb::tune, place);
  tuner.add_to(tune, known);
  CHECK(tune.tuned_controller == nullptr);
  CHECK(tune.tuned_estimator != nullptr);
  if (tune.tuned_estimator == nullptr) return;
  const control::Theta begins = tune.tuned_estimator->estimate()->theta;
  const control::Theta wanted = control::theta_from(known);
  for (int i = 0; i < 4; ++i)
    DOUBLES_EQUAL(1.0, begins[i] / wanted[i], 1e-12);
  tuner.conclude({tune, Refusal::busy});
  DOUBLES_EQUAL(0.2, tuner.value(TuningSet::in_use, place, trusted), 0.0);
  tuner.add_to(tune, known);
  tuner.conclude({tune, Refusal::none});
  DOUBLES_EQUAL(0.1, tuner.value(TuningSet::in_use, place, trusted), 0.0);
  // The start of an estimate is not one of its values.
  CHECK(tuner.prepare_from(TuningSet::configured, place));
  DOUBLES_EQUAL(0.2, tuner.value(TuningSet::prepared, place, trusted), 0.0);

  Command store = command(Verb::store, store_tuning);
  tuner.add_to(store, muscle);
  for (std::size_t i = 0; i < control::tunable_count; ++i)
    CHECK_EQUAL(i == trusted, store.tuning->estimators[0].values[i].has_value());
  tuner.conclude({store, Refusal::none});
  DOUBLES_EQUAL(0.1, tuner.value(TuningSet::stored, place, trusted), 0.0);
}

TEST(Tuner, AnEstimatorThatCannotRunIsRefused) {
  const std::size_t kind = control::tunable_named("kind");
  const std::size_t place = first_estimator_place;
  channel.estimators[0].arithmetic = control::Arithmetic::q8_24;
  supercoil::Tuner tuner(channel, tick_s);
  for (const auto& [wanted, why] :
       {std::pair{2.0, "must be double or float"}, std::pair{3.0, "is not a kind of estimator"}}) {
    CHECK(tuner.prepare(place, kind, wanted).refusal == Refusal::none);
    Command tune = command(Verb::tune, place);
    tuner.add_to(tune, muscle);
    CHECK(tune.tuned_estimator == nullptr);
    STRCMP_CONTAINS(why, tuner.problem().c_str());
  }
  CHECK(tuner.prepare(place, kind, 7.0).refusal == Refusal::out_of_range);
}
