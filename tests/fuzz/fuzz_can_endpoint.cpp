// Frames from the bus, received by the whole firmware: only a command of the lease holder may cause
// heat.
#include "fuzz/steps.hpp"
#include "loop/support/can_rig.hpp"

using namespace supercoil;
using fuzz::LeaseModel;
using fuzz::require;

namespace {

/// Half of a command's time to live, plus the ticks until it takes effect.
constexpr double slack_s = 0.1;

test::RigSettings quick_board() {
  test::RigSettings settings = test::rough_board(100.0);
  // Cold from the first tick: each input acts on a board that has finished its boot.
  for (ChannelSettings& channel : settings.firmware.channels)
    channel.thermal.boot_rise_K = 0.0;
  return settings;
}

/// A booted board, and when each channel was last commanded.
class Board {
 public:
  Board() : rig_(quick_board()), model_(rig_.can.lease_s) {
    rig_.run(1.0);
    rig_.bus.listener = [this](const hal::CanFrame& frame) { model_.observe_answer(frame, now()); };
  }

  void take(const fuzz::Step& step) {
    const hal::CanFrame frame = frame_of(step, model_);
    if (model_.from_holder(frame, now()))
      commanded_[static_cast<std::size_t>(LeaseModel::channel_of(frame))] = now();
    // Of the trajectory frames, only knots renew.
    const int moved = model_.observe_trajectory(frame, now());
    if (moved >= 0 && LeaseModel::channel_of(frame, LeaseModel::knot_base) >= 0)
      commanded_[static_cast<std::size_t>(moved)] = now();
    rig_.bus.deliver(frame);
    tick();
    model_.observe(frame, now());
    for (int i = 0; i < step.wait; ++i)
      tick();
  }

 private:
  hal::Time now() const { return rig_.board.now(); }
  void tick() {
    rig_.tick();
    for (std::size_t i = 0; i < rig_.loop.channels(); ++i) {
      const double expires_s =
          rig_.settings.firmware.channels[i].supervision.command_timeout_s + slack_s;
      const bool follows = hal::seconds(now() - commanded_[i]) < expires_s;
      require(follows || rig_.board.channel(i).true_power_W() == 0.0,
              "heat follows a command of the lease's holder");
    }
  }

  test::CanRig rig_;
  LeaseModel model_;
  std::array<hal::Time, LeaseModel::channels> commanded_{};
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Board board;
  fuzz::for_each_step(data, size, [&](const fuzz::Step& step) { board.take(step); });
  return 0;
}
