// A table of a TOML file of which every key is checked as it is read.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>

#include "supercoil/control/scalar/arithmetic.hpp"

#include "config/diagnostics.hpp"

namespace supercoil::config {

/// Lowest and highest allowed value, ends included.
struct Range {
  double lowest;
  double highest;
};

/// Reads keys by name. A key that is absent gives its default. A wrong type, a value out of range
/// or a NaN is noted in the diagnostics, and the default is returned so that reading can go on.
/// When all keys have been asked for, finish() notes each key that nobody asked for.
class Section {
 public:
  /// table may be null: every key is then absent. path: how the table is called in messages.
  Section(const toml::table* table, std::string path, Diagnostics& diagnostics)
      : table_(table), path_(std::move(path)), diagnostics_(&diagnostics) {}

  double number(std::string_view key, double fallback, Range range);
  long integer(std::string_view key, long fallback, long lowest, long highest);
  bool flag(std::string_view key, bool fallback);
  std::string text(std::string_view key, std::string_view fallback);
  /// Between least and most numbers, each in range.
  std::vector<double> numbers(std::string_view key, std::vector<double> fallback, Range range,
                              std::size_t least, std::size_t most);
  /// One of a set of names.
  template <class Value, std::size_t N>
  Value choice(std::string_view key, Value fallback, const control::Names<Value, N>& names) {
    const std::string given = text(key, control::name_of(names, fallback));
    if (const auto value = control::find_named(names, given)) return *value;
    std::string allowed;
    for (const auto& [name, value] : names) {
      allowed += (allowed.empty() ? "" : ", ") + std::string(name);
    }
    wrong(key, "must be one of: " + allowed);
    return fallback;
  }
  /// A table inside this one; absent is an empty one.
  Section section(std::string_view key);

  /// Keys that somebody else reads.
  void allow(std::initializer_list<std::string_view> keys) {
    known_.insert(known_.end(), keys.begin(), keys.end());
  }

  bool has(std::string_view key) const { return table_ != nullptr && table_->contains(key); }
  /// Notes a mistake at the key: "path.key = value: message". Where the key is absent, and its
  /// default is what does not fit, at the table.
  void wrong(std::string_view key, const std::string& message);
  /// Notes each unknown key, with the known one that was probably meant.
  void finish();

 private:
  const toml::node* find(std::string_view key);
  std::string full(std::string_view key) const;

  const toml::table* table_;
  std::string path_;
  Diagnostics* diagnostics_;
  std::vector<std::string> known_;
};

}  // namespace supercoil::config
