// The tables that describe control, the same in scenarios and in boards' configurations: the
// muscle, reference models, controllers, estimators.
#pragma once

#include <cmath>
#include <optional>
#include <string_view>

#include "supercoil/control/estimation/estimator.hpp"
#include "supercoil/control/tracking/controller.hpp"
#include "supercoil/control/tracking/tunable.hpp"

#include "config/section.hpp"

namespace supercoil::config {

/// The six physical parameters, each within control::physical_ranges. Does not finish the section.
control::PhysicalParameters read_parameters(Section& section,
                                            const control::PhysicalParameters& fallback);

/// Empty when the table is absent: the controller then uses its own default.
std::optional<control::ReferenceModelSettings> read_reference_model(Section section);

/// Finishes the section. MRAC's premises are checked here, with the model that it will follow.
/// max_W: of the channel; NaN while that is missing.
control::ControllerSettings read_controller(
    Section& section, const control::PhysicalParameters& muscle,
    const std::optional<control::ReferenceModelSettings>& model, double max_W);

/// Finishes the section. max_W: of the channel; NaN while that is missing.
control::EstimatorSettings read_estimator(Section& section,
                                          const control::PhysicalParameters& muscle, double max_W);

/// What a list in a file may hold: the same as `tune` accepts for one of its elements.
inline Range range_of_tunable(std::string_view name) {
  const control::Tunable& tunable = control::tunables()[control::tunable_named(name)];
  return {tunable.min, tunable.max};
}

/// Reads the single values of a controller or an estimator; kinds, reference models and lists are
/// read elsewhere. settings: their kind is known.
template <class Settings>
void read_tunables(Section& section, Settings& settings) {
  using control::TunableType;
  for (const control::Tunable& t : control::tunables()) {
    const double fallback = t.get(settings);
    if (std::isnan(fallback)) continue;
    if (t.type == TunableType::number) {
      t.set(settings, section.number(t.name, fallback, {t.min, t.max}));
    } else if (t.type == TunableType::flag) {
      t.set(settings, section.flag(t.name, fallback != 0.0) ? 1.0 : 0.0);
    }
  }
}

/// Notes what q8.24 cannot hold (see control::check_fit).
void refuse_misfit(Section& section, const std::optional<control::Violation>& violation);

}  // namespace supercoil::config
