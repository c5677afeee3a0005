#include "storage/tuning_tables.hpp"

#include <array>
#include <utility>

#include "storage/number.hpp"

namespace supercoil::storage {

namespace {

constexpr std::string_view chosen = "chosen";

std::string table_of(std::string_view of, std::size_t place) {
  return std::string(of) + "_" + std::to_string(place);
}

std::string line(std::string_view key, double value) {
  return std::string(key) + " = " + toml_number(value) + "\n";
}

/// By reference, for writing and reading alike, so that the two agree.
template <class Tuning>
auto places(Tuning& tuning) {
  return std::array{std::pair{std::string_view("controller"), &tuning.controller},
                    std::pair{std::string_view("estimator"), &tuning.estimator}};
}

template <class Tuning>
auto tables(Tuning& tuning) {
  return std::array{std::pair{std::string_view("controller"), &tuning.controllers},
                    std::pair{std::string_view("estimator"), &tuning.estimators}};
}

template <class Optional>
std::optional<std::string> read_value(const toml::table& table, std::string_view name,
                                      std::string_view key, Optional& value) {
  const toml::node* node = table.get(key);
  if (node == nullptr) return std::nullopt;
  double number = 0.0;
  if (const auto wrong = read_number(node, number))
    return std::string(name) + "." + std::string(key) + " " + *wrong;
  value = number;
  return std::nullopt;
}

}  // namespace

std::string encode_tuning(const board::StoredTuning& tuning) {
  std::string text;
  for (const auto& [of, all] : tables(tuning)) {
    for (std::size_t place = 0; place < all->size(); ++place) {
      std::string lines;
      const auto& values = (*all)[place].values;
      for (std::size_t i = 0; i < values.size(); ++i) {
        if (values[i]) lines += line(control::tunables()[i].name, *values[i]);
      }
      if (!lines.empty()) text += "\n[" + table_of(of, place) + "]\n" + lines;
    }
  }
  std::string lines;
  for (const auto& [key, place] : places(tuning)) {
    if (*place) lines += line(key, **place);
  }
  return lines.empty() ? text : text + "\n[" + std::string(chosen) + "]\n" + lines;
}

bool is_tuning_table(std::string_view table) {
  bool found = table == chosen;
  const board::StoredTuning none;
  for (const auto& [of, all] : tables(none)) {
    for (std::size_t place = 0; place < all->size(); ++place)
      found = found || table == table_of(of, place);
  }
  return found;
}

bool is_tuning_key(std::string_view table, std::string_view key) {
  if (table == chosen) return key == "controller" || key == "estimator";
  const std::size_t tunable = control::tunable_named(key);
  if (!is_tuning_table(table) || tunable == control::tunable_count) return false;
  return table.starts_with("controller") ? control::tunables()[tunable].controllers_have()
                                         : control::tunables()[tunable].estimators_have();
}

std::optional<std::string> read_tuning(const toml::table& file, board::StoredTuning& tuning) {
  for (const auto& [of, all] : tables(tuning)) {
    for (std::size_t place = 0; place < all->size(); ++place) {
      const std::string name = table_of(of, place);
      const toml::table* table = file[name].as_table();
      for (std::size_t i = 0; table != nullptr && i < control::tunable_count; ++i) {
        auto& value = (*all)[place].values[i];
        if (auto wrong = read_value(*table, name, control::tunables()[i].name, value)) return wrong;
      }
    }
  }
  const toml::table* table = file[chosen].as_table();
  if (table == nullptr) return std::nullopt;
  for (const auto& [key, place] : places(tuning)) {
    if (auto wrong = read_value(*table, chosen, key, *place)) return wrong;
  }
  return std::nullopt;
}

}  // namespace supercoil::storage
