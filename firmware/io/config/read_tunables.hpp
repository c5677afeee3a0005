// The single values of controllers and estimators, as both are read.
#pragma once

#include <cmath>

#include "supercoil/control/tracking/tunable.hpp"

#include "config/section.hpp"

namespace supercoil::config {

/// But for kinds, reference models and gains, which are read apart. settings: whose kind is known.
template <class Settings>
void read_tunables(Section& section, Settings& settings) {
  using control::TunableType;
  for (const control::Tunable& t : control::tunables()) {
    const double fallback = t.get(settings);
    if (std::isnan(fallback)) continue;
    if (t.type == TunableType::number) {
      t.set(settings, section.number(t.name, fallback, {t.lowest, t.highest}));
    } else if (t.type == TunableType::flag) {
      t.set(settings, section.flag(t.name, fallback != 0.0) ? 1.0 : 0.0);
    }
  }
}

}  // namespace supercoil::config
