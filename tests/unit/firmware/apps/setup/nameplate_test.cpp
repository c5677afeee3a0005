#include "apps/supercoil/setup/nameplate.hpp"

#include <cmath>
#include <string>

#include <CppUTest/TestHarness.h>

using namespace supercoil::operating;

namespace {

Nameplate rated(double max_C) {
  Nameplate n;
  double values[] = {2.0, 10.0, 150.0, 8.0, 90.0, max_C};
  for (std::size_t i = 0; i < nameplate_questions.size(); ++i)
    n.set(i, values[i]);
  return n;
}

std::string limits(double max_C, double trip_C) {
  std::string text;
  for (const Entry& entry : rated(max_C).limits(trip_C))
    text += entry.path + " = " + entry.literal + "; ";
  return text;
}

}  // namespace

TEST_GROUP(Nameplate){};

TEST(Nameplate, AnswersOnlyWhatASupplierKnows) {
  const Nameplate n = rated(120.0);
  DOUBLES_EQUAL(10.0, n.suggested(QuestionId::cold_resistance_Ohm), 0.0);
  DOUBLES_EQUAL(90.0, n.suggested(QuestionId::load_g), 0.0);
  DOUBLES_EQUAL(2.0, n.suggested(QuestionId::heated_W), 0.0);
  DOUBLES_EQUAL(2.0, n.suggested(QuestionId::max_W), 0.0);
  DOUBLES_EQUAL(12.0, n.suggested(QuestionId::heated_mm), 1e-12);
  DOUBLES_EQUAL(12.0, n.suggested(QuestionId::max_travel_mm), 1e-12);
  DOUBLES_EQUAL(95.0, n.suggested(QuestionId::heated_K), 1e-12);
  DOUBLES_EQUAL(60.0, n.suggested(QuestionId::uncertainty_percent), 0.0);
  for (const QuestionId measured : {QuestionId::stretch_weight_g, QuestionId::stretch_mm,
                                    QuestionId::half_cooling_s, QuestionId::thread_g})
    CHECK(std::isnan(n.suggested(measured)));
  CHECK(std::isnan(rated(0.0).suggested(QuestionId::heated_K)));
  CHECK(std::isnan(Nameplate().suggested(QuestionId::load_g)));
}

TEST(Nameplate, ALowerMaxTemperatureBecomesTheLimit) {
  STRCMP_EQUAL("limits.trip_C = 120; limits.derate_from_C = 101; ", limits(120.0, 160.0).c_str());
  STRCMP_EQUAL("", limits(165.0, 160.0).c_str());
  STRCMP_EQUAL("", limits(120.0, 110.0).c_str());
  STRCMP_EQUAL("", limits(0.0, 160.0).c_str());
  LONGS_EQUAL(0, Nameplate().limits(160.0).size());
}

TEST(Nameplate, TripTemperatureIsReadFromTheBoardFile) {
  const std::string channels = "[[channel]]\n[[channel]]\nlimits.trip_C = 90\n";
  DOUBLES_EQUAL(160.0, trip_in_file_C(channels, 1), 0.0);
  DOUBLES_EQUAL(90.0, trip_in_file_C(channels, 2), 0.0);
  const std::string every = "[every_channel.limits]\ntrip_C = 100.5\n" + channels;
  DOUBLES_EQUAL(100.5, trip_in_file_C(every, 1), 0.0);
  DOUBLES_EQUAL(90.0, trip_in_file_C(every, 2), 0.0);
  const std::string skin = "[every_channel.limits]\npreset = \"skin\"\n[[channel]]\n";
  DOUBLES_EQUAL(0.0, trip_in_file_C(skin, 1), 0.0);
}
