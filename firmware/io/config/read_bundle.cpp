// [channel.bundle]: several muscles under one heater.
#include <sstream>

#include "config/read_channel.hpp"

namespace supercoil::config {

namespace {

constexpr int max_muscles = 32;
constexpr control::Names<Wiring, 2> wiring_names{
    {{"series", Wiring::series}, {"parallel", Wiring::parallel}}};

}  // namespace

double Bundle::undetected_ratio(const ChannelSettings& channel) const {
  const double max_rise_K = channel.supervision.trip_C - channel.thermal.air.coldest_C;
  const double warm = 1.0 + channel.heater.temperature_coefficient_per_K * max_rise_K;
  const double drift = channel.supervision.resistance_ratio;
  return parallel() ? (1.0 + drift) * warm - 1.0 : 1.0 - (1.0 - drift) / warm;
}

std::optional<Bundle> read_bundle(Section section, const ChannelSettings& c) {
  if (!section.given()) return std::nullopt;
  Bundle bundle;
  bundle.muscles = static_cast<int>(section.required_integer("muscles", 2, max_muscles));
  bundle.wired = section.choice("wired", Wiring::series, wiring_names);
  section.finish();
  const double undetected_ratio = bundle.undetected_ratio(c);
  if (bundle.parallel() && bundle.one_lost_ratio() <= undetected_ratio) {
    std::ostringstream message;
    message << "with this many in parallel, a broken thread adds "
            << 100.0 * bundle.one_lost_ratio() << " % of resistance, and each of the others gets "
            << bundle.others_power_ratio()
            << " times its share; detectors.resistance_ratio = " << c.supervision.resistance_ratio
            << " and heater.temperature_coefficient_per_K let up to " << 100.0 * undetected_ratio
            << " % pass: wire them in series, or lower resistance_ratio";
    section.wrong("muscles", message.str());
  }
  return bundle;
}

}  // namespace supercoil::config
