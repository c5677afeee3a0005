#include "supercoil/hal_linux/gpio_line.hpp"

#include <cerrno>
#include <string>

#include <malloc.h>

#include <CppUTest/TestHarness.h>

#include "supercoil/hal_linux/status_of.hpp"

#include "unit/hal_linux/support/gpio_kernel.hpp"
#include "unit/hal_linux/support/temporary_folder.hpp"

using namespace supercoil;
using namespace supercoil::hal_linux;
using namespace supercoil::test;

TEST_GROUP(GpioLine) {
  TemporaryFolder dev;
  FakeChip* processor = nullptr;

  void setup() override {
    gpio_kernel() = {};
    add("gpiochip0", "raspberrypi-exp-gpio", {"BT_ON", "WL_ON"});
    processor = add("gpiochip1", "pinctrl-bcm2711", {"ID_SDA", "", "GPIO5", "GPIO17"});
  }
  // An open chip would mean that a line is still held.
  void teardown() override {
    LONGS_EQUAL(0, gpio_kernel().opened);
  }

  FakeChip* add(const std::string& name, const std::string& label,
                const std::vector<std::string>& lines) const {
    dev.write(name, "");
    FakeChip& chip = gpio_kernel().chips[dev / name];
    chip.name = name;
    chip.label = label;
    chip.lines.resize(lines.size());
    for (std::size_t i = 0; i < lines.size(); ++i)
      chip.lines[i].name = lines[i];
    return &chip;
  }
  Result<std::unique_ptr<GpioOutput>> output(const std::string& chip, const std::string& line)
      const {
    return GpioOutput::open({chip, line}, dev.path());
  }
  std::string answer(const std::string& chip, const std::string& line) const {
    const auto opened = output(chip, line);
    return opened ? "open" : opened.error().text();
  }
  static void check_status(hal::Status expected, hal::Status status) {
    STRCMP_EQUAL(hal::text(expected), hal::text(status));
  }
};

TEST(GpioLine, IsLowFromRequestToRelease) {
  FakeLine& line = processor->lines[2];
  line.value = 1;
  {
    const auto enable = output("pinctrl-bcm2711", "GPIO5");
    LONGS_EQUAL(0, line.value);
    STRCMP_EQUAL("supercoil", line.consumer.c_str());
    check_status(hal::Status::ok, (*enable)->set(true));
    LONGS_EQUAL(1, line.value);
  }
  const std::vector<std::string> expected = {"output 0", "set 1", "set 0", "release"};
  CHECK(line.history == expected);
}

TEST(GpioLine, ReportsWhyALevelWasNotSet) {
  const auto enable = output("pinctrl-bcm2711", "GPIO5");
  for (const int error : {EIO, ENODEV, EBUSY, EAGAIN}) {
    gpio_kernel().fails_with = error;
    check_status(status_of(error), (*enable)->set(true));
  }
}

TEST(GpioLine, ReadsBothLevelsAndFailures) {
  FakeLine& line = processor->lines[3];
  const auto stop = GpioInput::open({"pinctrl-bcm2711", "GPIO17"}, dev.path());
  CHECK_FALSE(line.output);
  for (const int value : {1, 0, 1}) {
    line.value = value;
    const hal::Level level = (*stop)->read();
    check_status(hal::Status::ok, level.status);
    CHECK(level.high == (value == 1));
  }
  for (const int error : {EIO, ENODEV}) {
    gpio_kernel().fails_with = error;
    check_status(status_of(error), (*stop)->read().status);
    CHECK_FALSE((*stop)->read().high);
  }
}

TEST(GpioLine, ListsTheAvailableChips) {
  dev.write("gpiochip2", "no chip");
  STRCMP_EQUAL(("no chip with the label 'pinctrl-rp1' in " + dev.path() +
                ": there are gpiochip0 'raspberrypi-exp-gpio', gpiochip1 'pinctrl-bcm2711', "
                "cannot open " +
                dev / "gpiochip2" + ": Inappropriate ioctl for device")
                   .c_str(),
               answer("pinctrl-rp1", "GPIO5").c_str());
}

TEST(GpioLine, ListsTheAvailableLines) {
  STRCMP_EQUAL(
      "no line 'GPIO6' on gpiochip1 'pinctrl-bcm2711': there are 'ID_SDA', 'GPIO5', 'GPIO17'",
      answer("pinctrl-bcm2711", "GPIO6").c_str());
  STRCMP_CONTAINS("no line '' on gpiochip1", answer("pinctrl-bcm2711", "").c_str());
  add("gpiochip3", "silent", {"", ""});
  STRCMP_EQUAL("no line 'x' on gpiochip3 'silent': none of its lines has a name",
               answer("silent", "x").c_str());
}

TEST(GpioLine, IsRefusedWhenItsNameIsAmbiguous) {
  processor->lines[0].name = "GPIO5";
  STRCMP_EQUAL("more than one line 'GPIO5' on gpiochip1 'pinctrl-bcm2711': 0 and 2",
               answer("pinctrl-bcm2711", "GPIO5").c_str());
  add("gpiochip3", "pinctrl-bcm2711", {});
  STRCMP_CONTAINS("more than one chip with the label 'pinctrl-bcm2711'",
                  answer("pinctrl-bcm2711", "GPIO17").c_str());
}

TEST(GpioLine, IsFoundWhenAChipAlsoHasItsFormerNumber) {
  dev.link("gpiochip4", "gpiochip1");
  gpio_kernel().chips[dev / "gpiochip4"] = *processor;
  STRCMP_EQUAL("open", answer("pinctrl-bcm2711", "GPIO5").c_str());
}

TEST(GpioLine, NamesItsHolder) {
  processor->lines[2].consumer = "fan";
  STRCMP_EQUAL(
      "cannot take line 'GPIO5' of gpiochip1 'pinctrl-bcm2711', which 'fan' holds: "
      "Device or resource busy",
      answer("pinctrl-bcm2711", "GPIO5").c_str());
  gpio_kernel().fails_with = EPERM;
  STRCMP_EQUAL("cannot take line 'GPIO17' of gpiochip1 'pinctrl-bcm2711': Operation not permitted",
               answer("pinctrl-bcm2711", "GPIO17").c_str());
  // The process that holds the line may be gone when its name is read.
  gpio_kernel().fails_with = EBUSY;
  STRCMP_EQUAL("cannot take line 'GPIO17' of gpiochip1 'pinctrl-bcm2711': Device or resource busy",
               answer("pinctrl-bcm2711", "GPIO17").c_str());
}

TEST(GpioLine, IsReadWhileUndriven) {
  FakeLine& line = processor->lines[2];
  for (const Bias bias : {Bias::unknown, Bias::none, Bias::pull_up, Bias::pull_down}) {
    line.bias = bias;
    for (const int value : {1, 0}) {
      line.value = value;
      line.output = true;
      line.history.clear();
      const auto found = read_undriven({"pinctrl-bcm2711", "GPIO5"}, dev.path());
      CHECK(found->bias == bias);
      CHECK(found->level.high == (value == 1));
      const std::vector<std::string> expected = {"input", "release"};
      CHECK(line.history == expected);
    }
  }
  line.consumer = "fan";
  const auto held = read_undriven({"pinctrl-bcm2711", "GPIO5"}, dev.path());
  STRCMP_CONTAINS("which 'fan' holds", held.error().text().c_str());
}

TEST(GpioLine, DoesNotLeakMemoryForInspectedChips) {
  const auto look = [&] { STRCMP_CONTAINS("no chip", answer("pinctrl-rp1", "GPIO5").c_str()); };
  look();
  const auto before = ::mallinfo2().uordblks;
  for (int i = 0; i < 1000; ++i)
    look();
  CHECK(::mallinfo2().uordblks < before + 4096);
}
