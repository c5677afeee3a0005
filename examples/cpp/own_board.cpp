// The firmware's loop on a board of your own: it implements the interfaces of supercoil/hal, here
// with a simulated muscle behind them. On a real board each call goes to the device instead, and
// wait_until() sleeps.
#include <cmath>
#include <cstdio>
#include <memory>
#include <random>
#include <supercoil/control/actuator/state_space.hpp>
#include <supercoil/control/linear/discretize.hpp>

#include "loop/executive.hpp"

using namespace supercoil;

namespace {

constexpr double step_s = 0.001;
constexpr double supply_V = 12.0;
constexpr double resistance_Ohm = 10.0;

struct Pwm final : hal::PwmOutput {
  hal::Status set(int step) override {
    set_to = step;
    return hal::Status::ok;
  }
  int read_back() const override { return set_to; }
  int steps() const override { return 4095; }
  int set_to = 0;
};

struct Output final : hal::DigitalOutput {
  hal::Status set(bool high) override {
    changed = changed || high != level;
    level = high;
    return hal::Status::ok;
  }
  bool level = false;
  bool changed = false;
};

struct StopCircuit final : hal::DigitalInput {
  hal::Level read() override { return {true, hal::Status::ok}; }
};

struct Converter final : hal::AdcChannel {
  hal::Sample latest() override { return sample; }
  hal::Sample sample;
};

/// The devices, and what they are wired to. Waiting for the next tick advances the muscle.
class Board final : public hal::Clock {
 public:
  Board() { convert(); }

  hal::Time now() const override { return time_; }
  hal::Time wait_until(hal::Time wake) override {
    while (time_ < wake)
      advance();
    return time_;
  }
  board::Devices devices() {
    return {.clock = this,
            .supply = &supply_,
            .heartbeat = &heartbeat_,
            .stop_circuit = &stop_circuit_,
            .light = nullptr,
            .watchdog = nullptr,
            .channels = {{&pwm_, &enable_, &position_, &current_}}};
  }

 private:
  void advance() {
    // A charge pump lets power through while the heartbeat keeps toggling.
    pumped_s_ = heartbeat_.changed ? 0.0 : pumped_s_ + step_s;
    heartbeat_.changed = false;
    const bool on = enable_.level && pumped_s_ < 0.015;
    current_A_ = on ? pwm_.set_to * supply_V / (pwm_.steps() * resistance_Ohm) : 0.0;
    x_ = muscle_.transition * x_ +
         muscle_.held * control::Vector<double, 2>(supply_V * current_A_, 0.0);
    time_ += hal::duration_from(step_s);
    convert();
  }
  void convert() {
    const auto sample = [this](double counts) {
      return hal::Sample{static_cast<std::int32_t>(std::lround(counts)), time_, hal::Status::ok};
    };
    supply_.sample = sample(1e3 * supply_V);
    current_.sample = sample(1e4 * current_A_);
    position_.sample = sample(1e6 * x_[1] + noise_um_(random_));
  }

  const control::ActuatorStateSpace model_ = control::state_space({});
  const control::ZeroOrderHold<3, 2> muscle_ =
      control::zero_order_hold<3, 2>(model_.a, model_.b, step_s);
  control::Vector<double, 3> x_ = control::Vector<double, 3>::Zero();
  std::minstd_rand random_;
  std::normal_distribution<double> noise_um_{0.0, 10.0};
  hal::Time time_{};
  double pumped_s_ = 1.0;
  double current_A_ = 0.0;
  Pwm pwm_;
  Output enable_, heartbeat_;
  StopCircuit stop_circuit_;
  Converter supply_, position_, current_;
};

BoardSettings settings() {
  BoardSettings board;
  board.rate_Hz = 1.0 / step_s;
  board.supply.scaling.per_count = 1e-3;
  ChannelSettings& channel = board.channels.front();
  channel.position.scaling.per_count = 1e-6;
  channel.heater.current.scaling.per_count = 1e-4;
  channel.heater.cold_resistance_Ohm = resistance_Ohm;
  control::ControllerSettings& controller = channel.controllers.front();
  controller.kind = control::ControllerKind::learned_ff;
  controller.set_nominal(channel.muscle, channel.limiter.max_W);
  return board;
}

void tell(int time_s, const Channel& channel, const Row& row) {
  std::printf("%3d s  %-9s %7.3f mm %5.2f W\n", time_s,
              std::string(name(channel.state().state())).c_str(), 1e3 * row.position_m,
              row.applied_W);
}

}  // namespace

int main() {
  const BoardSettings board_settings = settings();
  if (const auto problem = check(board_settings)) {
    std::printf("%s %s\n", problem->key.c_str(), problem->message.c_str());
    return 1;
  }
  Board board;
  const auto loop = std::make_unique<Loop>(board_settings, board.devices());
  Executive executive(*loop, board, board_settings.rate_Hz);
  const Channel& channel = loop->channel(0);
  for (int tick = 0; channel.state().state() != State::fault && tick < 90'000; ++tick) {
    executive.run_tick();
    // On a board the CAN and recorder threads do this.
    loop->health().telemetry_heartbeats.fetch_add(1);
    Row row;
    while (loop->take(row)) {
      if (tick % 5000 == 0) tell(tick / 1000, channel, row);
    }
    Answer answer;
    while (loop->answer(answer)) {
      if (answer.refusal != Refusal::none) {
        std::printf("%s: %s\n", std::string(name(answer.command.verb)).c_str(),
                    std::string(name(answer.refusal)).c_str());
      }
    }
    // The operator arms once the muscle must be cold, then renews the position command.
    if (tick == 30'000) loop->send({.verb = Verb::arm});
    if (tick > 31'000 && tick % 50 == 0)
      loop->send({.verb = Verb::position, .value = 0.010 - 0.005 * std::cos(0.5e-3 * tick)});
  }
  return channel.state().state() == State::active ? 0 : 1;
}
