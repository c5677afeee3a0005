// The believed muscle, and the bounds that it is known to lie within.
#include <array>
#include <cmath>
#include <sstream>

#include "config/read_channel.hpp"
#include "config/read_control.hpp"

namespace supercoil::config {

namespace {

struct Bound {
  const char* min_key;
  const char* max_key;
  double control::ThermalBounds::*min;
  double control::ThermalBounds::*max;
  double control::PhysicalParameters::*believed;
  const char* believed_key;
};

constexpr std::array<Bound, 2> thermal_bounds{{
    {"min_mass_J_per_K", "max_mass_J_per_K", &control::ThermalBounds::min_mass_J_per_K,
     &control::ThermalBounds::max_mass_J_per_K, &control::PhysicalParameters::thermal_mass_J_per_K,
     "muscle.thermal_mass_J_per_K"},
    {"min_transfer_W_per_K", "max_transfer_W_per_K", &control::ThermalBounds::min_transfer_W_per_K,
     &control::ThermalBounds::max_transfer_W_per_K,
     &control::PhysicalParameters::heat_transfer_W_per_K, "muscle.heat_transfer_W_per_K"},
}};

void read_bound(Section& section, const Bound& bound, const control::PhysicalParameters& muscle,
                control::ThermalBounds& b) {
  const double min_value = b.*bound.min = section.required_number(bound.min_key, {1e-5, 1e3});
  const double max_value = b.*bound.max = section.required_number(bound.max_key, {1e-5, 1e3});
  const double believed = muscle.*bound.believed;
  const auto wrong = [&](const char* key, const char* side) {
    std::ostringstream message;
    message << "must not " << side << " the believed value: " << bound.believed_key << " = "
            << believed;
    section.wrong(key, message.str());
  };
  if (min_value >= max_value) {
    section.wrong(bound.min_key, std::string("must be less than ") + bound.max_key);
  } else if (min_value > believed) {
    wrong(bound.min_key, "exceed");
  } else if (max_value < believed) {
    wrong(bound.max_key, "be less than");
  }
}

void read_slowest(Section& section, control::ThermalBounds& b) {
  b.max_time_constant_s = section.number("max_time_constant_s", b.max_time_constant_s, {1e-3, 1e5});
  const double min_time_constant_s = b.min_mass_J_per_K / b.max_transfer_W_per_K;
  if (!section.has("max_time_constant_s") || b.max_time_constant_s >= min_time_constant_s) return;
  std::ostringstream message;
  message << "must not be less than min_mass_J_per_K / max_transfer_W_per_K = "
          << min_time_constant_s;
  section.wrong("max_time_constant_s", message.str());
}

/// What narrows the bounds, each with its error.
void read_heat_errors(Section& section, bool weighed, board::ThermalSettings& t) {
  t.mass_error_ratio = section.number("weighed_mass_error_ratio", 0.0, {0.0, 0.5});
  if (section.has("weighed_mass_error_ratio") && !weighed) {
    section.wrong("weighed_mass_error_ratio",
                  "needs weighed_mass_J_per_K: an assumed mass narrows nothing");
  }
  t.time_constant_error_ratio =
      section.number("time_constant_error_ratio", t.time_constant_error_ratio, {0.05, 5.0});
  t.thermometer_error_K = section.number("thermometer_error_K", t.thermometer_error_K, {0.1, 20.0});
}

}  // namespace

void read_muscle(Section muscle, Section thermal, const BoardContext& context, ChannelSettings& c) {
  c.muscle = read_parameters(muscle, {});
  muscle.finish();
  board::ThermalSettings& t = c.thermal;
  for (const Bound& bound : thermal_bounds)
    read_bound(thermal, bound, c.muscle, t.bounds);
  read_slowest(thermal, t.bounds);
  thermal.allow({"power_part"});
  if (thermal.has("power_part")) {
    thermal.wrong(
        "power_part",
        "contradicts detectors.resistance_ratio, below which no error of the senses is "
        "noticed; leave it out: the bounds of power follow from that until the senses are "
        "compared with a meter (supercoil doctor --compare-senses)");
  }
  t.thermal_mass_J_per_K =
      thermal.number("weighed_mass_J_per_K", c.muscle.thermal_mass_J_per_K, {1e-4, 1e3});
  const bool weighed = thermal.has("weighed_mass_J_per_K");  // else checked above
  if (weighed && (t.thermal_mass_J_per_K < t.bounds.min_mass_J_per_K ||
                  t.thermal_mass_J_per_K > t.bounds.max_mass_J_per_K)) {
    thermal.wrong("weighed_mass_J_per_K", "must lie between min_mass_J_per_K and max_mass_J_per_K");
  }
  read_heat_errors(thermal, weighed, t);
  t.air = context.air;
  // The board may have stopped a moment ago, with the muscle just below the trip.
  const double below_trip_K = std::fmax(0.0, c.supervision.trip_C - t.air.warmest_C);
  const double boot_K = std::isfinite(below_trip_K) ? below_trip_K : 0.0;
  t.boot_rise_K = thermal.number("boot_rise_K", boot_K, {0.0, 300.0});
  thermal.finish();
}

}  // namespace supercoil::config
