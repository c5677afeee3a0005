// What a muscle may be asked for: power, temperature, travel, energy.
#include <cmath>
#include <sstream>

#include "config/read_channel.hpp"
#include "config/read_lever.hpp"

namespace supercoil::config {

namespace {

constexpr control::Names<Preset, 2> preset_names{
    {{"nylon", Preset::nylon}, {"skin", Preset::skin}}};

struct Temperatures {
  double derate_C;
  double trip_C;
  double max_C;  ///< max value of the trip
};

Temperatures temperatures_of(Preset preset) {
  // ISO 13732-1: skin in lasting contact is burnt within 8 hours from 43 °C on, within 10 minutes
  // from 48 °C on, whatever the material. So the trip is at 43 °C, and power falls from 38 °C on,
  // just above the body's own temperature. Anything between muscle and skin only makes it cooler.
  if (preset == Preset::skin) return {38.0, 43.0, 43.0};
  // Nylon 6,6 softens well below its melting point of about 260 °C; coils lose their training
  // there.
  return {130.0, 160.0, 180.0};
}

void read_power(Section& section, const BoardContext& context, ChannelSettings& c) {
  LimiterSettings& l = c.limiter;
  ChannelSupervision& s = c.supervision;
  l.max_W = section.required_number("max_W", {1e-3, 1e3});
  l.min_W = section.number("min_W", l.min_W, {0.0, 1e3});
  if (l.min_W >= l.max_W) section.wrong("min_W", "must be less than max_W");
  l.slew_W_per_s = section.number("slew_W_per_s", l.slew_W_per_s, {1e-3, 1e6});
  const double supply_V = context.board.supervision.min_supply_V;
  const double full_W = supply_V * supply_V / c.heater.cold_resistance_Ohm;
  if (l.max_W > full_W) {
    std::ostringstream message;
    message << "must not exceed what the supply gives at a duty of 1: "
               "min_V²/cold_resistance_Ohm = "
            << full_W << " W";
    section.wrong("max_W", message.str());
  }
  // Absent keys follow max_W; while that is missing, any number will do.
  const double max_W = std::isfinite(l.max_W) ? l.max_W : 1.0;
  s.max_measured_W = section.number("max_measured_W", default_max_measured_W(max_W), {1e-3, 1e4});
  if (s.max_measured_W <= l.max_W) {
    section.wrong("max_measured_W", "must exceed max_W: it is where too much power is a fault");
  }
  s.energy_window_s = section.number("energy_window_s", s.energy_window_s, {0.1, 3600.0});
  s.energy_J = section.number("energy_J", default_energy_J(max_W, s.energy_window_s), {1e-3, 1e6});
}

void read_temperatures(Section& section, const BoardContext& context, ChannelSettings& c,
                       Preset preset) {
  const Temperatures t = temperatures_of(preset);
  LimiterSettings& l = c.limiter;
  l.derate_from_C = section.number("derate_from_C", t.derate_C, {0.0, t.max_C});
  l.derate_to_C = c.supervision.trip_C = section.number("trip_C", t.trip_C, {0.0, t.max_C});
  if (l.derate_from_C >= l.derate_to_C) {
    section.wrong("derate_from_C", "must be less than trip_C");
  }
  if (l.derate_from_C <= context.air.warmest_C) {
    section.wrong("derate_from_C",
                  "must exceed ambient.warmest_C: otherwise a cold muscle counts as a hot one");
  }
}

/// The limit as its key states it. An antagonist's sensor is its agonist's, with the opposite sign.
std::string sensor_limit(const ChannelSettings& c, const ChannelLabel& label) {
  const bool agonists = c.joint.direction < 0;
  const double limit_m =
      agonists ? 0.0 - c.supervision.max_position_m : c.supervision.max_position_m;
  std::ostringstream text;
  text << (agonists ? "its agonist's position.min_" : "position.max_");
  if (label.position_in_deg) {
    text << "deg = " << limit_m / metres_per_degree(c.joint.lever);
  } else {
    text << "m = " << limit_m;
  }
  return text.str();
}

/// From the channel's own max_travel_m, from its joint's range, or from both if they agree.
void read_travel(Section& section, const BoardContext& context, ChannelSettings& c,
                 const ChannelLabel& label, const std::optional<double>& joint_travel_m) {
  constexpr const char* key = "max_travel_m";
  // Allows for rounded metres.
  constexpr double max_disagreement_ratio = 0.01;
  ChannelSupervision& s = c.supervision;
  if (!joint_travel_m && context.joint_is_wrong && !section.has(key)) {
    section.allow({key});
    s.max_travel_m = NAN;
  } else if (!joint_travel_m) {
    s.max_travel_m = section.required_number(key, limits_of_travel_m);
  } else {
    s.max_travel_m = *joint_travel_m;
    const double given_m = section.number(key, *joint_travel_m, limits_of_travel_m);
    if (std::abs(given_m - *joint_travel_m) > max_disagreement_ratio * *joint_travel_m) {
      std::ostringstream message;
      message << "contradicts its joint's range_deg, which gives " << *joint_travel_m
              << ": leave one of them out";
      section.wrong(key, message.str());
    }
  }
  const double reading_m = c.joint.reading_of_position_m(s.max_travel_m);
  if (!(reading_m > s.max_position_m)) return;
  std::ostringstream message;
  if (joint_travel_m) message << "is " << s.max_travel_m << " from its joint's range_deg, and ";
  message << "must be within what the sensor can read: " << sensor_limit(c, label);
  if (reading_m != s.max_travel_m) message << ", and with its lever it reads " << reading_m;
  section.wrong(key, message.str());
}

}  // namespace

void read_limits(Section section, const BoardContext& context, ChannelSettings& c,
                 ChannelLabel& label, const std::optional<double>& joint_travel_m) {
  label.preset = section.choice("preset", Preset::nylon, preset_names);
  read_power(section, context, c);
  read_temperatures(section, context, c, label.preset);
  read_travel(section, context, c, label, joint_travel_m);
  section.finish();
}

}  // namespace supercoil::config
