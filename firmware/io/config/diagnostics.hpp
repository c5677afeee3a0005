// What is wrong with a configuration, so that its author can correct it.
#pragma once

#include <string>
#include <utility>

#include "supercoil/hal/error.hpp"

namespace supercoil::config {

/// Collects every mistake of a file, so that they can be corrected at once.
class Diagnostics {
 public:
  explicit Diagnostics(std::string file) : file_(std::move(file)) {}

  /// line: 0 when the mistake has none. key: with its table. value: as written. of_default: the key
  /// is absent, and its default does not fit.
  void add(int line, std::string key, std::string message, std::string value = {},
           bool of_default = false) {
    problems_.push_back(
        {file_, line, std::move(key), std::move(message), std::move(value), of_default});
  }
  bool empty() const { return problems_.empty(); }
  const Errors& problems() const { return problems_; }
  const std::string& file() const { return file_; }

 private:
  std::string file_;
  Errors problems_;
};

/// A line each.
std::string to_text(const Errors& problems);

}  // namespace supercoil::config
