#include "supercoil/control/tracking/tunable.hpp"

#include <algorithm>
#include <cmath>

namespace supercoil::control {

namespace {

using Settings = ControllerSettings;
using Kind = ControllerKind;

constexpr bool follows_model(const Settings& s) {
  return s.kind != Kind::power;
}

/// Function: takes one LawValue by its name, of the law in use, and its settings.
template <class SomeSettings, class Function>
void with_value(SomeSettings& settings, std::string_view name, Function function) {
  with_chosen<Laws>(settings, [&](auto law, auto& own) {
    for (const auto& value : decltype(law)::values) {
      if (value.name == name) function(value, own);
    }
  });
}

bool slows_down(Kind kind) {
  bool can = false;
  with_listed<Laws>(kind, [&](auto listed) {
    can = requires(typename decltype(listed)::Definition::template In<double> law) {
      law.slow_down();
    };
  });
  return can;
}

template <std::size_t I>
double pole_of(const Settings& s) {
  return follows_model(s) ? s.model.poles_rad_per_s[I] : NAN;
}
template <std::size_t I>
void set_pole(Settings& s, double value) {
  auto poles = s.model.poles_rad_per_s;
  poles[I] = value;
  s.model = poles_model(poles);
}

double model_of(const Settings& s) {
  if (!follows_model(s)) return NAN;
  for (std::size_t i = 0; i < tunable_models.size(); ++i) {
    if (reference_model_named(tunable_models[i])->denominator == s.model.denominator)
      return static_cast<double>(i + 1);
  }
  return 0.0;
}

/// 0: a model with complex poles gets three equal real ones, whose product is the same.
void set_model(Settings& s, double value) {
  if (value > 0.0) {
    s.model = *reference_model_named(tunable_models[static_cast<std::size_t>(value) - 1]);
  } else if (std::isnan(s.model.poles_rad_per_s[0])) {
    const double pole = std::cbrt(s.model.denominator[0]);
    s.model = poles_model({pole, pole, pole});
  }
}

/// Name, type, range; of what is no law's, how it is read and set.
constexpr std::array<Tunable, tunable_count> all{{
    {"kind", TunableType::kind, 0.0, static_cast<double>(controller_names.size() - 1),
     [](const Settings& s) { return static_cast<double>(s.kind); },
     [](Settings& s, double value) { s.kind = static_cast<Kind>(value); }},
    {"proportional_W_per_m", TunableType::number, 0.0, 1e7},
    {"integral_W_per_m_s", TunableType::number, 0.0, 1e7},
    {"derivative_Ws_per_m", TunableType::number, 0.0, 1e7},
    {"feedforward_W_per_m", TunableType::number, 0.0, 1e7},
    {"bandwidth_rad_per_s", TunableType::number, 0.0, 100.0},
    {"derivative_filter_rad_per_s", TunableType::number, 0.1, 1e4},
    {"follow_s", TunableType::number, 0.02, 3600.0},
    {"forgetting_s", TunableType::number, 1.0, 3600.0},
    {"learn", TunableType::flag, 0.0, 1.0},
    {"period_s", TunableType::number, 0.0, 600.0},
    {"find_period", TunableType::flag, 0.0, 1.0},
    {"filter_rad_per_s", TunableType::number, 0.5, 100.0},
    {"regression_rad_per_s", TunableType::number, 0.5, 100.0},
    {"change_W", TunableType::number, 1e-6, 1e3},
    {"hold_s", TunableType::number, 0.0, 3600.0},
    {"shape_reference", TunableType::flag, 0.0, 1.0,
     [](const Settings& s) {
       return follows_model(s) ? static_cast<double>(s.shape_reference) : NAN;
     },
     [](Settings& s, double value) { s.shape_reference = value != 0.0; }},
    {"slow_when_oscillating", TunableType::flag, 0.0, 1.0,
     [](const Settings& s) {
       return slows_down(s.kind) ? static_cast<double>(s.slow_when_oscillating) : NAN;
     },
     [](Settings& s, double value) { s.slow_when_oscillating = value != 0.0; }},
    {"reference_model", TunableType::model, 0.0, static_cast<double>(tunable_models.size()),
     model_of, set_model},
    {"model_pole_1_rad_per_s", TunableType::pole, 1e-3, 1e3, pole_of<0>, set_pole<0>},
    {"model_pole_2_rad_per_s", TunableType::pole, 1e-3, 1e3, pole_of<1>, set_pole<1>},
    {"model_pole_3_rad_per_s", TunableType::pole, 1e-3, 1e3, pole_of<2>, set_pole<2>},
    {"adaptation_scale", TunableType::number, 1e-6, 1e6},
}};

/// What a law calls a value must stand above.
constexpr bool all_listed() {
  const auto listed = [](auto law) {
    return std::ranges::all_of(decltype(law)::Definition::values, [](const auto& value) {
      return std::ranges::find(all, value.name, &Tunable::name) != all.end();
    });
  };
  return std::apply([&](auto... law) { return (listed(law) && ...); }, Laws{});
}
static_assert(all_listed());

}  // namespace

double Tunable::get(const ControllerSettings& settings) const {
  if (of_controller != nullptr) return of_controller(settings);
  double found = NAN;
  with_value(settings, name, [&](const auto& value, const auto& own) { found = value.get(own); });
  return found;
}

void Tunable::set(ControllerSettings& settings, double to) const {
  if (set_controller != nullptr) return set_controller(settings, to);
  with_value(settings, name, [&](const auto& value, auto& own) { value.set(own, to); });
}

bool Tunable::in_range(double value) const {
  const bool whole =
      type == TunableType::number || type == TunableType::pole || value == std::floor(value);
  return value >= lowest && value <= highest && whole;
}

const std::array<Tunable, tunable_count>& tunables() {
  return all;
}

std::size_t tunable_named(std::string_view name) {
  const auto found = std::ranges::find(all, name, &Tunable::name);
  return static_cast<std::size_t>(found - all.begin());
}

}  // namespace supercoil::control
