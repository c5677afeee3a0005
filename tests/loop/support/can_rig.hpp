// The rough board on a CAN bus, and a master that commands it there.
#pragma once

#include <map>
#include <random>
#include <utility>
#include <vector>

#include "loop/support/rig.hpp"
#include "simulated_board/simulated_can_bus.hpp"
#include "telemetry/can_endpoint.hpp"
#include "unit/firmware/io/telemetry/support/master.hpp"

namespace supercoil::test {

class CanRig {
 public:
  explicit CanRig(RigSettings rig_settings = rough_board())
      : settings(std::move(rig_settings)),
        board(settings.board),
        loop(settings.firmware, board.devices()),
        executive(loop, board, settings.firmware.rate_Hz),
        bus(board, can.bit_rate),
        link(can, settings.firmware, loop, bus, std::mt19937(1)) {
    bus.listener = [this](const hal::CanFrame& frame) { receive(frame); };
  }
  CanRig(const CanRig&) = delete;
  CanRig& operator=(const CanRig&) = delete;

  /// One tick, including the work of other threads.
  void tick() {
    executive.run_tick();
    loop.health().telemetry_heartbeats.store(++beats_);
    for (Row row; loop.take(row);)
      link.offer(row);
    for (Answer answer; loop.answer(answer);)
      link.answer(answer);
    link.poll(board.now());
  }
  void run(double time_s) {
    for (long i = std::lround(time_s * settings.firmware.rate_Hz); i > 0; --i)
      tick();
  }
  /// Sends a command and waits for its answer.
  Refusal command(Master& sender, std::uint8_t opcode, float value = 0.0F) {
    answers.clear();
    bus.deliver(sender.frame(opcode, value));
    for (int i = 0; i < 20 && answers.empty(); ++i)
      tick();
    return answers.empty() ? Refusal::no_such_channel
                           : static_cast<Refusal>(answers.back().refusal);
  }
  Refusal command(Master& sender, Verb verb, float value = 0.0F) {
    return command(sender, static_cast<std::uint8_t>(verb), value);
  }
  /// The board's answer to a frame about settings; all zero: none.
  supercoil_setting_t request_setting(const hal::CanFrame& frame) {
    setting_answers.clear();
    bus.deliver(frame);
    for (int i = 0; i < 20 && setting_answers.empty(); ++i)
      tick();
    return setting_answers.empty() ? supercoil_setting_t{} : setting_answers.back();
  }
  /// NaN: not known, or not answered.
  double muscle(std::uint8_t quantity) {
    last_of.erase(SUPERCOIL_MUSCLE_FRAME_ID);
    bus.deliver({SUPERCOIL_MUSCLE_READ_FRAME_ID, 1, {quantity}, {}});
    for (int i = 0; i < 20 && !last_of.contains(SUPERCOIL_MUSCLE_FRAME_ID); ++i)
      tick();
    supercoil_muscle_t received{};
    const hal::CanFrame& frame = last_of[SUPERCOIL_MUSCLE_FRAME_ID];
    supercoil_muscle_unpack(&received, frame.data.data(), frame.length);
    return received.quantity == quantity ? static_cast<double>(received.value) : NAN;
  }
  Refusal claim(Master& sender) {
    sender.session = sender.name;
    Refusal refusal = command(sender, telemetry::Opcode::lease, telemetry::claim_value);
    if (refusal == Refusal::claim_again) {
      refusal =
          command(sender, telemetry::Opcode::lease, static_cast<float>(answers.back().granted));
    }
    if (!answers.empty()) sender.session = answers.back().granted;
    return refusal;
  }
  /// Booted, cool, claimed, armed, and at a position.
  void start(Master& sender) {
    run(16.0);
    claim(sender);
    command(sender, Verb::arm);
    run(0.2);
    command(sender, Verb::position, 0.012F);
  }

  State state() const { return loop.channel(0).state().state(); }
  Fault fault() const { return loop.channel(0).state().first_cause(); }
  double true_power_W() const { return board.channel(0).true_power_W(); }

  RigSettings settings;
  telemetry::CanSettings can;
  host_sim::SimulatedBoard board;
  Loop loop;
  Executive executive;
  host_sim::SimulatedCanBus bus;
  telemetry::CanEndpoint link;
  std::vector<supercoil_acknowledge_t> answers;
  std::vector<supercoil_setting_t> setting_answers;
  std::vector<supercoil_refused_value_t> refused_values;
  std::vector<hal::CanFrame> emergencies;
  std::vector<hal::CanFrame> first_causes;
  std::vector<hal::CanFrame> trajectories;  ///< of either channel
  long received_frames = 0;
  std::map<std::uint16_t, int> received_count;  ///< by identifier
  std::map<std::uint16_t, hal::CanFrame> last_of;

 private:
  void receive(const hal::CanFrame& frame) {
    ++received_frames;
    ++received_count[frame.id];
    last_of[frame.id] = frame;
    if (frame.id == SUPERCOIL_TRAJECTORY_FRAME_ID || frame.id == SUPERCOIL_TRAJECTORY_FRAME_ID + 1)
      trajectories.push_back(frame);
    if (frame.id == SUPERCOIL_SETTING_FRAME_ID) setting_answers.push_back(read_setting(frame));
    // Of either channel.
    if (frame.id == SUPERCOIL_ACKNOWLEDGE_FRAME_ID ||
        frame.id == SUPERCOIL_ACKNOWLEDGE_FRAME_ID + 1)
      answers.push_back(read_answer(frame));
    if (frame.id == SUPERCOIL_REFUSED_VALUE_FRAME_ID)
      refused_values.push_back(read_refused_value(frame));
    if (frame.id == SUPERCOIL_EMERGENCY_FRAME_ID) emergencies.push_back(frame);
    if (frame.id == SUPERCOIL_FIRST_CAUSE_FRAME_ID) first_causes.push_back(frame);
  }

  std::uint32_t beats_ = 0;
};

}  // namespace supercoil::test
