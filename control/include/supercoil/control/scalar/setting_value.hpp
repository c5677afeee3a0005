// Single values of settings, by name.
#pragma once

#include <string_view>
#include <type_traits>

namespace supercoil::control {

/// A setting of a law or an estimator that can be changed while it runs; its range is in
/// tunable.cpp.
template <class Settings>
struct SettingValue {
  std::string_view name;
  double (*get)(const Settings& settings);  ///< a flag: 0 or 1
  void (*set)(Settings& settings, double value);
};

/// Member: a double or a bool of the settings.
template <class Settings, auto Member>
constexpr SettingValue<Settings> setting_value(std::string_view name) {
  return {name, [](const Settings& s) { return static_cast<double>(s.*Member); },
          [](Settings& s, double value) {
            if constexpr (std::is_same_v<decltype(Member), bool Settings::*>) {
              s.*Member = value != 0.0;
            } else {
              s.*Member = value;
            }
          }};
}

/// Member: an array among the settings. The value is its element at I.
template <class Settings, auto Member, int I>
constexpr SettingValue<Settings> element_value(std::string_view name) {
  return {name, [](const Settings& s) { return static_cast<double>((s.*Member)[I]); },
          [](Settings& s, double value) { (s.*Member)[I] = value; }};
}

}  // namespace supercoil::control
