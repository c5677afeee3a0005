#include "apps/supercoil/answer_lines.hpp"

#include <array>
#include <thread>

#include <poll.h>
#include <unistd.h>

namespace supercoil::operating {

std::optional<std::string> AnswerLines::wait(std::chrono::milliseconds timeout) {
  if (auto line = take_line()) return line;
  if (ended_) {
    std::this_thread::sleep_for(timeout);
    return std::nullopt;
  }
  pollfd watched{file_, POLLIN, 0};
  if (::poll(&watched, 1, static_cast<int>(timeout.count())) <= 0) return std::nullopt;
  std::array<char, 256> bytes{};
  const ssize_t count = ::read(file_, bytes.data(), bytes.size());
  ended_ = count == 0;
  if (count > 0) read_.append(bytes.data(), static_cast<std::size_t>(count));
  return take_line();
}

std::optional<std::string> AnswerLines::take_line() {
  const std::size_t end = read_.find('\n');
  if (end == std::string::npos && !(ended_ && !read_.empty())) return std::nullopt;
  std::string line = read_.substr(0, end);
  read_.erase(0, end == std::string::npos ? end : end + 1);
  return line;
}

}  // namespace supercoil::operating
