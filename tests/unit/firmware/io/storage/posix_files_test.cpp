#include "storage/posix_files.hpp"

#include <cerrno>
#include <csignal>
#include <string>
#include <thread>

#include <fcntl.h>
#include <pthread.h>
#include <sys/stat.h>
#include <unistd.h>

#include <CppUTest/TestHarness.h>

#include "unit/firmware/io/storage/support/temporary_folder.hpp"

using namespace supercoil::storage;
using supercoil::test::TemporaryFolder;

TEST_GROUP(PosixFiles) {
  TemporaryFolder folder;
  PosixFiles files;
  std::string path(const std::string& name) const {
    return folder.path() + "/" + name;
  }
  void put(const std::string& name, const std::string& content) {
    const auto file = files.create(path(name));
    CHECK(file.has_value());
    CHECK(files.write(*file, content).has_value());
    CHECK(files.sync(*file).has_value());
    CHECK(files.close(*file).has_value());
  }
};

TEST(PosixFiles, ReadBackWhatTheyWrote) {
  const std::string content("a\0b\n", 4);
  put("x", content);
  CHECK(*files.read(path("x"), 100) == content);
  CHECK(*files.read(path("x"), 2) == content.substr(0, 2));
}

// errno keeps the value that an earlier call left.
TEST(PosixFiles, IgnoreAStaleErrno) {
  errno = EINTR;
  put("x", "1");
  errno = EINTR;
  CHECK(*files.read(path("x"), 100) == "1");
}

TEST(PosixFiles, NeverOverwriteAFile) {
  put("x", "1");
  const auto again = files.create(path("x"));
  CHECK_FALSE(again.has_value());
  LONGS_EQUAL(EEXIST, again.error().code);
  STRCMP_EQUAL((path("x") + ": cannot be created: File exists").c_str(),
               again.error().text().c_str());
}

TEST(PosixFiles, LinkRenameAndUnlinkFollowTheContract) {
  put("x", "1");
  CHECK(files.link(path("x"), path("y")).has_value());
  LONGS_EQUAL(EEXIST, files.link(path("x"), path("y")).error().code);
  CHECK(files.rename(path("x"), path("y")).has_value());
  CHECK(files.read(path("x"), 9).has_value());  // two names for one file: nothing happened
  CHECK(files.unlink(path("x")).has_value());
  LONGS_EQUAL(ENOENT, files.unlink(path("x")).error().code);
  CHECK(files.sync_folder(folder.path()).has_value());
  STRCMP_EQUAL("1", files.read(path("y"), 9)->c_str());
}

TEST(PosixFiles, NameTheMissingPath) {
  const std::string gone = path("gone/x");
  const auto read = files.read(gone, 9);
  LONGS_EQUAL(ENOENT, read.error().code);
  STRCMP_EQUAL((gone + ": cannot be opened: No such file or directory").c_str(),
               read.error().text().c_str());
  LONGS_EQUAL(ENOENT, files.create(gone).error().code);
  LONGS_EQUAL(ENOENT, files.sync_folder(path("gone")).error().code);
  LONGS_EQUAL(ENOENT, files.check_folder(path("gone")).error().code);
  LONGS_EQUAL(ENOENT, files.rename(gone, path("y")).error().code);
}

TEST(PosixFiles, DistinguishFilesAndFolders) {
  put("x", "1");
  LONGS_EQUAL(ENOTDIR, files.check_folder(path("x")).error().code);
  LONGS_EQUAL(EISDIR, files.read(folder.path(), 9).error().code);
}

TEST(PosixFiles, DoNotBlockOnAPipeInAFilesPlace) {
  LONGS_EQUAL(0, mkfifo(path("pipe").c_str(), 0600));
  STRCMP_EQUAL("", files.read(path("pipe"), 9)->c_str());
}

TEST(PosixFiles, ReportAFullDisk) {
  const NewFile full{open("/dev/full", O_WRONLY | O_CLOEXEC), "/dev/full"};
  const auto written = files.write(full, "x");
  LONGS_EQUAL(ENOSPC, written.error().code);
  STRCMP_EQUAL("/dev/full: cannot be written: No space left on device",
               written.error().text().c_str());
  CHECK(files.close(full).has_value());
  LONGS_EQUAL(EBADF, files.close(full).error().code);
}

TEST(PosixFiles, WorkWithDescriptorZero) {
  put("x", "content");
  // A service may be started without standard input; the first file that it opens is then number 0.
  const int input = ::dup(0);
  ::close(0);
  const auto content = files.read(path("x"), 100);
  const bool left_open = ::fcntl(0, F_GETFD) >= 0;
  if (input >= 0) {
    ::dup2(input, 0);
    ::close(input);
  }
  CHECK(content.has_value());
  STRCMP_EQUAL("content", content->c_str());
  CHECK_FALSE(left_open);
}

TEST(PosixFiles, ResumeAfterASignal) {
  // A full pipe makes a write wait, as a slow disk does.
  int ends[2] = {};
  LONGS_EQUAL(0, ::pipe2(ends, O_CLOEXEC));
  ::fcntl(ends[1], F_SETPIPE_SZ, 4096);
  struct sigaction seen {};
  struct sigaction before {};
  seen.sa_handler = [](int) {};  // without SA_RESTART: the call is interrupted
  ::sigaction(SIGUSR1, &seen, &before);
  const std::string content(12'288, 'x');
  std::string read;
  std::thread reader([&, writer = ::pthread_self()] {
    for (int i = 0; i < 5; ++i) {
      ::usleep(5000);
      ::pthread_kill(writer, SIGUSR1);
    }
    char bytes[4096];
    for (ssize_t count = 1; count > 0 && read.size() < content.size();) {
      count = ::read(ends[0], bytes, sizeof bytes);
      if (count > 0) read.append(bytes, static_cast<std::size_t>(count));
    }
  });
  const NewFile pipe{ends[1], "pipe"};
  const auto written = files.write(pipe, content);
  CHECK(files.close(pipe).has_value());
  reader.join();
  ::close(ends[0]);
  ::sigaction(SIGUSR1, &before, nullptr);
  CHECK_TEXT(written.has_value(), written ? "" : written.error().text().c_str());
  CHECK(read == content);
}
