// The levels of the board's lines, from gpio-sim's side: the level that the firmware drives, or the
// line's pull when nobody drives it.
#pragma once

#include <string>

namespace supercoil::rig {

class LineLevel {
 public:
  /// `folder` is the line's own below /sys. Throws std::system_error.
  explicit LineLevel(const std::string& folder);
  ~LineLevel();
  LineLevel(LineLevel&& other) noexcept : file_(other.file_) { other.file_ = -1; }
  LineLevel(const LineLevel&) = delete;
  LineLevel& operator=(const LineLevel&) = delete;
  LineLevel& operator=(LineLevel&&) = delete;

  bool high() const;

 private:
  int file_;
};

}  // namespace supercoil::rig
