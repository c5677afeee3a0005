#include "supercoil/control/tracking/tunable.hpp"

#include <algorithm>
#include <cmath>

namespace supercoil::control {

namespace {

using Settings = ControllerSettings;
using Kind = ControllerKind;

template <double* (*Place)(Settings&)>
constexpr Tunable number(std::string_view name, double lowest, double highest) {
  return {name,
          TunableType::number,
          lowest,
          highest,
          [](const Settings& settings) {
            Settings s = settings;
            const double* value = Place(s);
            return value == nullptr ? NAN : *value;
          },
          [](Settings& s, double value) { *Place(s) = value; }};
}

template <bool* (*Place)(Settings&)>
constexpr Tunable flag(std::string_view name) {
  return {name,
          TunableType::flag,
          0.0,
          1.0,
          [](const Settings& settings) {
            Settings s = settings;
            const bool* value = Place(s);
            return value == nullptr ? NAN : static_cast<double>(*value);
          },
          [](Settings& s, double value) { *Place(s) = value != 0.0; }};
}

constexpr bool follows_model(const Settings& s) {
  return s.kind != Kind::power;
}

double* proportional(Settings& s) {
  if (s.kind == Kind::pd_ff) return &s.pd_ff.proportional_W_per_m;
  return s.kind == Kind::pi ? &s.pi.proportional_W_per_m : nullptr;
}
double* integral(Settings& s) {
  return s.kind == Kind::pi ? &s.pi.integral_W_per_m_s : nullptr;
}
double* derivative(Settings& s) {
  return s.kind == Kind::pd_ff ? &s.pd_ff.derivative_Ws_per_m : nullptr;
}
double* feedforward(Settings& s) {
  return s.kind == Kind::pd_ff ? &s.pd_ff.feedforward_W_per_m : nullptr;
}
double* bandwidth(Settings& s) {
  if (s.kind == Kind::adaptive_ff) return &s.adaptive_ff.bandwidth_rad_per_s;
  if (s.kind == Kind::learned_ff) return &s.learned_ff.bandwidth_rad_per_s;
  return s.kind == Kind::mrac_ls ? &s.mrac_ls.bandwidth_rad_per_s : nullptr;
}
double* derivative_filter(Settings& s) {
  if (s.kind == Kind::pd_ff) return &s.pd_ff.derivative_filter_rad_per_s;
  if (s.kind == Kind::adaptive_ff) return &s.adaptive_ff.derivative_filter_rad_per_s;
  if (s.kind == Kind::learned_ff) return &s.learned_ff.derivative_filter_rad_per_s;
  return s.kind == Kind::mrac_ls ? &s.mrac_ls.derivative_filter_rad_per_s : nullptr;
}
double* follow(Settings& s) {
  if (s.kind == Kind::adaptive_ff) return &s.adaptive_ff.follow_s;
  if (s.kind == Kind::learned_ff) return &s.learned_ff.follow_s;
  return s.kind == Kind::mrac_ls ? &s.mrac_ls.follow_s : nullptr;
}
double* forgetting(Settings& s) {
  if (s.kind == Kind::learned_ff) return &s.learned_ff.forgetting_s;
  return s.kind == Kind::mrac_ls ? &s.mrac_ls.forgetting_s : nullptr;
}
double* period(Settings& s) {
  return s.kind == Kind::learned_ff ? &s.learned_ff.period_s : nullptr;
}
bool* learns(Settings& s) {
  return s.kind == Kind::learned_ff ? &s.learned_ff.learn : nullptr;
}
bool* finds_period(Settings& s) {
  return s.kind == Kind::learned_ff ? &s.learned_ff.find_period : nullptr;
}
bool* shapes(Settings& s) {
  return follows_model(s) ? &s.shape_reference : nullptr;
}
bool* slows(Settings& s) {
  const bool can = follows_model(s) && s.kind != Kind::mrac && s.kind != Kind::mrac_ls;
  return can ? &s.slow_when_oscillating : nullptr;
}

/// Of the values of one law.
template <Kind Of, auto Law, auto Member>
double* of(Settings& s) {
  return s.kind == Of ? &(s.*Law.*Member) : nullptr;
}

template <std::size_t I>
constexpr Tunable pole(std::string_view name) {
  return {name,
          TunableType::pole,
          1e-3,
          1e3,
          [](const Settings& s) { return follows_model(s) ? s.model.poles_rad_per_s[I] : NAN; },
          [](Settings& s, double value) {
            auto poles = s.model.poles_rad_per_s;
            poles[I] = value;
            s.model = poles_model(poles);
          }};
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

using MracLs = MracLeastSquaresSettings;
constexpr Kind mrac_ls = Kind::mrac_ls;
constexpr auto in_ls = &Settings::mrac_ls;

constexpr std::array<Tunable, tunable_count> all{{
    {"kind", TunableType::kind, 0.0, static_cast<double>(controller_names.size() - 1),
     [](const Settings& s) { return static_cast<double>(s.kind); },
     [](Settings& s, double value) { s.kind = static_cast<Kind>(value); }},
    number<proportional>("proportional_W_per_m", 0.0, 1e7),
    number<integral>("integral_W_per_m_s", 0.0, 1e7),
    number<derivative>("derivative_Ws_per_m", 0.0, 1e7),
    number<feedforward>("feedforward_W_per_m", 0.0, 1e7),
    number<bandwidth>("bandwidth_rad_per_s", 0.0, 100.0),
    number<derivative_filter>("derivative_filter_rad_per_s", 0.1, 1e4),
    number<follow>("follow_s", 0.02, 3600.0),
    number<forgetting>("forgetting_s", 1.0, 3600.0),
    flag<learns>("learn"),
    number<period>("period_s", 0.0, 600.0),
    flag<finds_period>("find_period"),
    number<of<mrac_ls, in_ls, &MracLs::filter_rad_per_s>>("filter_rad_per_s", 0.5, 100.0),
    number<of<mrac_ls, in_ls, &MracLs::regression_rad_per_s>>("regression_rad_per_s", 0.5, 100.0),
    number<of<mrac_ls, in_ls, &MracLs::change_W>>("change_W", 1e-6, 1e3),
    number<of<mrac_ls, in_ls, &MracLs::hold_s>>("hold_s", 0.0, 3600.0),
    flag<shapes>("shape_reference"),
    flag<slows>("slow_when_oscillating"),
    {"reference_model", TunableType::model, 0.0, static_cast<double>(tunable_models.size()),
     model_of, set_model},
    pole<0>("model_pole_1_rad_per_s"),
    pole<1>("model_pole_2_rad_per_s"),
    pole<2>("model_pole_3_rad_per_s"),
    {"adaptation_scale", TunableType::number, 1e-6, 1e6,
     [](const Settings& s) { return s.kind == Kind::mrac ? s.mrac.adaptation_scale : NAN; },
     [](Settings& s, double value) {
       s.mrac = s.mrac.scaled(value / s.mrac.adaptation_scale);
       s.mrac.adaptation_scale = value;  // without what the division rounded
     }},
}};

}  // namespace

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
