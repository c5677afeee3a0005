// The control loop of a board: one tick, read from top to bottom.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include <boost/lockfree/spsc_queue.hpp>

#include "loop/bundle.hpp"
#include "loop/channel.hpp"
#include "loop/joint.hpp"
#include "loop/row.hpp"
#include "loop/self_test.hpp"
#include "supervisor/board_supervisor.hpp"

namespace supercoil {

/// Written by other threads, read by the loop in a tick.
struct Health {
  std::atomic<std::uint32_t> telemetry_heartbeats{0};
  std::atomic<hal::CanState> bus{hal::CanState::active};
  std::atomic<bool> node_conflict{false};
  std::atomic<bool> configuration_changed{false};
};

/// Of one tick.
struct TickTime {
  hal::Duration late{};  ///< by how much it woke after its time
  hal::Duration execution{};
};

/// Timing that the loop reports to one other thread, which takes the maximum by replacing it with
/// `none`.
struct LoopTiming {
  static constexpr std::int64_t none = -1;
  std::atomic<std::int64_t> late_ns{none};       ///< maximum since it was taken
  std::atomic<std::int64_t> execution_ns{none};  ///< likewise, of whole ticks
  std::atomic<std::uint32_t> overruns{0};        ///< periods left out since boot
  std::atomic<std::uint32_t> lost_rows{0};       ///< dropped because the ring was full, since boot

  /// Called in the tick.
  void add(const TickTime& tick, std::int64_t skipped) {
    raise(late_ns, tick.late.count());
    raise(execution_ns, tick.execution.count());
    if (skipped > 0) overruns.fetch_add(static_cast<std::uint32_t>(skipped));
  }

 private:
  static void raise(std::atomic<std::int64_t>& maximum, std::int64_t value) {
    if (value > maximum.load(std::memory_order_relaxed))
      maximum.store(value, std::memory_order_relaxed);
  }
};

/// A stalled disk or a busy CPU may delay the recorder by this much before a row is lost.
inline constexpr double row_ring_s = 1.0;

/// A board's channels, joints and bundles, and their supervision. tick() runs in the real-time
/// thread; commands, answers and rows pass through lock-free rings.
class Loop {
 public:
  /// settings must pass check(); devices outlive the loop, and have as many channels. Allocates;
  /// ticks do not.
  Loop(const BoardSettings& settings, const board::Devices& devices);

  /// One tick that was due at `due` and woke at `woke`, after `skipped` periods were left out.
  void tick(hal::Time due, hal::Time woke, std::int64_t skipped);

  /// From one other thread, the one that uses the channels' tuners. False: the ring is full.
  /// Inline: another copy of the command would cost a wait.
  bool send(const Command& command) {
    return is_tuning(command.verb) ? send_tuning(command) : commands_.push(command);
  }
  /// The next answer, in the thread that sends. False: there is none.
  bool answer(Answer& answer) {
    if (!answers_.pop(answer)) return false;
    if (is_tuning(answer.command.verb)) conclude_tuning(answer);
    return true;
  }
  /// A frame for this channel was damaged; from one other thread, like take().
  bool send_damaged(std::uint8_t channel) { return damaged_.push(channel); }
  /// The next row, one per channel and tick; from one other thread. False: there is none.
  bool take(Row& row) { return rows_.pop(row); }
  Health& health() { return health_; }
  LoopTiming& timing() { return timing_; }

  /// In the loop's thread, or while the loop is stopped.
  std::size_t channels() const { return channels_.size(); }
  /// i: from 0. As channels(), unless the member of Channel that is called says otherwise.
  Channel& channel(std::size_t i) { return *channels_[i]; }
  /// Likewise.
  const Channel& channel(std::size_t i) const { return *channels_[i]; }
  Fault board_fault() const { return board_fault_; }
  const BoardSupervisor& supervisor() const { return supervisor_; }
  const SelfTest& self_test() const { return self_test_; }
  const TickTime& last_tick() const { return last_tick_; }
  std::int64_t overruns() const { return overruns_; }

 private:
  bool send_tuning(Command command);
  void conclude_tuning(const Answer& answer);
  void obey();
  Reply reply_to(const Command& command);
  void measure_air(hal::Time now);
  void judge_board(hal::Time now, double late_s, std::int64_t skipped);
  void latch(Fault cause, const detectors::Margin& margin);
  void reset_board();
  bool may_test() const;
  void run_self_test();
  void toggle_heartbeat();
  void update_light();

  BoardSettings settings_;
  board::Devices devices_;
  std::vector<std::unique_ptr<Channel>> channels_;  ///< not movable
  std::vector<Joint> joints_;
  std::vector<Bundle> bundles_;
  std::vector<Channel*> single_;  ///< channels in no joint or bundle
  BoardSupervisor supervisor_;
  BoardInputs inputs_;
  board::Measured air_;  ///< in °C
  SelfTest self_test_;
  Fault board_fault_ = Fault::none;  ///< latched
  BoardTick now_;
  bool reset_requested_ = false;
  bool reset_requested_before_ = true;
  bool heartbeat_ = false;
  bool lines_ok_ = true;
  int light_ = -1;
  bool blink_ = false;
  std::int64_t blink_ticks_ = 0;
  std::int64_t ticks_ = 0;
  std::int64_t overruns_ = 0;
  TickTime last_tick_;
  std::int64_t settling_ticks_;
  Health health_;
  LoopTiming timing_;
  boost::lockfree::spsc_queue<Command, boost::lockfree::capacity<256>> commands_;
  boost::lockfree::spsc_queue<Answer, boost::lockfree::capacity<256>> answers_;
  boost::lockfree::spsc_queue<std::uint8_t, boost::lockfree::capacity<64>> damaged_;
  boost::lockfree::spsc_queue<Row> rows_;
};

}  // namespace supercoil
