#include "lines.hpp"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace supercoil::rig {

LineLevel::LineLevel(const std::string& folder)
    : file_(open((folder + "/value").c_str(), O_RDONLY | O_CLOEXEC)) {
  if (file_ < 0) throw std::system_error(errno, std::generic_category(), folder);
}

LineLevel::~LineLevel() {
  if (file_ >= 0) close(file_);
}

bool LineLevel::high() const {
  char level = 0;
  if (pread(file_, &level, 1, 0) != 1)
    throw std::system_error(errno, std::generic_category(), "a line's level");
  return level == '1';
}

}  // namespace supercoil::rig
