// Files of the operating system during one of whose calls the process dies.
#pragma once

#include <csignal>
#include <string>

#include <unistd.h>

#include "storage/posix_files.hpp"

namespace supercoil::test {

using storage::NewFile;

/// Real files whose process dies at one call: before it (even numbers) or after it (odd).
class DeadlyFiles final : public storage::Files {
 private:
  template <class Call>
  auto around(Call call) {
    die_in_time();
    auto result = call();
    die_in_time();
    return result;
  }
  void die_in_time() {
    if (step_-- == 0) kill(getpid(), SIGKILL);
  }

 public:
  explicit DeadlyFiles(int step) : step_(step) {}

  Result<std::string> read(const std::string& path, std::size_t limit_bytes) override {
    return files_.read(path, limit_bytes);
  }
  Result<NewFile> create(const std::string& path) override {
    return around([&] { return files_.create(path); });
  }
  Result<void> write(const NewFile& file, std::string_view content) override {
    // In two parts, so that the process can also die between them.
    const auto half = around([&] { return files_.write(file, content.substr(0, 100)); });
    return half ? around([&] { return files_.write(file, content.substr(100)); }) : half;
  }
  Result<void> sync(const NewFile& file) override {
    return around([&] { return files_.sync(file); });
  }
  Result<void> close(const NewFile& file) override {
    return around([&] { return files_.close(file); });
  }
  Result<void> rename(const std::string& from, const std::string& to) override {
    return around([&] { return files_.rename(from, to); });
  }
  Result<void> link(const std::string& from, const std::string& to) override {
    return around([&] { return files_.link(from, to); });
  }
  Result<void> unlink(const std::string& path) override {
    return around([&] { return files_.unlink(path); });
  }
  Result<void> sync_folder(const std::string& path) override {
    return around([&] { return files_.sync_folder(path); });
  }
  Result<void> check_folder(const std::string& path) override { return files_.check_folder(path); }

 private:
  int step_;
  storage::PosixFiles files_;
};

}  // namespace supercoil::test
