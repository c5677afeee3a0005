// A table of a TOML file. Every key is checked as it is read.
#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>

#include "supercoil/control/scalar/arithmetic.hpp"

#include "config/diagnostics.hpp"

namespace supercoil::config {

/// Reads keys by name. A key that is absent gives its default. A wrong type, a value out of range
/// or a NaN is noted in the diagnostics, and the default is returned so that reading can go on.
/// What each key may be is noted there too, so that the program can list all keys.
/// When all keys have been asked for, finish() notes each key that was not read, and each
/// required one that is absent.
class Section {
 public:
  /// table may be null: every key is then absent. path: the table's name in messages. line: where a
  /// null table would stand, for messages.
  Section(const toml::table* table, std::string path, Diagnostics& diagnostics, int line = 0)
      : table_(table), path_(std::move(path)), line_(line), diagnostics_(&diagnostics) {}

  /// The same with another table laid under this one: a key that this one lacks is looked up there,
  /// table by table. Lists are not merged.
  Section over(const toml::table* under, std::string under_path) const;

  /// A float or an integer. A default that is not finite is none.
  double number(std::string_view key, double fallback, Range range);
  /// min and max: inclusive.
  std::int64_t integer(std::string_view key, std::int64_t fallback, std::int64_t min,
                       std::int64_t max);
  /// true or false; a number is refused.
  bool flag(std::string_view key, bool fallback);
  /// Any string, also an empty one. An empty default is none.
  std::string text(std::string_view key, std::string_view fallback);
  /// One of the names, or the default.
  std::string one_of(std::string_view key, std::string_view fallback,
                     std::vector<std::string> names);
  /// Between min_count and max_count numbers, each in range. An empty default is none.
  std::vector<double> numbers(std::string_view key, std::vector<double> fallback, Range range,
                              std::size_t min_count, std::size_t max_count);
  /// One text that is not empty, or a list of them. Empty if the key is absent; of a wrong list,
  /// the texts before the mistake.
  std::vector<std::string> texts(std::string_view key);
  /// One of a set of names.
  template <class Value, std::size_t N>
  Value choice(std::string_view key, Value fallback, const control::Names<Value, N>& names) {
    std::vector<std::string> allowed;
    for (const auto& [name, value] : names)
      allowed.emplace_back(name);
    const std::string given = one_of(key, control::name_of(names, fallback), std::move(allowed));
    return control::find_named(names, given).value_or(fallback);
  }
  /// A table inside this one; absent is an empty one.
  Section section(std::string_view key);
  /// Each of [[key]], named key[1], key[2], …; a single table counts as one. Empty when absent.
  std::vector<Section> sections(std::string_view key);

  /// For keys that may be absent and have no default. Empty if the key is absent or wrong.
  std::optional<double> optional_number(std::string_view key, Range range);
  /// As optional_number(). min and max: inclusive.
  std::optional<std::int64_t> optional_integer(std::string_view key, std::int64_t min,
                                               std::int64_t max);

  /// Like those above, for keys that must be there. NaN, min or empty if the key is absent or
  /// wrong.
  double required_number(std::string_view key, Range range);
  /// As numbers().
  std::vector<double> required_numbers(std::string_view key, Range range, std::size_t min_count,
                                       std::size_t max_count);
  /// As integer().
  std::int64_t required_integer(std::string_view key, std::int64_t min, std::int64_t max);
  /// As text(), but an empty string is a mistake.
  std::string required_text(std::string_view key);
  /// A list of numbers, texts, true and false. Empty if the key is absent or wrong.
  toml::array required_values(std::string_view key);

  /// Keys that are read elsewhere.
  void allow(std::initializer_list<std::string_view> keys) {
    for (const std::string_view key : keys)
      add_known(key);
  }

  /// In this table or in the one laid under it. Does not count as reading the key.
  bool has(std::string_view key) const { return lookup(key).node != nullptr; }
  /// Whether the table exists, or one is laid under it.
  bool given() const { return table_ != nullptr || under_ != nullptr; }
  /// Without the table laid under it.
  bool has_own(std::string_view key) const { return table_ != nullptr && table_->contains(key); }
  const toml::table* table() const { return table_; }
  /// The table's line; that of the table around it when it is absent; 0 at the top.
  int line() const;
  /// Notes a mistake at the key: "path.key = value: message". If the key is absent and its default
  /// does not fit, notes it at the table.
  void wrong(std::string_view key, const std::string& message);
  /// Notes each unknown key, with the known one that was probably meant.
  void finish();

 private:
  struct Found {
    const toml::node* node;
    bool under;
  };
  struct Missing {
    std::string key;
    std::string rule;
  };
  /// Remembers a key, a repeated one only once.
  void add_known(std::string_view key) {
    if (std::ranges::find(known_, key) == known_.end()) known_.emplace_back(key);
  }
  Found lookup(std::string_view key) const;
  /// For the list of keys: adds the table, the value and the line to what is known of the key.
  void note(std::string_view key, Key known) const;
  /// For the key that was read last: without a default. rule: what it must be.
  void require(std::string_view key, std::string rule);
  const toml::node* find(std::string_view key);
  std::string full_key(std::string_view key) const;
  /// Notes unknown keys; returns the names that were probably meant.
  std::vector<std::string> refuse_unknown(const toml::table* table, const std::string& path);
  void refuse_missing(const std::vector<std::string>& intended);

  const toml::table* table_;
  std::string path_;
  int line_;
  const toml::table* under_ = nullptr;
  std::string under_path_;
  Diagnostics* diagnostics_;
  std::vector<std::string> known_;
  std::string default_kind_;  ///< which keys there are depends on it; empty: kind is given
  std::vector<Missing> missing_;
};

}  // namespace supercoil::config
