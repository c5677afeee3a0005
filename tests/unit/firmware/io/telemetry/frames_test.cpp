// A signal's value is read back rounded to the nearest quantum, limited to the range, and as "not
// available" when it is NaN.
#include "telemetry/frames.hpp"

#include <cmath>
#include <limits>

#include <supercoil.h>

#include <CppUTest/TestHarness.h>
#include <rapidcheck.h>

#include "unit/firmware/io/can/support/unpacked.hpp"

using namespace supercoil;
using namespace supercoil::telemetry;
using supercoil::test::unpacked;

namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

/// A scaled signal, from the row's quantity to what a receiver reads; NaN: not available.
struct Signal {
  const char* name;
  float Row::*quantity;
  double quantum;
  double min;
  double max;
  double (*read)(const Row& row);
};

double position(const Row& row) {
  const auto m = unpacked(measurement(1, row), supercoil_measurement_unpack);
  return m.position_m == -8388608 ? NAN : supercoil_measurement_position_m_decode(m.position_m);
}
double resistance(const Row& row) {
  const auto m = unpacked(measurement(1, row), supercoil_measurement_unpack);
  return m.resistance_ohm == 16777215U
             ? NAN
             : supercoil_measurement_resistance_ohm_decode(m.resistance_ohm);
}
double resistance_age(const Row& row) {
  const auto m = unpacked(measurement(1, row), supercoil_measurement_unpack);
  return m.resistance_age_s == 65535
             ? NAN
             : supercoil_measurement_resistance_age_s_decode(m.resistance_age_s);
}
double reference(const Row& row) {
  const auto m = unpacked(tracking(1, row), supercoil_tracking_unpack);
  return m.reference_m == -8388608 ? NAN : supercoil_tracking_reference_m_decode(m.reference_m);
}
double model(const Row& row) {
  const auto m = unpacked(tracking(1, row), supercoil_tracking_unpack);
  return m.model_m == -8388608 ? NAN : supercoil_tracking_model_m_decode(m.model_m);
}
/// The model is 0, so the error is the position.
double error(const Row& row) {
  const auto m = unpacked(tracking(1, row), supercoil_tracking_unpack);
  return m.error_m == -32768 ? NAN : supercoil_tracking_error_m_decode(m.error_m);
}
double demanded(const Row& row) {
  const auto m = unpacked(power(1, row), supercoil_power_unpack);
  return m.demanded_w == -8388608 ? NAN : supercoil_power_demanded_w_decode(m.demanded_w);
}
double applied(const Row& row) {
  const auto m = unpacked(power(1, row), supercoil_power_unpack);
  return m.applied_w == -8388608 ? NAN : supercoil_power_applied_w_decode(m.applied_w);
}
double supply(const Row& row) {
  const auto m = unpacked(heater(1, row), supercoil_heater_unpack);
  return m.supply_v == 65535 ? NAN : supercoil_heater_supply_v_decode(m.supply_v);
}
double current(const Row& row) {
  const auto m = unpacked(heater(1, row), supercoil_heater_unpack);
  return m.current_a == -8388608 ? NAN : supercoil_heater_current_a_decode(m.current_a);
}
double duty(const Row& row) {
  const auto m = unpacked(heater(1, row), supercoil_heater_unpack);
  return m.duty == 65535 ? NAN : supercoil_heater_duty_decode(m.duty);
}
double coldest(const Row& row) {
  const auto m = unpacked(temperature(1, row), supercoil_temperature_unpack);
  return m.coldest_c == -32768 ? NAN : supercoil_temperature_coldest_c_decode(m.coldest_c);
}
double hottest(const Row& row) {
  const auto m = unpacked(temperature(1, row), supercoil_temperature_unpack);
  return m.hottest_c == -32768 ? NAN : supercoil_temperature_hottest_c_decode(m.hottest_c);
}
double error_bound(const Row& row) {
  const auto m = unpacked(estimate(1, row, 0, {0.0086, 0.09}), supercoil_estimate_unpack);
  return m.error_bound == 65535 ? NAN : supercoil_estimate_error_bound_decode(m.error_bound);
}
double used(const Row& row) {
  const auto m = unpacked(margin(1, row), supercoil_margin_unpack);
  return m.used == 65535 ? NAN : supercoil_margin_used_decode(m.used);
}
double progress(const Row& row) {
  const auto m = unpacked(status(1, row, false, 0), supercoil_status_unpack);
  return m.progress == 255 ? NAN : supercoil_status_progress_decode(m.progress);
}

constexpr Signal signals[] = {
    {"position_m", &Row::position_m, 1e-7, -0.8388607, 0.8388607, position},
    {"resistance_Ohm", &Row::resistance_Ohm, 1e-3, 0.0, 16777.214, resistance},
    {"resistance_age_s", &Row::resistance_age_s, 1e-2, 0.0, 655.34, resistance_age},
    {"reference_m", &Row::reference, 1e-7, -0.8388607, 0.8388607, reference},
    {"model_m", &Row::model_m, 1e-7, -0.8388607, 0.8388607, model},
    {"error_m", &Row::position_m, 1e-6, -0.032767, 0.032767, error},
    {"demanded_W", &Row::demanded_W, 2e-4, -1677.7214, 1677.7214, demanded},
    {"applied_W", &Row::applied_W, 2e-4, -1677.7214, 1677.7214, applied},
    {"supply_V", &Row::supply_V, 1e-3, 0.0, 65.534, supply},
    {"current_A", &Row::current_A, 1e-5, -83.88607, 83.88607, current},
    {"duty", &Row::duty, 2e-5, 0.0, 1.31068, duty},
    {"coldest_C", &Row::coldest_C, 1e-2, -327.67, 327.67, coldest},
    {"hottest_C", &Row::hottest_C, 1e-2, -327.67, 327.67, hottest},
    {"error_bound", &Row::error_bound, 1e-4, 0.0, 6.5534, error_bound},
    {"used", &Row::margin_used, 1e-3, 0.0, 65.534, used},
    {"progress", &Row::progress, 5e-3, 0.0, 1.27, progress},
};

double read(const Signal& signal, float value) {
  Row row{};
  row.mode = static_cast<std::uint8_t>(Mode::position);
  row.*signal.quantity = value;
  return signal.read(row);
}

bool is_right(const Signal& signal, float value) {
  const double back = read(signal, value);
  if (std::isnan(value)) return std::isnan(back);
  const double expected = std::fmin(std::fmax(value, signal.min), signal.max);
  // Half a quantum, plus the rounding of the largest raw number times the scale.
  return std::abs(back - expected) <= 0.5 * signal.quantum * (1.0 + 1e-6);
}

}  // namespace

TEST_GROUP(Frames){};

TEST(Frames, EverySignalRoundTripsWithinHalfAQuantum) {
  for (const Signal& signal : signals) {
    const bool holds = rc::check(signal.name, [&] {
      // Most are within the range, some far beyond it.
      const auto thousandths = *rc::gen::inRange(-1'500'000, 1'500'001);
      const double part = thousandths * 1e-6;
      RC_ASSERT(is_right(signal, static_cast<float>(part * signal.max)));
      RC_ASSERT(is_right(signal, *rc::gen::arbitrary<float>()));
    });
    CHECK_TEXT(holds, signal.name);
  }
}

TEST(Frames, ExtremesSaturateAndNaNIsNotAvailable) {
  for (const Signal& signal : signals) {
    const auto low = static_cast<float>(signal.min);
    const auto high = static_cast<float>(signal.max);
    for (const float value :
         {infinite, -infinite, std::nanf(""), std::numeric_limits<float>::max(),
          std::numeric_limits<float>::lowest(), std::numeric_limits<float>::denorm_min(), 0.0F,
          -0.0F, low, high, std::nextafter(low, -infinite), std::nextafter(high, infinite)}) {
      CHECK_TEXT(is_right(signal, value), signal.name);
    }
    DOUBLES_EQUAL(signal.max, read(signal, infinite), 1e-6 * signal.max);
    DOUBLES_EQUAL(signal.min, read(signal, -infinite), 1e-6 * signal.max);
  }
}

TEST(Frames, FloatsAreSentUnchanged) {
  for (const float value : {infinite, -infinite, 1e-38F, -3.5e37F, 0.1F}) {
    Row row{};
    row.margin_measured = row.margin_limit = row.theta[2] = value;
    CHECK(unpacked(margin(1, row), supercoil_margin_unpack).measured == value);
    CHECK(unpacked(limit(1, row), supercoil_limit_unpack).limit == value);
    CHECK(unpacked(estimate(1, row, 2, {1, 1}), supercoil_estimate_unpack).theta3 == value);
  }
  Row row{};
  row.margin_measured = std::nanf("");
  CHECK(std::isnan(unpacked(margin(1, row), supercoil_margin_unpack).measured));
}

TEST(Frames, BiasAndDeviationsAreTheLatestOrNaN) {
  MultiplexedValues multiplexed;
  const auto carried = [&](std::size_t place) {
    const auto parameter = static_cast<std::uint8_t>(7 + place);
    const auto m =
        unpacked(estimate(1, {}, parameter, {1, 1}, multiplexed), supercoil_estimate_unpack);
    LONGS_EQUAL(parameter, m.parameter);
    const float of[] = {m.bias_w,           m.theta1_deviation, m.theta2_deviation,
                        m.theta3_deviation, m.theta4_deviation, m.bias_deviation_w};
    return of[place - 1];
  };
  for (std::uint8_t place = 6; place > 0; --place) {
    LONGS_EQUAL(8, multiplexed.parameters());
    CHECK(std::isnan(carried(place)));
    Row row{};
    row.multiplexed_selector = place;
    for (const float value : {99.0F, 0.5F * static_cast<float>(place)}) {
      row.multiplexed_value = value;
      multiplexed.take(row);
    }
  }
  LONGS_EQUAL(14, multiplexed.parameters());
  for (std::uint8_t place = 1; place <= 6; ++place)
    CHECK(carried(place) == 0.5F * static_cast<float>(place));
  multiplexed.take({});
  LONGS_EQUAL(8, multiplexed.parameters());
  for (std::uint8_t place = 1; place <= 6; ++place)
    CHECK(std::isnan(carried(place)));
}

TEST(Frames, AStatusReportsThatTheProofOfResponseIsOff) {
  Row row{};
  LONGS_EQUAL(0, unpacked(status(1, row, false, 0), supercoil_status_unpack).proof_off);
  row.flags = row_proof_off;
  LONGS_EQUAL(1, unpacked(status(1, row, false, 0), supercoil_status_unpack).proof_off);
  LONGS_EQUAL(0, unpacked(status(1, row, false, 0), supercoil_status_unpack).slack);
  row.flags = row_slack;
  LONGS_EQUAL(1, unpacked(status(1, row, false, 0), supercoil_status_unpack).slack);
}

TEST(Frames, FrictionIsReportedInTheStatus) {
  Row row{};
  LONGS_EQUAL(0, unpacked(status(1, row, false, 0), supercoil_status_unpack).friction);
  row.identify_notes = note_friction | note_theta1_kept;
  LONGS_EQUAL(1, unpacked(status(1, row, false, 0), supercoil_status_unpack).friction);
  const auto m = unpacked(estimate(1, row, 0, {1, 1}, {}), supercoil_estimate_unpack);
  LONGS_EQUAL(1, m.identify_notes);
  LONGS_EQUAL(0, m.trusted);
}

TEST(Frames, EveryEstimateCarriesTheNotesOfIdentify) {
  Row row{};
  row.identify_notes = note_too_little_motion | note_theta1_kept;
  for (std::uint8_t parameter = 0; parameter < 14; ++parameter) {
    const auto m = unpacked(estimate(1, row, parameter, {1, 1}, {}), supercoil_estimate_unpack);
    LONGS_EQUAL(65, m.identify_notes);
    LONGS_EQUAL(0, m.trusted);
  }
}

TEST(Frames, TrackingIsAvailableInModePositionOnly) {
  Row row{};
  row.reference = 3.0F;  // watts
  row.mode = static_cast<std::uint8_t>(Mode::power);
  CHECK(std::isnan(reference(row)));
  CHECK(std::isnan(model(row)));
  CHECK(std::isnan(error(row)));
}

TEST(Frames, TheMuscleIsConvertedFromTheta) {
  const control::PhysicalParameters muscle;
  const control::Theta theta = control::theta_from(muscle);
  Row row{};
  for (int i = 0; i < 4; ++i)
    row.theta[static_cast<std::size_t>(i)] = static_cast<float>(theta[i]);
  const control::KnownParameters known{muscle.force_per_kelvin_N_per_K, muscle.moving_mass_kg};
  const auto stiffness = unpacked(estimate(1, row, 6, known), supercoil_estimate_unpack);
  DOUBLES_EQUAL(16.0, stiffness.stiffness_n_per_m, 1e-3);
  const auto mass = unpacked(estimate(1, row, 4, known), supercoil_estimate_unpack);
  DOUBLES_EQUAL(0.162, mass.thermal_mass_j_per_k, 1e-5);
  row.theta[3] = -1.0F;
  CHECK(std::isnan(
      unpacked(estimate(1, row, 4, known), supercoil_estimate_unpack).thermal_mass_j_per_k));
}

TEST(Frames, AnIdentifierIsItsBasePlusItsNode) {
  LONGS_EQUAL(0x281, measurement(1, {}).id);
  LONGS_EQUAL(0x280 + 63, measurement(63, {}).id);
  LONGS_EQUAL(0x700 + 5, status(5, {}, false, 0).id);
  LONGS_EQUAL(0x080 + 2, emergency(2, {}).id);
}

TEST(Frames, AnEmergencyHasFaultStateAndTimeToAMicrosecond) {
  Row row{};
  row.time_ns = 86'400'123'456'789;
  row.fault = static_cast<std::uint8_t>(Fault::over_temperature);
  row.state = static_cast<std::uint8_t>(State::fault);
  const auto m = unpacked(emergency(1, row), supercoil_emergency_unpack);
  LONGS_EQUAL(30, m.fault);
  LONGS_EQUAL(3, m.state);
  DOUBLES_EQUAL(86400.123457, supercoil_emergency_board_time_s_decode(m.board_time_s), 1e-9);
}

TEST(Frames, TickTimesSaturateAndCountsWrapAround) {
  const auto m = unpacked(timing(1, {3.0, 12.34e-6, 4097, 8193}), supercoil_timing_unpack);
  DOUBLES_EQUAL(0.1048574, supercoil_timing_late_s_decode(m.late_s), 1e-12);
  DOUBLES_EQUAL(12.3e-6, supercoil_timing_execution_s_decode(m.execution_s), 0.06e-6);
  LONGS_EQUAL(1, m.overruns);
  LONGS_EQUAL(1, m.dropped_frames);
  LONGS_EQUAL(0xFFFFF, unpacked(timing(1, {}), supercoil_timing_unpack).late_s);
}

TEST(Frames, BootHasTheProgramsVersionAndCommit) {
  struct Case {
    const char* version;
    int major, minor, patch;
    unsigned commit;
  };
  for (const Case& c : {Case{"0.2.0", 0, 2, 0, 0},
                        Case{"12.34.56+git20261122.150233.2780ebf", 12, 34, 56, 0x2780ebf},
                        Case{"0.2.1+git20261122.150233.0780ebf12", 0, 2, 1, 0x0780ebf},
                        Case{"0.2", 0, 2, 0, 0}, Case{"", 0, 0, 0, 0}}) {
    const auto m = unpacked(boot(1, c.version), supercoil_boot_unpack);
    LONGS_EQUAL_TEXT(c.major, m.version_major, c.version);
    LONGS_EQUAL_TEXT(c.minor, m.version_minor, c.version);
    LONGS_EQUAL_TEXT(c.patch, m.version_patch, c.version);
    UNSIGNED_LONGS_EQUAL_TEXT(c.commit, m.commit, c.version);
  }
}
