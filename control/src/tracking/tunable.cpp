#include "supercoil/control/tracking/tunable.hpp"

#include <algorithm>
#include <cmath>

namespace supercoil::control {

namespace {

using Settings = ControllerSettings;
using Kind = ControllerKind;
using Law = Tunable::Access<ControllerSettings>;
using Estimation = Tunable::Access<EstimatorSettings>;

constexpr bool follows_model(const Settings& s) {
  return s.kind != Kind::power;
}

/// Calls function(SettingValue, its settings) for this name in the law or estimator in use.
template <class List, class SomeSettings, class Function>
void with_value(SomeSettings& settings, std::string_view name, Function function) {
  with_chosen<List>(settings, [&](auto definition, auto& own) {
    for (const auto& value : decltype(definition)::values) {
      if (value.name == name) function(value, own);
    }
  });
}

template <class List, class SomeSettings>
double get_value(const Tunable::Access<SomeSettings>& common, const SomeSettings& settings,
                 std::string_view name) {
  if (common.get != nullptr) return common.get(settings);
  double found = NAN;
  with_value<List>(settings, name,
                   [&](const auto& value, const auto& own) { found = value.get(own); });
  return found;
}

template <class List, class SomeSettings>
void set_value(const Tunable::Access<SomeSettings>& common, SomeSettings& settings,
               std::string_view name, double to) {
  if (common.set != nullptr) return common.set(settings, to);
  with_value<List>(settings, name, [&](const auto& value, auto& own) { value.set(own, to); });
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

/// 0: a model with complex poles gets three equal real ones with the same product.
void set_model(Settings& s, double value) {
  if (value > 0.0) {
    s.model = *reference_model_named(tunable_models[static_cast<std::size_t>(value) - 1]);
  } else if (std::isnan(s.model.poles_rad_per_s[0])) {
    const double pole = std::cbrt(s.model.denominator[0]);
    s.model = poles_model({pole, pole, pole});
  }
}

/// How the settings outside the laws are read and set.
constexpr Law common_kind{[](const Settings& s) { return static_cast<double>(s.kind); },
                          [](Settings& s, double value) { s.kind = static_cast<Kind>(value); }};
constexpr Law common_shaping{[](const Settings& s) {
                               return follows_model(s) ? static_cast<double>(s.shape_reference)
                                                       : NAN;
                             },
                             [](Settings& s, double value) { s.shape_reference = value != 0.0; }};
constexpr Law common_slowing{
    [](const Settings& s) {
      return slows_down(s.kind) ? static_cast<double>(s.slow_when_oscillating) : NAN;
    },
    [](Settings& s, double value) { s.slow_when_oscillating = value != 0.0; }};

/// The same for the settings outside the estimators.
constexpr Estimation common_estimator_kind{
    [](const EstimatorSettings& s) { return static_cast<double>(s.kind); },
    [](EstimatorSettings& s, double value) { s.kind = static_cast<EstimatorKind>(value); }};
constexpr Estimation common_window{
    [](const EstimatorSettings& s) {
      return s.kind == EstimatorKind::gradient ? s.excitation.window_s : NAN;
    },
    [](EstimatorSettings& s, double value) { s.excitation.window_s = value; }};
constexpr Estimation common_trusted_error{
    [](const EstimatorSettings& s) {
      return s.kind == EstimatorKind::none ? NAN : s.excitation.trusted_error;
    },
    [](EstimatorSettings& s, double value) { s.excitation.trusted_error = value; }};

constexpr double max_kinds =
    static_cast<double>(std::max(controller_names.size(), estimator_names.size()));

constexpr std::array<Tunable, tunable_count> all{{
    {"kind", TunableType::kind, 0.0, max_kinds - 1.0, common_kind, common_estimator_kind},
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
    {"shape_reference", TunableType::flag, 0.0, 1.0, common_shaping},
    {"slow_when_oscillating", TunableType::flag, 0.0, 1.0, common_slowing},
    {"reference_model", TunableType::model, 0.0, static_cast<double>(tunable_models.size()),
     Law{model_of, set_model}},
    {"model_pole_1_rad_per_s", TunableType::pole, 1e-3, 1e3, Law{pole_of<0>, set_pole<0>}},
    {"model_pole_2_rad_per_s", TunableType::pole, 1e-3, 1e3, Law{pole_of<1>, set_pole<1>}},
    {"model_pole_3_rad_per_s", TunableType::pole, 1e-3, 1e3, Law{pole_of<2>, set_pole<2>}},
    {"adaptation_scale", TunableType::number, 1e-6, 1e6},
    {"gain_1", TunableType::element, 1e-6, 1e12},
    {"gain_2", TunableType::element, 1e-6, 1e12},
    {"gain_3", TunableType::element, 1e-6, 1e12},
    {"gain_4", TunableType::element, 1e-6, 1e12},
    {"normalisation", TunableType::number, 0.0, 1e6},
    {"window_s", TunableType::number, 0.1, 3600.0, Law{}, common_window},
    {"min_ratio", TunableType::number, 1e-3, 1.0},
    {"max_ratio", TunableType::number, 1.0, 1e3},
    {"max_bias_W", TunableType::number, 0.0, 1e3},
    {"position_noise_m", TunableType::number, 1e-9, 1e-2},
    {"trusted_error", TunableType::number, 1e-6, 1e3, Law{}, common_trusted_error},
    {"gain_5", TunableType::element, 1e-6, 1e12},
    {"gain_6", TunableType::element, 1e-6, 1e12},
    {"sigma_gain", TunableType::number, -1e9, 1e9},
    {"damping", TunableType::number, -1e6, 1e6},
    {"alpha_1", TunableType::element, 1e-6, 1e6},
    {"alpha_2", TunableType::element, 1e-6, 1e6},
    {"lambda_1", TunableType::element, -1e6, 1e6},
    {"lambda_2", TunableType::element, -1e6, 1e6},
    {"p0_rad_per_s", TunableType::number, -1e3, 1e3},
    {"p1_rad_per_s", TunableType::number, -1e3, 1e3},
    {"q0_rad_per_s", TunableType::number, -1e3, 1e3},
    {"freeze_when_limited", TunableType::flag, 0.0, 1.0},
    {"sigma_modification", TunableType::number, 0.0, 1e3},
    {"dead_zone_W", TunableType::number, 0.0, 1e3},
    {"adapt_bandwidth", TunableType::flag, 0.0, 1.0},
}};

/// Every name that a law or an estimator gives a value must be listed above.
template <class List>
constexpr bool all_listed() {
  const auto listed = [](auto one) {
    return std::ranges::all_of(decltype(one)::Definition::values, [](const auto& value) {
      return std::ranges::find(all, value.name, &Tunable::name) != all.end();
    });
  };
  return std::apply([&](auto... one) { return (listed(one) && ...); }, List{});
}
static_assert(all_listed<Laws>() && all_listed<Estimators>());

template <class List>
bool some_have(std::string_view name) {
  const auto has = [&](auto one) {
    const auto& values = decltype(one)::Definition::values;
    return std::ranges::any_of(values, [&](const auto& value) { return value.name == name; });
  };
  return std::apply([&](auto... one) { return (has(one) || ...); }, List{});
}

}  // namespace

double Tunable::get(const ControllerSettings& settings) const {
  return get_value<Laws>(of_controller, settings, name);
}

double Tunable::get(const EstimatorSettings& settings) const {
  return get_value<Estimators>(of_estimator, settings, name);
}

void Tunable::set(ControllerSettings& settings, double to) const {
  set_value<Laws>(of_controller, settings, name, to);
}

void Tunable::set(EstimatorSettings& settings, double to) const {
  set_value<Estimators>(of_estimator, settings, name, to);
}

bool Tunable::controllers_have() const {
  return of_controller.get != nullptr || some_have<Laws>(name);
}

bool Tunable::estimators_have() const {
  return of_estimator.get != nullptr || some_have<Estimators>(name);
}

bool Tunable::in_range(double value) const {
  const bool whole = is_number() || value == std::floor(value);
  return value >= min && value <= max && whole;
}

const std::array<Tunable, tunable_count>& tunables() {
  return all;
}

std::size_t tunable_named(std::string_view name) {
  const auto found = std::ranges::find(all, name, &Tunable::name);
  return static_cast<std::size_t>(found - all.begin());
}

}  // namespace supercoil::control
