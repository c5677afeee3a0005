#include "supercoil/hal_linux/descriptor.hpp"

#include <array>
#include <cerrno>
#include <string>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include <CppUTest/TestHarness.h>

#include "supercoil/hal_linux/status_of.hpp"

#include "unit/hal_linux/support/check_status.hpp"
#include "unit/hal_linux/support/system_calls.hpp"
#include "unit/hal_linux/support/temporary_folder.hpp"

using namespace supercoil;
using namespace supercoil::hal_linux;
using namespace supercoil::test;

namespace {

bool is_open(int number) {
  return ::fcntl(number, F_GETFD) >= 0;
}

}  // namespace

TEST_GROUP(Descriptor) {
  TemporaryFolder folder;
  void setup() override {
    folder.write("file", "content");
  }
  void teardown() override {
    reset_calls();
  }
  hal_linux::Descriptor opened(int flags = O_RDWR) const {
    auto file = open_file(folder / "file", flags);
    CHECK(file.has_value());
    return std::move(*file);
  }
};

TEST(Descriptor, ClosesItsFileOnce) {
  auto first = opened();
  const int number = first.number();
  {
    const hal_linux::Descriptor second = std::move(first);
    CHECK(is_open(number));
    // NOLINTNEXTLINE(bugprone-use-after-move,clang-analyzer-cplusplus.Move): what it leaves behind
    CHECK_FALSE(first.is_open());
  }
  CHECK_FALSE(is_open(number));
}

TEST(Descriptor, ClosesItsFileWhenGivenAnother) {
  auto first = opened();
  auto second = opened();
  const int lost = first.number();
  const int kept = second.number();
  first = std::move(second);
  CHECK_FALSE(is_open(lost));
  CHECK(is_open(kept));
  LONGS_EQUAL(kept, first.number());
}

TEST(Descriptor, IsNotInheritedByChildPrograms) {
  CHECK((::fcntl(opened().number(), F_GETFD) & FD_CLOEXEC) != 0);
}

TEST(Descriptor, NamesTheFileThatCannotBeOpened) {
  const auto file = open_file(folder / "no", O_RDONLY);
  LONGS_EQUAL(ENOENT, file.error().code);
  STRCMP_EQUAL(("cannot open " + folder / "no" + ": No such file or directory").c_str(),
               file.error().text().c_str());
}

TEST(Descriptor, MapsErrnosToStatuses) {
  check_status(hal::Status::ok, status_of(0));
  for (const int error : {EBUSY, ENOBUFS})
    check_status(hal::Status::busy, status_of(error));
  for (const int error : {ENODEV, ENXIO, ESHUTDOWN, ENETDOWN})
    check_status(hal::Status::gone, status_of(error));
  check_status(hal::Status::not_ready, status_of(EAGAIN));
  for (const int error : {EIO, EINVAL, EPERM, EBADF, ETIMEDOUT, EREMOTEIO, 12345}) {
    check_status(hal::Status::io_error, status_of(error));
  }
}

TEST(Descriptor, RetriesAfterASignal) {
  fail_next(Call::open, "/file", EINTR, 3);
  const auto file = opened();
  fail_next(Call::pread, "/file", EINTR, 3);
  std::array<char, 16> buffer{};
  LONGS_EQUAL(7, read_start(file, buffer.data(), buffer.size()).bytes);
  fail_next(Call::pwrite, "/file", EINTR, 3);
  check_status(hal::Status::ok, write_start(file, "CON", 3));
  STRCMP_EQUAL("CONtent", folder.read("file").c_str());
  LONGS_EQUAL(0, waiting());
}

TEST(Descriptor, DoesNotRetryForever) {
  const auto file = opened();
  fail_next(Call::pwrite, "/file", EINTR, 1000);
  check_status(hal::Status::io_error, write_start(file, "CON", 3));
  CHECK(waiting() > 900);
}

TEST(Descriptor, TreatsAShortWriteAsAnError) {
  const auto file = opened();
  for (const long written : {0, 1, 2}) {
    next(Call::pwrite, "/file", [written] { return written; });
    check_status(hal::Status::io_error, write_start(file, "100", 3));
    next(Call::write, "/file", [written] { return written; });
    check_status(hal::Status::io_error, write_next(file, "100", 3));
  }
}

TEST(Descriptor, PassesOnWhyACallFailed) {
  const auto file = opened();
  std::array<char, 16> buffer{};
  for (const int error : {EAGAIN, EBUSY, EIO, ENODEV, EINVAL}) {
    fail_next(Call::pread, "/file", error);
    check_status(status_of(error), read_start(file, buffer.data(), buffer.size()).status);
    fail_next(Call::read, "/file", error);
    check_status(status_of(error), read_next(file, buffer.data(), buffer.size()).status);
    fail_next(Call::pwrite, "/file", error);
    check_status(status_of(error), write_start(file, "1", 1));
    fail_next(Call::write, "/file", error);
    check_status(status_of(error), write_next(file, "1", 1));
  }
}

TEST(Descriptor, WorksWithDescriptorZero) {
  // A service may be started without standard input; the first file that it opens is then number 0.
  const int input = ::dup(0);
  next(Call::open, "/file", [] { return 0; });
  {
    const auto file = open_file(folder / "file", O_RDONLY);
    CHECK(file.has_value());
    CHECK(file->is_open());
    LONGS_EQUAL(0, file->number());
  }
  if (input >= 0) {
    ::dup2(input, 0);
    ::close(input);
  }
}
