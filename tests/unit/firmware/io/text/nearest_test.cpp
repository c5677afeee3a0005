#include "text/nearest.hpp"

#include <CppUTest/TestHarness.h>

using namespace supercoil;

TEST_GROUP(Nearest){};

TEST(Nearest, ForgottenUnitComesFirst) {
  const Nearest nearest = nearest_name("max", {"min_W", "max_W"});
  STRCMP_EQUAL("max_W", nearest.name.c_str());
  CHECK(nearest.lacks_unit);
}

TEST(Nearest, AmongSeveralMissingSuffixesTheShortestWins) {
  for (const auto& known : {std::vector<std::string>{"lever_range_deg", "lever_m", "leverr"},
                            std::vector<std::string>{"leverr", "lever_m", "lever_range_deg"}}) {
    const Nearest nearest = nearest_name("lever", known);
    STRCMP_EQUAL("lever_m", nearest.name.c_str());
    CHECK(nearest.lacks_unit);
  }
}

TEST(Nearest, SwappedLettersAreOneEdit) {
  STRCMP_EQUAL("arm", nearest_name("amr", {"disarm", "arm", "rest"}).name.c_str());
  STRCMP_EQUAL("arm", nearest_name("ram", {"arm"}).name.c_str());
  STRCMP_EQUAL("", nearest_name("mra", {"arm"}).name.c_str());
}

TEST(Nearest, OtherwiseTheFewestEdits) {
  const Nearest nearest = nearest_name("rate_hz", {"duration_s", "rate_Hz", "seed"});
  STRCMP_EQUAL("rate_Hz", nearest.name.c_str());
  CHECK_FALSE(nearest.lacks_unit);
}

TEST(Nearest, AMisspeltNameWithoutItsUnitMatchesByItsStart) {
  const Nearest nearest = nearest_name("bandwith", {"max_W", "bandwidth_rad_per_s", "band"});
  STRCMP_EQUAL("bandwidth_rad_per_s", nearest.name.c_str());
  CHECK(nearest.lacks_unit);
  STRCMP_EQUAL("",
               nearest_name("volume", {"gain_1", "max_W", "model_pole_1_rad_per_s"}).name.c_str());
}

TEST(Nearest, NoneIsFoundWhenAllAreFar) {
  STRCMP_EQUAL("", nearest_name("banana", {"seed", "rate_Hz"}).name.c_str());
  STRCMP_EQUAL("", nearest_name("banana", {}).name.c_str());
}
