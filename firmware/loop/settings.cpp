#include "loop/settings.hpp"

#include <sstream>

namespace supercoil {

std::string check(const BoardSettings& settings) {
  std::ostringstream wrong;
  const BoardSupervision& s = settings.supervision;
  const double tolerated_s = s.overruns_in_a_row * settings.step_s();
  if (settings.channels.empty() || settings.channels.size() > 16) {
    wrong << "a board has 1 to 16 channels, not " << settings.channels.size();
  } else if (!(s.charge_pump_decay_s > 2.0 * tolerated_s)) {
    wrong << "charge_pump_decay_ms must exceed twice the tolerated overruns: "
          << s.overruns_in_a_row << " in a row at " << settings.rate_Hz << " Hz are "
          << 1e3 * tolerated_s << " ms, so more than " << 2e3 * tolerated_s << " ms, not "
          << 1e3 * s.charge_pump_decay_s;
  }
  for (const ChannelSettings& channel : settings.channels) {
    if (channel.controllers.empty() || channel.estimators.empty()) {
      wrong << "a channel needs a controller and an estimator";
    }
  }
  return wrong.str();
}

}  // namespace supercoil
