#include "supercoil/hal_linux/device_folder.hpp"

#include <cerrno>
#include <string>
#include <vector>

#include <CppUTest/TestHarness.h>

#include "unit/hal_linux/support/temporary_folder.hpp"

using namespace supercoil::hal_linux;
using supercoil::test::TemporaryFolder;

namespace {

const std::vector<DeviceFolder> three = {
    {"/r/pwmchip0", {"pca9685", "1-0040"}, "/sys/devices/i2c-1/1-0040"},
    {"/r/pwmchip2", {"pca9685", "11-0040"}, "/sys/devices/i2c-11/11-0040"},
    {"/r/pwmchip7", {"fe20c000.pwm"}, "/sys/devices/platform/soc/fe20c000.pwm"},
};

std::string chosen(const std::string& wanted, const std::vector<DeviceFolder>& all = three) {
  const auto device = choose(all, wanted, "PWM chip", "/r");
  return device ? device->folder : device.error().text();
}

}  // namespace

TEST_GROUP(DeviceFolders){};

TEST(DeviceFolders, AreChosenByName) {
  STRCMP_EQUAL("/r/pwmchip7", chosen("fe20c000.pwm").c_str());
  STRCMP_EQUAL("/r/pwmchip2", chosen("11-0040").c_str());
}

TEST(DeviceFolders, AreChosenByPathSuffixWhenItHasASlash) {
  STRCMP_EQUAL("/r/pwmchip0", chosen("i2c-1/1-0040").c_str());
  STRCMP_EQUAL("/r/pwmchip0", chosen("/1-0040").c_str());
  STRCMP_EQUAL("/r/pwmchip7", chosen("platform/soc/fe20c000.pwm").c_str());
  STRCMP_EQUAL("/r/pwmchip7", chosen("/sys/devices/platform/soc/fe20c000.pwm").c_str());
}

TEST(DeviceFolders, MatchOnlyWholePathComponents) {
  STRCMP_CONTAINS("no PWM chip whose path ends with '2c-1/1-0040' in /r: there are pwmchip0",
                  chosen("2c-1/1-0040").c_str());
  STRCMP_CONTAINS("no PWM chip", chosen("oc/fe20c000.pwm").c_str());
}

TEST(DeviceFolders, WithTheSameNameAreListed) {
  STRCMP_EQUAL(
      "more than one PWM chip with the name 'pca9685' in /r: "
      "pwmchip0 'pca9685' at /sys/devices/i2c-1/1-0040, "
      "pwmchip2 'pca9685' at /sys/devices/i2c-11/11-0040; say which by the end of its path",
      chosen("pca9685").c_str());
}

TEST(DeviceFolders, NeverMatchByNumberOrAnEmptyName) {
  STRCMP_CONTAINS("no PWM chip with the name 'pwmchip0' in /r", chosen("pwmchip0").c_str());
  STRCMP_CONTAINS("no PWM chip with the name '' in /r", chosen("").c_str());
  STRCMP_EQUAL("no PWM chip with the name 'x' in /r: there is none", chosen("x", {}).c_str());
}

TEST(DeviceFolders, AreListedInTheOrderOfTheirNumbers) {
  const TemporaryFolder root;
  for (const char* name : {"pwmchip10", "pwmchip9", "pwmchip", "pwmchip-1", "pwmchip1x", "other0",
                           "pwmchip99999999999999999999"}) {
    root.make_folder(name);
  }
  const auto folders = numbered_folders(root.path(), "pwmchip");
  CHECK(folders.has_value());
  LONGS_EQUAL(2, folders->size());
  STRCMP_EQUAL((root / "pwmchip9").c_str(), folders->at(0).folder.c_str());
  STRCMP_EQUAL((root / "pwmchip10").c_str(), folders->at(1).folder.c_str());
}

TEST(DeviceFolders, OfAMissingRootAreAnError) {
  const TemporaryFolder root;
  const auto folders = numbered_folders(root / "class/pwm", "pwmchip");
  LONGS_EQUAL(ENOENT, folders.error().code);
  STRCMP_EQUAL(("cannot list " + root / "class/pwm" + ": No such file or directory").c_str(),
               folders.error().text().c_str());
}

TEST(DeviceFolders, ListAtMostTwelve) {
  STRCMP_EQUAL("a, b", listed({"a", "b"}).c_str());
  STRCMP_EQUAL("x, x, x, x, x, x, x, x, x, x, x, x and 18 more",
               listed(std::vector<std::string>(30, "x")).c_str());
}
