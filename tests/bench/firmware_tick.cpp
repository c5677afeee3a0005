// One tick of the whole firmware over devices that cost nothing: all detectors, estimator,
// controller, limiter, power stage, snapshot and recorder row.
#include <deque>

#include <benchmark/benchmark.h>

#include "loop/loop.hpp"

namespace {

using namespace supercoil;

struct IdleClock final : hal::Clock {
  hal::Time now() const override { return time; }
  hal::Time wait_until(hal::Time wake) override { return time = wake; }
  hal::Time time{};
};
struct Input final : hal::AdcChannel {
  hal::Sample latest() override { return {counts, clock->time, hal::Status::ok}; }
  const IdleClock* clock = nullptr;
  std::int32_t counts = 0;
};
struct Pwm final : hal::PwmOutput {
  hal::Status set(int step) override {
    last = step;
    return hal::Status::ok;
  }
  int read_back() const override { return last; }
  int steps() const override { return 4095; }
  int last = 0;
};
struct Line final : hal::DigitalOutput {
  hal::Status set(bool) override { return hal::Status::ok; }
};
struct Closed final : hal::DigitalInput {
  hal::Level read() override { return {true, hal::Status::ok}; }
};

/// A board whose muscles answer like 10 Ω and follow their reference by magic: what counts here is
/// that every stage runs.
class Bench {
 public:
  /// joint: the first two channels are one.
  Bench(std::size_t channels, const control::ControllerSettings& controller,
        const control::EstimatorSettings& estimator, bool joint = false)
      : joint_(joint) {
    BoardSettings settings;
    settings.supply.scaling.per_count = 1e-3;
    settings.channels.resize(channels);
    for (ChannelSettings& channel : settings.channels) {
      channel.position.scaling.per_count = 1e-6;
      channel.heater.current.scaling.per_count = 1e-6;
      channel.controllers = {controller};
      channel.estimators = {estimator};
      channel.supervision.frozen_s = INFINITY;
      channel.supervision.responding_ratio = 0.0;
      // It is asked to prove that it answers, but what it expects is never enough for a fault.
      channel.muscle_identified = true;
      channel.supervision.responding_min_m = INFINITY;
      channel.supervision.stuck_on_s = INFINITY;
      channel.supervision.open_s = INFINITY;
      channel.supervision.saturated_s = INFINITY;
    }
    if (joint) add_joint(settings, {0, 1, control::Lever(0.015), 0.5});
    board::Devices devices{&clock_, &supply_, &heartbeat_, &stop_, nullptr, nullptr, {}};
    supply_.clock = &clock_;
    supply_.counts = 12000;
    for (std::size_t i = 0; i < channels; ++i) {
      Input& position = inputs_.emplace_back();
      Input& current = inputs_.emplace_back();
      position.clock = current.clock = &clock_;
      devices.channels.push_back({&pwms_.emplace_back(), &heartbeat_, &position, &current});
    }
    loop_.emplace(settings, devices);
    for (int i = 0; i < 4000; ++i)
      tick(Verb::none);
    powered_ = true;  // the self-test must see no current
    tick(Verb::arm);
    for (int i = 0; i < 200; ++i)
      tick(Verb::none);
  }

  void tick(Verb verb) {
    clock_.time += std::chrono::milliseconds(1);
    for (std::size_t i = 0; i < pwms_.size(); ++i) {
      inputs_[2 * i].counts = 5000 + static_cast<int>(clock_.time.count() / 1000000 % 64);
      inputs_[2 * i + 1].counts = powered_ ? static_cast<int>(1.2e6 * pwms_[i].last / 4095) : 0;
      const bool led = joint_ && i == 1;
      if (verb != Verb::none && !led)
        loop_->send({static_cast<std::uint8_t>(i), verb, verb == Verb::position ? 0.005 : 0.0});
    }
    loop_->health().telemetry_heartbeats.store(++beats_, std::memory_order_relaxed);
    loop_->tick(clock_.time, clock_.time, 0);
    Row row;
    while (loop_->take(row)) {
    }
    Answer answer;
    while (loop_->answer(answer)) {
    }
  }
  bool active() const { return loop_->channel(0).state().state() == State::active; }
  Fault fault() const { return loop_->channel(0).state().first_cause(); }

 private:
  bool joint_;
  bool powered_ = false;
  std::uint32_t beats_ = 0;
  IdleClock clock_;
  Input supply_;
  Line heartbeat_;
  Closed stop_;
  std::deque<Input> inputs_;
  std::deque<Pwm> pwms_;
  std::optional<Loop> loop_;
};

/// The budget: 300 ns a channel, also of one alone.
void firmware_tick(benchmark::State& state, const control::ControllerSettings& controller,
                   const control::EstimatorSettings& estimator) {
  const auto channels = static_cast<std::size_t>(state.range(0));
  Bench bench(channels, controller, estimator);
  for (auto _ : state)
    bench.tick(Verb::position);
  if (!bench.active()) {
    state.SkipWithError(std::string(name(bench.fault())).c_str());
    return;
  }
  state.counters["per_channel"] = benchmark::Counter(
      static_cast<double>(channels),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// Beside firmware_tick/learned_ff/1 in the same run: at most 1.7 times that.
void joint_tick(benchmark::State& state, const control::ControllerSettings& controller,
                const control::EstimatorSettings& estimator) {
  Bench bench(2, controller, estimator, true);
  for (auto _ : state)
    bench.tick(Verb::position);
  if (!bench.active()) state.SkipWithError(std::string(name(bench.fault())).c_str());
}

control::ControllerSettings learned() {
  control::ControllerSettings settings;
  settings.kind = control::ControllerKind::learned_ff;
  return settings;
}
control::ControllerSettings shaped(control::ControllerKind kind) {
  control::ControllerSettings settings;
  settings.kind = kind;
  settings.shape_reference = true;
  return settings;
}
control::EstimatorSettings least_squares() {
  control::EstimatorSettings settings;
  settings.kind = control::EstimatorKind::least_squares;
  return settings;
}

BENCHMARK_CAPTURE(firmware_tick, mrac_gradient, {}, {})->Arg(1)->Arg(4)->Arg(16);
BENCHMARK_CAPTURE(firmware_tick, learned_ff, learned(), {})->Arg(1);
BENCHMARK_CAPTURE(joint_tick, learned_ff, learned(), {});
BENCHMARK_CAPTURE(joint_tick, mrac_gradient, {}, {});
BENCHMARK_CAPTURE(firmware_tick, adaptive_ff_all, shaped(control::ControllerKind::adaptive_ff),
                  least_squares())
    ->Arg(1)
    ->Arg(4)
    ->Arg(16);
BENCHMARK_CAPTURE(firmware_tick, mrac_ls_all, shaped(control::ControllerKind::mrac_ls),
                  least_squares())
    ->Arg(1)
    ->Arg(4)
    ->Arg(16);

}  // namespace
