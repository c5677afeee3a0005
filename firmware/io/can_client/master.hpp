// The frames of a master that commands one node, and what the node's answers mean (docs/can.md).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "supercoil/hal/can_bus.hpp"

#include "loop/command.hpp"
#include "loop/playback.hpp"
#include "loop/tuner.hpp"

namespace supercoil::can_client {

/// Of the frames by which a node answers its masters.
std::uint16_t acknowledge_id(std::uint8_t node);
std::uint16_t setting_id(std::uint8_t node);
/// What a node sends after an answer that refuses a value.
std::uint16_t refused_value_id(std::uint8_t node);
/// Of its heartbeat.
std::uint16_t status_id(std::uint8_t node);
/// Of what it has learned.
std::uint16_t estimate_id(std::uint8_t node);

/// Of the values that the node would have obeyed the nearest to the refused one, NaN where there is
/// none. Empty: the frame is not about a refused value.
std::optional<double> receive_nearest(std::uint8_t node, const hal::CanFrame& frame);

/// Asks for one setting of a node; needs no lease.
hal::CanFrame setting_read(std::uint8_t node, std::uint8_t setting);

/// Asks for one quantity of a node's muscle, a place in known_quantities; needs no lease.
hal::CanFrame muscle_read(std::uint8_t node, std::uint8_t quantity);
std::uint16_t muscle_id(std::uint8_t node);
/// NaN: not known. Empty: the frame does not answer that.
std::optional<double> receive_muscle(std::uint8_t node, std::uint8_t quantity,
                                     const hal::CanFrame& frame);
/// Of all that a node answers when it is commanded or asked.
std::vector<std::uint16_t> answer_ids(std::uint8_t node);
/// One value of a node's controller or estimator.
struct TunedPlace {
  std::uint8_t place;    ///< as Tuner counts
  std::uint8_t tunable;  ///< place in control::tunables()
  TuningSet set;
};
struct TunedValue {
  Refusal refusal;
  double value;          ///< that holds now; NaN: none
  std::uint8_t counter;  ///< of the write; 0: of a read
};
/// Asks for it; needs no lease.
hal::CanFrame tuning_read(std::uint8_t node, const TunedPlace& place);
std::uint16_t tuning_id(std::uint8_t node);
/// Empty: no intact answer about it.
std::optional<TunedValue> receive_tuning(std::uint8_t node, const TunedPlace& place,
                                         const hal::CanFrame& frame);
/// Of identify and calibrate, 0 to 1, from the heartbeat. Empty: the frame does not tell.
std::optional<double> receive_progress(std::uint8_t node, const hal::CanFrame& frame);
/// Of its position and resistance.
std::uint16_t measurement_id(std::uint8_t node);
/// NaN: no fresh reading. Empty: the frame does not tell.
std::optional<double> receive_position_m(std::uint8_t node, const hal::CanFrame& frame);
/// Of what it follows, and how closely.
std::uint16_t tracking_id(std::uint8_t node);
/// Position less reference model; NaN: it follows none. Empty: the frame does not tell.
std::optional<double> receive_error_m(std::uint8_t node, const hal::CanFrame& frame);

/// What a node tells of its trajectory.
struct Played {
  Refusal refusal;
  PlaybackState state;
  std::uint8_t room;  ///< for so many knots more
  double buffered_s;
};
std::uint16_t trajectory_id(std::uint8_t node);
/// For all nodes of the bus; needs no lease.
hal::CanFrame sync(std::uint8_t number, double master_time_s);

/// Neither sends nor receives.
class Master {
 public:
  /// name: any number by which this master knows the answer to its claim; of its own, so that two
  /// masters do not take each other's.
  Master(std::uint8_t node, std::uint16_t name) : node_(node), name_(name) {}

  std::uint8_t node() const { return node_; }
  bool holds_lease() const { return session_ != 0; }

  /// Asks for the lease, or keeps the one that this master has. After the answer claim_again it is
  /// asked for once more, with what that answer told.
  hal::CanFrame claim();
  hal::CanFrame release();
  /// Under the lease; without one only disarm is obeyed.
  hal::CanFrame command(Verb verb, double value);
  /// Under the lease.
  hal::CanFrame setting_write(std::uint8_t setting, double value);

  /// Under the lease: prepares a value.
  hal::CanFrame tuning_write(const TunedPlace& place, double value);
  /// Empty: no intact answer to this master's last write.
  std::optional<TunedValue> receive_tuning(const TunedPlace& place, const hal::CanFrame& frame);

  /// Under the lease: the next knot, so long after the one before it.
  hal::CanFrame knot(double after_s, double position_m, double velocity_m_per_s);
  /// Under the lease: starts the trajectory so long after the board has received this.
  hal::CanFrame play_at_once(double after_s);
  /// Under the lease: starts the trajectory so long after a Sync.
  hal::CanFrame play_at_sync(std::uint8_t sync, double after_s);
  /// Under the lease: asks what becomes of it.
  hal::CanFrame play_never();
  /// Empty: no intact answer to this master's last frame.
  std::optional<Played> receive_played(const hal::CanFrame& frame);

  struct Setting {
    std::uint8_t setting;
    Refusal refusal;
    double value;  ///< that holds now; NaN: none
  };
  /// Empty: no intact answer to this master's last write, or to anybody's read.
  std::optional<Setting> receive_setting(const hal::CanFrame& frame, bool of_write);

  struct Heard {
    std::uint8_t opcode;  ///< of what was answered
    Refusal refusal;
  };
  /// Empty: no intact answer to this master's last frame. A lease that was granted, released or
  /// refused is known from then on.
  std::optional<Heard> hear(const hal::CanFrame& frame);

 private:
  hal::CanFrame frame(std::uint8_t opcode, double value);
  hal::CanFrame play(double when, std::uint8_t sync, double after_s);
  std::uint8_t next_counter();
  void receive_lease(Refusal refusal, std::uint16_t granted);

  std::uint8_t node_;
  std::uint16_t name_;
  std::uint16_t nonce_ = 0;  ///< that the next claim must repeat; 0: none was received
  bool releasing_ = false;   ///< the last frame gave the lease back
  std::uint16_t session_ = 0;
  std::uint16_t asked_as_ = 0;  ///< what the last frame carried as its session
  std::uint8_t counter_ = 0;    ///< of the last frame
};

}  // namespace supercoil::can_client
