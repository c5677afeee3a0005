#include "storage/codec.hpp"

#include <bit>
#include <limits>
#include <string>

#include <CppUTest/TestHarness.h>
#include <rapidcheck.h>

#include "storage/crc32.hpp"
#include "storage/envelope.hpp"
#include "storage/fields.hpp"
#include "unit/firmware/io/storage/support/sets.hpp"

using namespace supercoil;
using namespace supercoil::storage;
using supercoil::test::answer;
using supercoil::test::learned_sets;

namespace {

void check_answer(const char* expected, const std::string& text) {
  STRCMP_EQUAL(expected, answer(text).c_str());
}

/// With every table that a file may have.
board::Learned full_set() {
  board::Learned set;
  set.senses = {1.25, 0.875, 0.0625, 1795219200.0};
  set.heat = {1.75, 2.25, 21.5, 1.25, 1.5, 1.625};
  set.response_ratio = 0.375;
  set.unexplained_ratio = 0.03125;
  set.identification = {{0.0, 0.25, 0.125, 0.0625}, 1795219201.0};
  return set;
}

/// The file without its first line, with a part replaced, and sealed again.
std::string sealed_with(const std::string& what, const std::string& instead) {
  const std::string text = encode(full_set());
  std::string body = text.substr(text.find('\n') + 1);
  const std::size_t at = body.find(what);
  CHECK_TEXT(at != std::string::npos, what.c_str());
  return seal(body.replace(at, what.size(), instead));
}

}  // namespace

TEST_GROUP(Codec){};

TEST(Codec, TuningRoundTrips) {
  for (const bool has_muscle : {true, false}) {
    board::Learned set = full_set();
    set.has_muscle = has_muscle;
    for (std::size_t place = 0; place < set.tuning.controllers.size(); ++place) {
      for (std::size_t i = place; i < control::tunable_count; i += 3) {
        const control::Tunable& tunable = control::tunables()[i];
        if (tunable.controllers_have()) set.tuning.controllers[place].values[i] = tunable.max;
        if (tunable.estimators_have()) set.tuning.estimators[place].values[i] = tunable.min;
      }
    }
    set.tuning.controller = 3.0;
    const auto read = decode(encode(set));
    CHECK_TEXT(read.has_value(), read ? "" : read.error().text().c_str());
    CHECK(read->tuning == set.tuning);
    CHECK(read->has_muscle == has_muscle);
  }
}

TEST(Codec, InvalidTuningIsNamed) {
  const auto with = [](const std::string& lines) {
    const std::string text = encode(full_set());
    return seal(text.substr(text.find('\n') + 1) + lines);
  };
  check_answer("in order", with("\n[controller_0]\nlearn = 1.0\n"));
  check_answer("learn = 0.5 is out of range: must be 0 to 1",
               with("\n[controller_0]\nlearn = 0.5\n"));
  check_answer("has a key that this firmware does not know: controller_1.gain",
               with("\n[controller_1]\ngain = 1.0\n"));
  check_answer("has a key that this firmware does not know: controller_4",
               with("\n[controller_4]\nlearn = 1.0\n"));
  check_answer("has a key that this firmware does not know: controller_1.min_ratio",
               with("\n[controller_1]\nmin_ratio = 0.5\n"));
  check_answer("has a key that this firmware does not know: estimator_1.learn",
               with("\n[estimator_1]\nlearn = 1.0\n"));
  check_answer("min_ratio = 2 is out of range: must be 0.001 to 1",
               with("\n[estimator_1]\nmin_ratio = 2.0\n"));
  check_answer("controller_3.follow_s is not a number",
               with("\n[controller_3]\nfollow_s = true\n"));
  check_answer("estimator = 0.5 is out of range: must be 0 to 255",
               with("\n[chosen]\nestimator = 0.5\n"));
}

// The checksum is that of Python's zlib.crc32 for these lines.
TEST(Codec, WritesReadableText) {
  board::Learned set;
  set.calibration.position_offset_m = -0.00125;
  set.version = 3;
  STRCMP_EQUAL(
      "# supercoil learned, format 2, 352 bytes, CRC-32 b7433581\n"
      "# Written by supercoild. An edited file counts as damaged and is not used.\n"
      "version = 3\n"
      "\n"
      "[muscle]\n"
      "thermal_mass_J_per_K = 0.162\n"
      "heat_transfer_W_per_K = 0.089\n"
      "stiffness_N_per_m = 16.0\n"
      "damping_Ns_per_m = 2.0\n"
      "moving_mass_kg = 0.09\n"
      "force_per_kelvin_N_per_K = 0.0086\n"
      "\n"
      "[calibration]\n"
      "position_offset_m = -0.00125\n"
      "position_scale = 1.0\n"
      "cold_resistance_Ohm = 10.0\n",
      encode(set).c_str());
}

TEST(Codec, AFileFromBeforeComparisonsHasNone) {
  // As the previous firmware wrote it.
  const std::string before =
      "# supercoil learned, format 1, 352 bytes, CRC-32 b7433581\n"
      "# Written by supercoild. An edited file counts as damaged and is not used.\n"
      "version = 3\n\n[muscle]\nthermal_mass_J_per_K = 0.162\nheat_transfer_W_per_K = 0.089\n"
      "stiffness_N_per_m = 16.0\ndamping_Ns_per_m = 2.0\nmoving_mass_kg = 0.09\n"
      "force_per_kelvin_N_per_K = 0.0086\n\n[calibration]\nposition_offset_m = -0.00125\n"
      "position_scale = 1.0\ncold_resistance_Ohm = 10.0\n";
  const auto read = decode(before);
  CHECK(read.has_value());
  CHECK(read->has_muscle);
  CHECK_FALSE(read->senses.compared());
  CHECK(read->senses == board::SenseComparison{});
}

TEST(Codec, AFileOf0_1_0IsReadByItsOwnKeys) {
  // From docs/storage.md of 0.1.0.
  const std::string body =
      "# Written by supercoild. An edited file counts as damaged and is not used.\n"
      "version = 3\n\n[muscle]\nthermal_mass_J_per_K = 0.162\nheat_transfer_W_per_K = 0.089\n"
      "stiffness_N_per_m = 16.0\ndamping_Ns_per_m = 2.0\nmoving_mass_kg = 0.09\n"
      "force_per_kelvin_N_per_K = 0.0086\n\n[calibration]\nposition_offset_m = -0.00125\n"
      "position_scale = 1.0\ncold_resistance_Ohm = 10.0\n\n[senses]\nsupply_gain = 1.012\n"
      "current_gain = 0.994\nerror_ratio = 0.021\ncompared_s = 1795219200.0\n\n[heat]\n"
      "time_constant_s = 1.81\ntime_constant_at_W = 2.17\nsteady_rise_K = 21.5\n"
      "steady_error_K = 1.3\nsteady_min_W = 1.49\nsteady_max_W = 1.51\n\n[small_motions]\n";
  const std::string whole = "# supercoil learned, format 1, 625 bytes, CRC-32 a4be8f0a\n" + body +
                            "answer_ratio = 0.98\n";
  const auto read = decode(whole);
  CHECK_TEXT(read.has_value(), answer(whole).c_str());
  DOUBLES_EQUAL(0.98, read->response_ratio, 0.0);
  CHECK(read->heat.time_constant_s == 1.81);
  // Under the new format the old key is unknown, and the new one under the old format.
  check_answer("has a key that this firmware does not know: small_motions.answer_ratio",
               seal(body + "answer_ratio = 0.98\n"));
  check_answer("has a key that this firmware does not know: small_motions.response_ratio",
               seal(body + "response_ratio = 0.98\n", 1));
}

TEST(Codec, AComparisonHasATableOfItsOwn) {
  STRCMP_CONTAINS(
      "\n[senses]\nsupply_gain = 1.25\ncurrent_gain = 0.875\nerror_ratio = 0.0625\n"
      "compared_s = 1795219200.0\n",
      encode(full_set()).c_str());
}

TEST(Codec, HeatHasATableOfItsOwn) {
  STRCMP_CONTAINS(
      "\n[heat]\ntime_constant_s = 1.75\ntime_constant_at_W = 2.25\nsteady_rise_K = 21.5\n"
      "steady_error_K = 1.25\nsteady_min_W = 1.5\nsteady_max_W = 1.625\n",
      encode(full_set()).c_str());
  board::Learned set = full_set();
  CHECK(decode(encode(set)) == set);
  set.heat = {};
  CHECK(encode(set).find("heat]") == std::string::npos);
  CHECK(decode(encode(set)) == set);
}

TEST(Codec, SmallMotionsHaveATableOfTheirOwnWhenMeasured) {
  board::Learned set = full_set();
  STRCMP_CONTAINS("\n[small_motions]\nresponse_ratio = 0.375\n", encode(set).c_str());
  set.response_ratio = 0.0;
  CHECK(encode(set).find("small_motions") == std::string::npos);
  CHECK(decode(encode(set)) == set);
}

TEST(Codec, TheUnexplainedRatioHasATableOfItsOwnWhenIdentified) {
  board::Learned set = full_set();
  STRCMP_CONTAINS("\n[linear_model]\nunexplained_ratio = 0.03125\n", encode(set).c_str());
  set.unexplained_ratio = 0.0;
  CHECK(encode(set).find("linear_model") == std::string::npos);
  CHECK(decode(encode(set)) == set);
}

TEST(Codec, DeviationsOfIdentifyHaveATableOfTheirOwn) {
  board::Learned set = full_set();
  STRCMP_CONTAINS(
      "\n[identification]\ntheta1_deviation_ratio = 0.0\ntheta2_deviation_ratio = 0.25\n"
      "theta3_deviation_ratio = 0.125\ntheta4_deviation_ratio = 0.0625\n"
      "identified_s = 1795219201.0\n",
      encode(set).c_str());
  CHECK(decode(encode(set)) == set);
  set.identification = {};
  CHECK(encode(set).find("identification") == std::string::npos);
  CHECK(decode(encode(set)) == set);
}

TEST(Codec, ASenseComparisonIsStoredWithoutAMuscle) {
  board::Learned set = full_set();
  set.has_muscle = false;
  set.response_ratio = set.unexplained_ratio = 0.0;
  set.identification = {};
  set.version = 1;
  CHECK(encode(set).find("muscle") == std::string::npos);
  CHECK(encode(set).find("calibration") == std::string::npos);
  CHECK(decode(encode(set)) == set);
  // And with neither, because the comparison was forgotten as well.
  set.senses = {};
  set.heat = {};
  CHECK(decode(encode(set)) == set);
}

TEST(Codec, EveryValidSetRoundTripsBitForBit) {
  CHECK(rc::check("round trip", [] {
    board::Learned set = *learned_sets();
    RC_ASSERT_FALSE(check(set).has_value());
    auto read = decode(encode(set));
    if (!read) RC_FAIL(read.error().text());
    RC_ASSERT(read->version == set.version);
    for (const Field& field : fields) {
      RC_ASSERT(std::bit_cast<std::uint64_t>(field.of(*read)) ==
                std::bit_cast<std::uint64_t>(field.of(set)));
    }
  }));
}

TEST(Codec, NoInvalidSetIsAccepted) {
  for (const Field& field : fields) {
    for (const double bad : {-1e15, 1e15}) {
      board::Learned set = full_set();
      field.of(set) = bad;
      STRCMP_CONTAINS(" is out of range: must be ", answer(encode(set)).c_str());
    }
  }
}

TEST(Codec, NamesTheNumberAndItsRange) {
  check_answer("stiffness_N_per_m = -16 is out of range: must be 0.01 to 1e+06",
               sealed_with("= 16.0", "= -16.0"));
  check_answer("position_scale = 0 is out of range: must be 0.1 to 10",
               sealed_with("scale = 1.0", "scale = 0.0"));
}

TEST(Codec, RefusesNumbersThatAreNotFinite) {
  board::Learned set;
  set.muscle.damping_Ns_per_m = std::numeric_limits<double>::quiet_NaN();
  check_answer("muscle.damping_Ns_per_m is nan, which is not a finite number", encode(set));
  set.muscle.damping_Ns_per_m = -std::numeric_limits<double>::infinity();
  check_answer("muscle.damping_Ns_per_m is -inf, which is not a finite number", encode(set));
}

TEST(Codec, RefusesAMissingKey) {
  for (const Field& field : fields) {
    const std::string key(field.key);
    const std::string path = std::string(field.table) + "." + key;
    check_answer((path + " is missing").c_str(), sealed_with(key, "# " + key));
  }
  check_answer("version is missing", sealed_with("version", "# version"));
  check_answer("muscle.thermal_mass_J_per_K is missing",
               seal("version = 1\n[calibration]\nposition_scale = 1.0\n"));
}

TEST(Codec, RefusesAnUnknownKey) {
  check_answer("has a key that this firmware does not know: muscle.colour",
               sealed_with("[calibration]", "colour = 1.0\n[calibration]"));
  check_answer("has a key that this firmware does not know: colour",
               sealed_with("version", "colour = 1.0\nversion"));
  check_answer("has a key that this firmware does not know: colours",
               seal("version = 1\n[colours]\n"));
  check_answer("has a key that this firmware does not know: muscle",
               seal("version = 1\nmuscle = 3\n"));
}

TEST(Codec, RefusesAnotherType) {
  check_answer("muscle.moving_mass_kg is not a number", sealed_with("0.09\n", "'0.09'\n"));
  for (const char* version : {"1.5", "-1", "4294967296", "'1'"}) {
    check_answer("version must be a whole number, 0 to 4294967295",
                 sealed_with("version = 0", std::string("version = ") + version));
  }
}

TEST(Codec, RefusesInvalidToml) {
  STRCMP_CONTAINS("is not valid TOML: ", answer(sealed_with("= 16.0", "= = 16.0")).c_str());
  STRCMP_CONTAINS("is not valid TOML: ", answer(sealed_with("[calibration]", "[muscle]")).c_str());
}

TEST(Codec, SmallMotionsAreNotStoredWithoutAMuscle) {
  board::Learned set = full_set();
  set.has_muscle = false;
  CHECK(encode(set).find("small_motions") == std::string::npos);
  const auto read = decode(encode(set));
  CHECK(read.has_value());
  CHECK_FALSE(read->has_muscle);
  DOUBLES_EQUAL(0.0, read->response_ratio, 0.0);
}

// The check value is from the catalogue of CRC algorithms for CRC-32/ISO-HDLC.
TEST(Codec, ChecksumOfTwoPartsIsThatOfTheWhole) {
  UNSIGNED_LONGS_EQUAL(0xCBF43926, crc32("123456789"));
  UNSIGNED_LONGS_EQUAL(0xCBF43926, crc32("1234", "56789"));
  UNSIGNED_LONGS_EQUAL(0xCBF43926, crc32("", "123456789"));
}
