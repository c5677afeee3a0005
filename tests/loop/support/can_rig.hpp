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
    bus.listener = [this](const hal::CanFrame& frame) { hear(frame); };
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
  Refusal command(Master& who, std::uint8_t opcode, float value = 0.0F) {
    answers.clear();
    bus.deliver(who.frame(opcode, value));
    for (int i = 0; i < 20 && answers.empty(); ++i)
      tick();
    return answers.empty() ? Refusal::no_such_channel
                           : static_cast<Refusal>(answers.back().refusal);
  }
  Refusal command(Master& who, Verb verb, float value = 0.0F) {
    return command(who, static_cast<std::uint8_t>(verb), value);
  }
  /// The board's answer to a frame about settings; all zero: none.
  supercoil_setting_t ask_setting(const hal::CanFrame& frame) {
    settings_told.clear();
    bus.deliver(frame);
    for (int i = 0; i < 20 && settings_told.empty(); ++i)
      tick();
    return settings_told.empty() ? supercoil_setting_t{} : settings_told.back();
  }
  /// NaN: not known, or not answered.
  double muscle(std::uint8_t quantity) {
    last_of.erase(SUPERCOIL_MUSCLE_FRAME_ID);
    bus.deliver({SUPERCOIL_MUSCLE_READ_FRAME_ID, 1, {quantity}, {}});
    for (int i = 0; i < 20 && !last_of.contains(SUPERCOIL_MUSCLE_FRAME_ID); ++i)
      tick();
    supercoil_muscle_t told{};
    const hal::CanFrame& frame = last_of[SUPERCOIL_MUSCLE_FRAME_ID];
    supercoil_muscle_unpack(&told, frame.data.data(), frame.length);
    return told.quantity == quantity ? static_cast<double>(told.value) : NAN;
  }
  Refusal claim(Master& who) {
    who.session = who.name;
    Refusal refusal = command(who, telemetry::Opcode::lease, telemetry::claim_value);
    if (refusal == Refusal::claim_again)
      refusal = command(who, telemetry::Opcode::lease, static_cast<float>(answers.back().granted));
    if (!answers.empty()) who.session = answers.back().granted;
    return refusal;
  }
  /// Booted, cool, claimed, armed, and at a position.
  void start(Master& who) {
    run(16.0);
    claim(who);
    command(who, Verb::arm);
    run(0.2);
    command(who, Verb::position, 0.012F);
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
  std::vector<supercoil_setting_t> settings_told;
  std::vector<supercoil_refused_value_t> refused_values;
  std::vector<hal::CanFrame> emergencies;
  std::vector<hal::CanFrame> first_causes;
  std::vector<hal::CanFrame> trajectories;  ///< of either channel
  long heard = 0;
  std::map<std::uint16_t, int> heard_of;  ///< by identifier
  std::map<std::uint16_t, hal::CanFrame> last_of;

 private:
  void hear(const hal::CanFrame& frame) {
    ++heard;
    ++heard_of[frame.id];
    last_of[frame.id] = frame;
    if (frame.id == SUPERCOIL_TRAJECTORY_FRAME_ID || frame.id == SUPERCOIL_TRAJECTORY_FRAME_ID + 1)
      trajectories.push_back(frame);
    if (frame.id == SUPERCOIL_SETTING_FRAME_ID) settings_told.push_back(read_setting(frame));
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
