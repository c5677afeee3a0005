#include "unit/hal_linux/support/temporary_folder.hpp"

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <sys/stat.h>
#include <unistd.h>

namespace supercoil::test {

namespace {

void make_parents(const std::string& path) {
  std::filesystem::create_directories(std::filesystem::path(path).parent_path());
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  // In memory, like sysfs; on a disk the property tests take a minute.
  const bool memory = ::access("/dev/shm", W_OK) == 0;
  std::string name =
      (memory ? "/dev/shm" : std::filesystem::temp_directory_path().string()) + "/supercoil-XXXXXX";
  path_ = std::filesystem::canonical(::mkdtemp(name.data())).string();
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

void TemporaryFolder::write(std::string_view name, std::string_view content) const {
  make_parents(*this / name);
  const std::string path = *this / name;
  // Not truncated first, because ext4 would then write the file to the disk when it is closed.
  std::ofstream(path, std::ios::binary | std::ios::app).close();
  std::fstream(path, std::ios::binary | std::ios::in | std::ios::out) << content;
  std::filesystem::resize_file(path, content.size());
}

std::string TemporaryFolder::read(std::string_view name) const {
  std::ifstream file(*this / name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void TemporaryFolder::make_folder(std::string_view name) const {
  std::filesystem::create_directories(*this / name);
}

void TemporaryFolder::make_pipe(std::string_view name) const {
  make_parents(*this / name);
  static_cast<void>(::mkfifo((*this / name).c_str(), S_IRUSR | S_IWUSR));
}

void TemporaryFolder::link(std::string_view name, std::string_view target) const {
  make_parents(*this / name);
  std::filesystem::create_symlink(*this / target, *this / name);
}

void TemporaryFolder::remove(std::string_view name) const {
  std::filesystem::remove_all(*this / name);
}

}  // namespace supercoil::test
