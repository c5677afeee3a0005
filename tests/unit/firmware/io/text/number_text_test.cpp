#include "text/number_text.hpp"

#include <CppUTest/TestHarness.h>

using namespace supercoil;

TEST_GROUP(NumberText){};

TEST(NumberText, CommonNumbersHaveNoExponentAndOnlyTheRequestedDigits) {
  STRCMP_EQUAL("1480", number_text(1477.3, 3).c_str());
  STRCMP_EQUAL("-1480", number_text(-1477.3, 3).c_str());
  STRCMP_EQUAL("148", number_text(147.73, 3).c_str());
  STRCMP_EQUAL("9990000", number_text(9.99e6, 3).c_str());
  STRCMP_EQUAL("1e+07", number_text(9.999e6, 3).c_str());
  STRCMP_EQUAL("0.00123", number_text(0.0012345, 3).c_str());
  STRCMP_EQUAL("0", number_text(0.0, 3).c_str());
  STRCMP_EQUAL("inf", number_text(INFINITY, 3).c_str());
  STRCMP_EQUAL("nan", number_text(NAN, 3).c_str());
}
