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

/// Identifiers of the frames with which a node answers its masters.
std::uint16_t acknowledge_id(std::uint8_t node);
/// The node's answer to a read or write of a setting.
std::uint16_t setting_id(std::uint8_t node);
/// Sent by a node after an answer that refuses a value.
std::uint16_t refused_value_id(std::uint8_t node);
/// The node's heartbeat.
std::uint16_t status_id(std::uint8_t node);
/// The node's estimates.
std::uint16_t estimate_id(std::uint8_t node);

/// The value nearest to the refused one that the node would have obeyed; NaN: there is none. Empty:
/// the frame is not about a refused value.
std::optional<double> receive_nearest(std::uint8_t node, const hal::CanFrame& frame);

/// Asks for one setting of a node; needs no lease.
hal::CanFrame setting_read(std::uint8_t node, std::uint8_t setting);

/// Asks for one quantity of a node's muscle, a place in known_quantities; needs no lease.
hal::CanFrame muscle_read(std::uint8_t node, std::uint8_t quantity);
/// The node's answer to muscle_read().
std::uint16_t muscle_id(std::uint8_t node);
/// NaN: not known. Empty: the frame does not answer this read.
std::optional<double> receive_muscle(std::uint8_t node, std::uint8_t quantity,
                                     const hal::CanFrame& frame);
/// Identifiers of all answers to commands and reads.
std::vector<std::uint16_t> answer_ids(std::uint8_t node);
/// One value of a node's controller or estimator.
struct TunedPlace {
  std::uint8_t place;    ///< as Tuner counts
  std::uint8_t tunable;  ///< place in control::tunables()
  TuningSet set;
};
/// A node's answer about one value of a controller or estimator.
struct TunedValue {
  Refusal refusal;
  double value;          ///< that holds now; NaN: none
  std::uint8_t counter;  ///< that of the write; 0: answers a read
};
/// Asks for one value; needs no lease.
hal::CanFrame tuning_read(std::uint8_t node, const TunedPlace& place);
/// The node's answer to tuning_read() and tuning_write().
std::uint16_t tuning_id(std::uint8_t node);
/// Empty: the frame is not an intact answer about this value.
std::optional<TunedValue> receive_tuning(std::uint8_t node, const TunedPlace& place,
                                         const hal::CanFrame& frame);
/// Progress of identify and calibrate, 0 to 1, from the heartbeat. Empty: another frame.
std::optional<double> receive_progress(std::uint8_t node, const hal::CanFrame& frame);
/// The node's position and resistance.
std::uint16_t measurement_id(std::uint8_t node);
/// NaN: no fresh reading. Empty: another frame.
std::optional<double> receive_position_m(std::uint8_t node, const hal::CanFrame& frame);
/// The reference that the node follows, and its tracking error.
std::uint16_t tracking_id(std::uint8_t node);
/// Position less reference model; NaN: no reference is followed. Empty: another frame.
std::optional<double> receive_error_m(std::uint8_t node, const hal::CanFrame& frame);

/// What a node reports about its trajectory.
struct Played {
  Refusal refusal;
  PlaybackState state;
  std::uint8_t room;  ///< number of further knots that fit
  double buffered_s;
};
/// The node's answers to knots and starts, and its reports when the state of playback changes.
std::uint16_t trajectory_id(std::uint8_t node);
/// For all nodes of the bus; needs no lease.
hal::CanFrame sync(std::uint8_t number, double master_time_s);

/// Builds frames and reads answers; does no I/O.
class Master {
 public:
  /// name: any number by which this master recognises the answer to its claim; unique, so that two
  /// masters do not take each other's answers.
  Master(std::uint8_t node, std::uint16_t name) : node_(node), name_(name) {}

  std::uint8_t node() const { return node_; }
  bool holds_lease() const { return session_ != 0; }

  /// Asks for the lease, or keeps the one that this master has. After the answer claim_again, the
  /// next claim repeats the nonce of that answer.
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

  /// Under the lease: the next knot, after_s after the previous one.
  hal::CanFrame knot(double after_s, double position_m, double velocity_m_per_s);
  /// Under the lease: starts the trajectory after_s after the board has received this.
  hal::CanFrame play_at_once(double after_s);
  /// Under the lease: starts the trajectory after_s after a Sync.
  hal::CanFrame play_at_sync(std::uint8_t sync, double after_s);
  /// Under the lease: asks for the state of the trajectory.
  hal::CanFrame play_never();
  /// Empty: no intact answer to this master's last frame.
  std::optional<Played> receive_played(const hal::CanFrame& frame);

  /// A node's answer about one of its settings.
  struct Setting {
    std::uint8_t setting;
    Refusal refusal;
    double value;  ///< that holds now; NaN: none
  };
  /// Empty: no intact answer to this master's last write, or to anybody's read.
  std::optional<Setting> receive_setting(const hal::CanFrame& frame, bool of_write);

  /// A node's answer to a command, claim or release.
  struct Acknowledged {
    std::uint8_t opcode;  ///< of the answered frame
    Refusal refusal;
  };
  /// Empty: no intact answer to this master's last frame. Also notes whether the lease was granted,
  /// released or refused.
  std::optional<Acknowledged> receive_acknowledge(const hal::CanFrame& frame);

 private:
  hal::CanFrame frame(std::uint8_t opcode, double value);
  hal::CanFrame play(double when, std::uint8_t sync, double after_s);
  std::uint8_t next_counter();
  void receive_lease(Refusal refusal, std::uint16_t granted);

  std::uint8_t node_;
  std::uint16_t name_;
  std::uint16_t nonce_ = 0;  ///< that the next claim must repeat; 0: none was received
  bool releasing_ = false;   ///< the last frame released the lease
  std::uint16_t session_ = 0;
  std::uint16_t sent_session_ = 0;  ///< the session field of the last frame
  std::uint8_t counter_ = 0;        ///< of the last frame
};

}  // namespace supercoil::can_client
