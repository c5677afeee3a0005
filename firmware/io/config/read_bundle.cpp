// [channel.bundle]: several muscles under one heater.
#include <sstream>

#include "config/read_channel.hpp"

namespace supercoil::config {

namespace {

constexpr int max_muscles = 32;
constexpr control::Names<Wired, 2> wired_names{
    {{"series", Wired::series}, {"parallel", Wired::parallel}}};

}  // namespace

std::optional<Bundle> read_bundle(Section section, const ChannelSettings& c) {
  if (section.table() == nullptr) return std::nullopt;
  Bundle bundle;
  bundle.muscles = static_cast<int>(section.required_integer("muscles", 2, max_muscles));
  bundle.threads = section.choice("wired", Wired::series, wired_names);
  section.finish();
  const double allowed = c.supervision.resistance_ratio;
  if (bundle.threads == Wired::parallel && bundle.one_lost_ratio() <= allowed) {
    std::ostringstream message;
    message << "of so many in parallel a broken thread adds " << 100.0 * bundle.one_lost_ratio()
            << " % of resistance, which detectors.resistance_ratio = " << allowed
            << " lets pass, and each of the others gets " << bundle.others_power_ratio()
            << " times its share: wire them in series, or make that smaller";
    section.wrong("muscles", message.str());
  }
  return bundle;
}

}  // namespace supercoil::config
