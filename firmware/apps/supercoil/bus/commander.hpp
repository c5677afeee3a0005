// Sends commands to one node and waits for each answer.
#pragma once

#include <chrono>
#include <functional>
#include <memory>

#include "supercoil/hal/can_bus.hpp"
#include "supercoil/hal/error.hpp"

#include "can_client/master.hpp"
#include "loop/known_muscle.hpp"

namespace supercoil::operating {

/// Used by one thread. It owns the bus: frames that are not its answers are dropped.
class Commander {
 public:
  Commander(std::unique_ptr<hal::CanBus> bus, std::uint8_t node);

  /// Waits at most half a second for the answer; meanwhile repeats renewals, positions, powers and
  /// disarms. Claims the lease when it has run out, except for a disarm. The error says that there
  /// was no answer, or that the bus is gone.
  Result<Refusal> ask(Verb verb, double value);
  /// After an answer out_of_range: the nearest value that the board would have obeyed. NaN: none
  /// exists, or the board does not report it.
  double nearest();
  using Setting = Result<can_client::Master::Setting>;
  /// Like ask(); reading needs no lease.
  Setting read(std::uint8_t setting);
  Setting write(std::uint8_t setting, double value);
  /// Like ask(), for a controller's values.
  using Tuned = Result<can_client::TunedValue>;
  Tuned read_tuning(const can_client::TunedPlace& place);
  Tuned prepare(const can_client::TunedPlace& place, double value);
  /// Like ask(), for the node's trajectory.
  using Played = Result<can_client::Played>;
  Played add_knot(double after_s, const control::Knot& knot);
  Played start_at_once(double after_s);
  Played start_at_sync(std::uint8_t sync, double after_s);
  Played playback();
  /// To all nodes of the bus.
  hal::Status send_sync(std::uint8_t number, double master_time_s);
  /// The muscle that the node uses. Needs no lease.
  Result<KnownMuscle> muscle();
  /// Gives the lease back, if there is one.
  void release();
  /// Drops frames that have arrived. Call it every 100 ms or so when nothing is asked.
  void drain();

 private:
  using Clock = std::chrono::steady_clock;
  using Answer = Result<Refusal>;

  /// Waits until parse(frame) returns the content of an answer.
  template <class Content>
  Result<Content> exchange(const hal::CanFrame& frame,
                           const std::function<std::optional<Content>(const hal::CanFrame&)>& parse,
                           std::chrono::milliseconds timeout);
  Answer exchange(const hal::CanFrame& frame, std::chrono::milliseconds timeout);
  /// frame(): builds a new frame for each attempt.
  Played play(const std::function<hal::CanFrame()>& frame);
  /// Reading changes nothing, so it is repeated once when the request or its answer was lost.
  template <class Content>
  Result<Content> read_value(
      const hal::CanFrame& frame,
      const std::function<std::optional<Content>(const hal::CanFrame&)>& parse);
  /// Refusal::none: the lease is held.
  Answer claim();
  Answer command(Verb verb, double value);
  /// Asks under the lease, and retries once where that can help.
  template <class Attempt>
  auto retry_under_lease(const Attempt& attempt);

  std::unique_ptr<hal::CanBus> bus_;
  can_client::Master master_;
  Clock::time_point lease_from_{};
};

}  // namespace supercoil::operating
