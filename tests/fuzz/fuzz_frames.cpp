// Frames from the bus: a frame becomes a command only if its E2E protection is intact and it is
// from the lease holder, or if it is a stop.
#include <bit>
#include <deque>
#include <random>

#include "fuzz/steps.hpp"
#include "telemetry/commands.hpp"

using namespace supercoil;
using fuzz::LeaseModel;
using fuzz::require;

namespace {

struct Intent {
  Verb verb;
  float value;
};

/// For every opcode but the lease's. Opcode 0 is three verbs: kelvins above 1000, amperes below 0,
/// volts between. The controller's opcode is two verbs: a value above 1000 tunes.
Intent intent_of(const supercoil_command_t& sent) {
  const bool tunes = sent.opcode == static_cast<std::uint8_t>(Verb::controller);
  if (tunes && sent.value >= 1000.0F) return {Verb::tune, sent.value - 1000.0F};
  if (sent.opcode != 0) return {static_cast<Verb>(sent.opcode), sent.value};
  if (sent.value >= 1000.0F) return {Verb::compare_rise, sent.value - 1000.0F};
  if (sent.value < 0.0F) return {Verb::compare_current, -sent.value};
  return {Verb::compare_supply, sent.value};
}

void require_right(const telemetry::Commands::Taken& taken, const hal::CanFrame& frame,
                   const LeaseModel& model, hal::Time now) {
  const int channel = LeaseModel::channel_of(frame);
  if (channel < 0) {
    require(!taken.command && !taken.answer && !taken.damaged, "others' frames are left alone");
    return;
  }
  if (!LeaseModel::intact(frame)) {
    require(taken.damaged == channel && !taken.command && !taken.answer,
            "a damaged frame is counted, and nothing else");
    return;
  }
  require(taken.command.has_value() != taken.answer.has_value(),
          "an intact frame is handed on or answered");
  if (!taken.command) return;
  const supercoil_command_t sent = LeaseModel::command_in(frame);
  require(taken.command->channel == channel, "a command is for the channel that was asked");
  const Intent intent = intent_of(sent);
  require(taken.command->verb == intent.verb, "its verb is the frame's");
  require(std::bit_cast<std::uint32_t>(static_cast<float>(taken.command->value)) ==
                  std::bit_cast<std::uint32_t>(intent.value) ||
              std::isnan(sent.value),
          "its value is the frame's");
  require(taken.command->source == Source::can, "its answer goes back to the bus");
  if (LeaseModel::stops(sent)) return;
  require(!taken.damaged, "what breaks the sequence does nothing but stop");
  require(model.from_holder(frame, now), "only the holder of the lease is obeyed");
  require(model.in_sequence(frame), "only what follows the last frame is obeyed");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const telemetry::CanSettings settings;
  telemetry::Leases leases(settings.lease_s, LeaseModel::channels, std::mt19937(1));
  telemetry::Commands commands(settings, leases);
  LeaseModel model(settings.lease_s);
  hal::Time now{};
  std::deque<Command> handed_on;
  fuzz::for_each_step(data, size, [&](const fuzz::Step& step) {
    now += std::chrono::milliseconds(8 * step.wait);
    const hal::CanFrame frame = frame_of(step, model);
    const auto taken = commands.take(frame, now);
    require_right(taken, frame, model, now);
    model.observe(frame, now);
    if (taken.answer) model.observe_answer(*taken.answer, now);
    if (taken.command) handed_on.push_back(*taken.command);
    // The loop answers some commands, now and then loses an answer, and has no room for others.
    if (taken.command && step.wait % 4 == 1) {
      commands.not_taken();
      handed_on.pop_back();
    }
    if (step.wait % 8 == 7 && !handed_on.empty()) handed_on.pop_front();
    if (step.wait % 4 >= 2 && !handed_on.empty()) {
      const auto answer = commands.answered({handed_on.front(), Refusal::none});
      require(answer.has_value(), "what was handed on can be answered");
      model.observe_answer(*answer, now);
      handed_on.pop_front();
    }
  });
  return 0;
}
