// The reasons why a PWM output cannot be opened, in words; nothing may hang or end the program.
#include <cerrno>
#include <string>

#include <CppUTest/TestHarness.h>

#include "supercoil/hal_linux/sysfs_pwm.hpp"

#include "unit/hal_linux/support/pwm_kernel.hpp"
#include "unit/hal_linux/support/system_calls.hpp"

using namespace supercoil::hal_linux;
using namespace supercoil::test;

namespace {

constexpr const char* output = "class/pwm/pwmchip3/pwm5";

PwmLocation place(const PwmKernel& kernel) {
  return {"pca9685", 5, 1'000'000, 4000, kernel.root()};
}

std::string answer(const PwmLocation& where) {
  const auto pwm = SysfsPwm::open(where);
  return pwm ? "open" : pwm.error().text();
}

}  // namespace

TEST_GROUP(SysfsPwmProblems){};

TEST(SysfsPwmProblems, AreReportedForInvalidNumbers) {
  PwmKernel kernel;
  PwmLocation where = place(kernel);
  where.steps = 0;
  STRCMP_EQUAL("a PWM of 0 steps: must be 1 to 16777216", answer(where).c_str());
  where = place(kernel);
  where.period_ns = 3999;
  STRCMP_EQUAL("a PWM period of 3999 ns: must be 1 ns a step (4000) to 1 s", answer(where).c_str());
  for (const int number : {-1, 16, 100}) {
    where = place(kernel);
    where.number = number;
    STRCMP_CONTAINS(
        ("has 16 outputs, counted from 0; there is no " + std::to_string(number)).c_str(),
        answer(where).c_str());
  }
  LONGS_EQUAL(0, kernel.writes.size());
}

TEST(SysfsPwmProblems, ListTheAvailableChips) {
  PwmKernel kernel;
  PwmLocation where = place(kernel);
  where.device = "platform/soc/fe20c000.pwm";
  STRCMP_EQUAL(("no PWM chip whose path ends with 'platform/soc/fe20c000.pwm' in " + kernel.root() +
                ": there are pwmchip3 'pca9685' at " + kernel.tree / "devices/soc/i2c-1/1-0040")
                   .c_str(),
               answer(where).c_str());
  where.root = "/nowhere";
  STRCMP_EQUAL("cannot list /nowhere: No such file or directory", answer(where).c_str());
}

TEST(SysfsPwmProblems, NameAnOutputInUseByTheKernel) {
  PwmKernel kernel({}, false);
  fail_next(Call::pwrite, "/export", EBUSY);
  STRCMP_CONTAINS("is used by a kernel driver", answer(place(kernel)).c_str());
}

TEST(SysfsPwmProblems, AreAbsentWhenUdevGrantsTheFilesAMomentLater) {
  PwmKernel kernel({}, false);
  fail_next(Call::access, "/pwm5/period", EACCES, 3);
  next(Call::access, "/pwm5/period", [] { return 0; });
  fail_next(Call::access, "/pwm5/period", EACCES);  // not called once the file may be written
  STRCMP_EQUAL("open", answer(place(kernel)).c_str());
  LONGS_EQUAL(1, waiting());
  reset_calls();
}

TEST(SysfsPwmProblems, NameTheWriteThatFailed) {
  for (const char* attribute : {"duty_cycle", "period", "enable", "polarity"}) {
    for (const int error : {EIO, EINVAL, ENODEV, EBUSY, EAGAIN}) {
      PwmKernel kernel({2'000'000, 1'000'000, true, true});
      fail_next(Call::pwrite, std::string("/") + attribute, error);
      const auto pwm = SysfsPwm::open(place(kernel));
      CHECK_FALSE(pwm.has_value());
      LONGS_EQUAL(error, pwm.error().code);
      STRCMP_CONTAINS(attribute, pwm.error().text().c_str());
      LONGS_EQUAL(0, waiting());
    }
  }
}

TEST(SysfsPwmProblems, StopFurtherWrites) {
  PwmKernel kernel({2'000'000, 1'000'000, true, false});
  fail_next(Call::pwrite, "/duty_cycle", EIO);
  static_cast<void>(answer(place(kernel)));
  LONGS_EQUAL(0, kernel.writes.size());
}

TEST(SysfsPwmProblems, AreDetectedWhenADriverAcceptsWritesAndIgnoresThem) {
  PwmKernel kernel({2'000'000, 0, true, false});
  next(Call::pwrite, "/period", [] { return 7; });
  STRCMP_CONTAINS("took every write and now shows period 2000000 ns",
                  answer(place(kernel)).c_str());
}

TEST(SysfsPwmProblems, AreDetectedWhenADriverKeepsDutyOrPolarityOrStaysDisabled) {
  const auto answer_of = [](const PwmState& left, const char* attribute, long taken) {
    PwmKernel kernel(left);
    next(Call::pwrite, attribute, [taken] { return taken; });
    return answer(place(kernel));
  };
  STRCMP_CONTAINS("duty 500000 ns",
                  answer_of({1'000'000, 500'000, true, false}, "/duty_cycle", 1).c_str());
  STRCMP_CONTAINS("enable 0", answer_of({1'000'000, 0, false, false}, "/enable", 1).c_str());
  STRCMP_CONTAINS(", inversed", answer_of({1'000'000, 0, false, true}, "/polarity", 6).c_str());
}

TEST(SysfsPwmProblems, IncludeWrongContent) {
  for (const char* attribute : {"period", "duty_cycle", "enable", "polarity"}) {
    for (const std::string& content :
         {std::string(), std::string("\x7f\0", 2), std::string(5000, '1')}) {
      PwmKernel kernel;
      kernel.tree.write(std::string(output) + "/" + attribute, content);
      STRCMP_CONTAINS(attribute, answer(place(kernel)).c_str());
    }
  }
  for (const char* attribute : {"period", "duty_cycle"}) {
    for (const char* content : {"abc\n", "-5\n", "1e3\n", "99999999999999999999\n"}) {
      PwmKernel kernel;
      kernel.tree.write(std::string(output) + "/" + attribute, content);
      CHECK(answer(place(kernel)) != "open");
    }
  }
}

TEST(SysfsPwmProblems, IncludeFoldersAndPipesInTheAttributesPlace) {
  for (const char* attribute : {"period", "duty_cycle", "enable", "polarity"}) {
    const std::string path = std::string(output) + "/" + attribute;
    PwmKernel kernel;
    kernel.tree.remove(path);
    STRCMP_CONTAINS("No such file or directory", answer(place(kernel)).c_str());
    kernel.tree.make_pipe(path);
    STRCMP_CONTAINS("is not a file", answer(place(kernel)).c_str());
    kernel.tree.remove(path);
    kernel.tree.make_folder(path);
    STRCMP_CONTAINS("Is a directory", answer(place(kernel)).c_str());
  }
}

TEST(SysfsPwmProblems, IncludeAChipWithoutItsFiles) {
  PwmKernel kernel({}, false);
  kernel.tree.remove("class/pwm/pwmchip3/npwm");
  STRCMP_CONTAINS("npwm: No such file or directory", answer(place(kernel)).c_str());
  kernel.tree.write("class/pwm/pwmchip3/npwm", "many\n");
  STRCMP_CONTAINS("holds 'many', which is not a whole number", answer(place(kernel)).c_str());
  kernel.tree.remove("class/pwm/pwmchip3/device");
  STRCMP_CONTAINS("pwmchip3 without a name", answer(place(kernel)).c_str());
}
