// Knots of a trajectory as a page sends them, and the answers it gets.
#include "apps/supercoil/monitor/trajectory_request.hpp"

#include <CppUTest/TestHarness.h>

using namespace supercoil;
using namespace supercoil::operating;

namespace {

std::string knot(const std::string& after_s, const std::string& position_m,
                 const std::string& velocity_m_per_s) {
  return R"({"after_s":)" + after_s + R"(,"position_m":)" + position_m + R"(,"velocity_m_per_s":)" +
         velocity_m_per_s + "}";
}

std::string problem(const std::string& knots, const std::string& start = "false") {
  const auto read =
      parse_trajectory_request(R"({"node":2,"start":)" + start + R"(,"knots":)" + knots + "}");
  return read ? "" : read.error().text();
}

}  // namespace

TEST_GROUP(TrajectoryRequest){};

TEST(TrajectoryRequest, HasItsKnotsInOrder) {
  const auto read =
      parse_trajectory_request(R"({"node":2,"start":true,"knots":[)" + knot("0", "0.005", "0") +
                               "," + knot("0.04", "0.0051", "-0.002") + "]}");
  CHECK(read.has_value());
  LONGS_EQUAL(2, read->node);
  CHECK_TRUE(read->start);
  LONGS_EQUAL(2, read->knots.size());
  DOUBLES_EQUAL(0.005, read->knots[0].position_m, 0.0);
  DOUBLES_EQUAL(0.04, read->knots[1].after_s, 0.0);
  DOUBLES_EQUAL(-0.002, read->knots[1].velocity_m_per_s, 0.0);
}

TEST(TrajectoryRequest, WithoutKnotsIsAQuery) {
  const auto read = parse_trajectory_request(R"({"node":2})");
  CHECK(read.has_value());
  CHECK_TRUE(read->knots.empty());
  CHECK_FALSE(read->start);
}

TEST(TrajectoryRequest, NamesTheKnotItsValueAndTheRange) {
  const std::string first = "[" + knot("0", "0.005", "0") + ",";
  STRCMP_EQUAL("knot 2: after_s is 5.0; it must be 0.0 to 4.094",
               problem(first + knot("5.0", "0", "0") + "]").c_str());
  STRCMP_EQUAL("knot 2: position_m is 1.5; it must be -0.8388607 to 0.8388607",
               problem(first + knot("0.1", "1.5", "0") + "]").c_str());
  STRCMP_EQUAL("knot 2: velocity_m_per_s is null; it must be -0.32767 to 0.32767",
               problem(first + knot("0.1", "0", "null") + "]").c_str());
  STRCMP_EQUAL("knot 1: after_s is missing; it must be 0.0 to 4.094", problem("[{}]").c_str());
  STRCMP_EQUAL("knot 1 must be an object", problem("[1]").c_str());
}

TEST(TrajectoryRequest, LimitsTheNumberOfKnots) {
  std::string knots = knot("0", "0", "0");
  for (std::size_t i = 1; i < max_knots_at_once; ++i)
    knots += "," + knot("0.04", "0", "0");
  STRCMP_EQUAL("", problem("[" + knots + "]").c_str());
  STRCMP_EQUAL("knots is 17 knots; it must be a list of 0 to 16",
               problem("[" + knots + "," + knot("0.04", "0", "0") + "]").c_str());
  STRCMP_EQUAL("knots is no list; it must be a list of 0 to 16", problem("{}").c_str());
  STRCMP_EQUAL("start is 1; it must be true or false", problem("[]", "1").c_str());
}

TEST(TrajectoryRequest, ReturnsTheBoardsAnswer) {
  const std::string json = sent_json({3, {Refusal::infeasible, PlaybackState::playing, 20, 1.5}});
  STRCMP_EQUAL(
      R"({"buffered_s":1.5,"playback":"playing","refusal":"infeasible","room":20,"taken":3})",
      json.c_str());
}
