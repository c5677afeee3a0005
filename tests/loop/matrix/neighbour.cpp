#include "loop/matrix/neighbour.hpp"

namespace supercoil::test {

namespace {

/// Max distance of the muscle from its reference model; both began at rest half a second before.
constexpr double tracking_m = 0.5e-3;

}  // namespace

std::string neighbour_wrong(const Rig& rig, Fault cause) {
  const Channel& channel = rig.loop.channel(Rig::neighbour);
  const ChannelState& state = channel.state();
  if (state.first_cause() != cause) {
    return "the neighbour's fault is " + std::string(name(state.first_cause()));
  }
  if (state.state() != (cause == Fault::none ? State::active : State::fault)) {
    return "the neighbour is " + std::string(name(state.state()));
  }
  const double error_m = channel.snapshot().position_m - channel.snapshot().model_m;
  if (cause == Fault::none && !(std::abs(error_m) < tracking_m)) {
    return "the neighbour is " + std::to_string(1e3 * error_m) + " mm from where it should be";
  }
  return "";
}

}  // namespace supercoil::test
