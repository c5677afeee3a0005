// What is wrong with a configuration, so that its author can correct it.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace supercoil::config {

/// One mistake, with where it stands.
struct Problem {
  std::string file;
  int line = 0;     ///< 0: the file as a whole
  std::string key;  ///< the whole path, e.g. plant.moving_mass_kg; empty for the file as a whole
  std::string message;
  std::string value{};      ///< of the key, as it is written; "" where it has none
  bool of_default = false;  ///< the key is absent, and its default is wrong here

  /// "file:line: key = value: message"
  std::string text() const;
};

/// Collects every mistake of a file, so that they can be corrected at once.
class Diagnostics {
 public:
  explicit Diagnostics(std::string file) : file_(std::move(file)) {}

  void add(int line, std::string key, std::string message, std::string value = {},
           bool of_default = false) {
    problems_.push_back(
        {file_, line, std::move(key), std::move(message), std::move(value), of_default});
  }
  bool empty() const { return problems_.empty(); }
  const std::vector<Problem>& problems() const { return problems_; }
  const std::string& file() const { return file_; }

 private:
  std::string file_;
  std::vector<Problem> problems_;
};

/// Problems, a line each.
std::string to_text(const std::vector<Problem>& problems);

}  // namespace supercoil::config
