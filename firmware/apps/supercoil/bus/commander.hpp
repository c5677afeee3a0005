// Commands to one node, each until it is answered.
#pragma once

#include <chrono>
#include <functional>
#include <memory>

#include "supercoil/hal/can_bus.hpp"
#include "supercoil/hal/error.hpp"

#include "can_client/master.hpp"
#include "loop/known_muscle.hpp"

namespace supercoil::operating {

/// Of one thread. The bus is its own: what else is heard there is passed over.
class Commander {
 public:
  Commander(std::unique_ptr<hal::CanBus> bus, std::uint8_t node);

  /// Waits at most half a second for the answer, and meanwhile sends again what renews. Claims the
  /// lease when it has run out. The error says that there was no answer, or that the bus is gone.
  Result<Refusal> ask(Verb verb, double value);
  /// After an answer out_of_range: the nearest value that would have been obeyed. NaN: there is
  /// none, or the board does not say.
  double nearest();
  using Setting = Result<can_client::Master::Setting>;
  /// Likewise; reading needs no lease.
  Setting read(std::uint8_t setting);
  Setting write(std::uint8_t setting, double value);
  /// Likewise, of a controller's values.
  using Tuned = Result<can_client::TunedValue>;
  Tuned read_tuning(const can_client::TunedPlace& place);
  Tuned prepare(const can_client::TunedPlace& place, double value);
  /// Likewise, of its trajectory.
  using Played = Result<can_client::Played>;
  Played add_knot(double after_s, const control::Knot& knot);
  Played start_at_once(double after_s);
  Played start_at_sync(std::uint8_t sync, double after_s);
  Played playback();
  /// To all nodes of the bus.
  hal::Status send_sync(std::uint8_t number, double master_time_s);
  /// Whatever the node goes by. Needs no lease.
  Result<KnownMuscle> muscle();
  /// Gives the lease back, if there is one.
  void release();
  /// Passes over what came meanwhile; to be called every 100 ms or so when nothing is asked.
  void drain();

 private:
  using Clock = std::chrono::steady_clock;
  using Answer = Result<Refusal>;

  /// Until hear(frame) gives what an answer says.
  template <class Heard>
  Result<Heard> exchange(const hal::CanFrame& frame,
                         const std::function<std::optional<Heard>(const hal::CanFrame&)>& hear,
                         std::chrono::milliseconds within);
  Answer exchange(const hal::CanFrame& frame, std::chrono::milliseconds within);
  /// frame(): made anew for each try.
  Played play(const std::function<hal::CanFrame()>& frame);
  /// A question that changes nothing is asked once more when it, or its answer, was lost.
  template <class Heard>
  Result<Heard> read_value(const hal::CanFrame& frame,
                           const std::function<std::optional<Heard>(const hal::CanFrame&)>& hear);
  /// Refusal::none: the lease is held.
  Answer claim();
  Answer command(Verb verb, double value);
  /// Asks under the lease, and once more where that can help.
  template <class Once>
  auto insist(const Once& once);

  std::unique_ptr<hal::CanBus> bus_;
  can_client::Master master_;
  Clock::time_point lease_from_{};
};

}  // namespace supercoil::operating
