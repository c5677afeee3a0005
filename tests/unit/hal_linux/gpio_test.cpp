// What can be tested without a GPIO chip: the report that there is none.
#include <cerrno>
#include <string>

#include <CppUTest/TestHarness.h>

#include "supercoil/hal_linux/gpio_line.hpp"

#include "unit/hal_linux/support/temporary_folder.hpp"

using namespace supercoil::hal_linux;
using supercoil::test::TemporaryFolder;

TEST_GROUP(Gpio) {
  TemporaryFolder dev;
  std::string answer() const {
    const auto line = GpioOutput::open({"pinctrl-bcm2711", "GPIO17"}, dev.path());
    return line ? "open" : line.error().text();
  }
};

TEST(Gpio, ReportsThatThereIsNoChip) {
  STRCMP_EQUAL(
      ("no chip with the label 'pinctrl-bcm2711' in " + dev.path() + ": there is no chip").c_str(),
      answer().c_str());
  const auto input = GpioInput::open({"x", "y"}, "/nowhere");
  STRCMP_EQUAL("cannot list /nowhere: No such file or directory", input.error().text().c_str());
}

TEST(Gpio, ReportsWhyAChipCannotBeOpened) {
  dev.write("gpiochip0", "");
  dev.make_pipe("gpiochip1");
  dev.make_folder("gpiochip2");
  const std::string text = answer();
  for (const char* chip : {"gpiochip0", "gpiochip1", "gpiochip2"}) {
    STRCMP_CONTAINS(("cannot open " + dev / chip + ": ").c_str(), text.c_str());
  }
}

TEST(Gpio, OmitsOtherNamesOfAChip) {
  dev.write("gpiochip0", "");
  dev.link("gpiochip4", "gpiochip0");
  dev.link("gpiochip5", "nowhere");
  STRCMP_CONTAINS("gpiochip0", answer().c_str());
  CHECK(answer().find("gpiochip4") == std::string::npos);
  CHECK(answer().find("gpiochip5") == std::string::npos);
}
