// What is wrong with a configuration, so that its author can correct it, and which keys it may
// have.
#pragma once

#include <string>
#include <utility>

#include "supercoil/hal/error.hpp"

#include "config/key_list.hpp"

namespace supercoil::config {

/// Collects every mistake of a file, so that they can be corrected at once.
class Diagnostics {
 public:
  /// keys: each key that is asked for is noted there; null: nobody wants to know.
  explicit Diagnostics(std::string file, KeyList* keys = nullptr)
      : file_(std::move(file)), keys_(keys) {}

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
  KeyList* keys() const { return keys_; }
  /// What is asked for from now on is no longer noted.
  void close_keys() { keys_ = nullptr; }

 private:
  std::string file_;
  KeyList* keys_;
  Errors problems_;
};

/// A line each.
std::string to_text(const Errors& problems);

}  // namespace supercoil::config
