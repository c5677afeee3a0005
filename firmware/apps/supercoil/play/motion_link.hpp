// Commands one muscle to play a motion: over a bus, or through this board's socket.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "supercoil/hal/error.hpp"

#include "apps/supercoil/board_socket.hpp"
#include "apps/supercoil/bus/commander.hpp"

namespace supercoil::operating {

/// Each call waits for the answer. The error says that there was no answer, or quotes a reply of
/// the board that is not an answer to a command.
class MotionLink {
 public:
  MotionLink() = default;
  MotionLink(const MotionLink&) = delete;
  MotionLink& operator=(const MotionLink&) = delete;
  virtual ~MotionLink() = default;

  using Answered = Result<Reply>;
  using Played = Commander::Played;

  /// position, renew, rest.
  virtual Answered ask(Verb verb, double value) = 0;
  virtual Played add_knot(double after_s, const control::Knot& knot) = 0;
  virtual Played playback() = 0;
  /// Common to all nodes that start together.
  struct Start {
    std::uint8_t sync;  ///< number of a Sync that is still to be sent
    double after_s;     ///< after that, or after board_s
    double board_s;     ///< of one channel, for all
  };
  virtual Played start(const Start& start) = 0;
  /// The board's time if it has one that all its channels share; else NaN.
  virtual Result<double> board_s() = 0;
  virtual void send_sync(std::uint8_t number, double master_time_s) = 0;
  /// Why a node that was told to start has not started.
  virtual std::string why_not_started() const = 0;
  virtual void release() = 0;
};

class CanMotionLink final : public MotionLink {
 public:
  explicit CanMotionLink(Commander commander) : commander_(std::move(commander)) {}
  Answered ask(Verb verb, double value) override;
  Played add_knot(double after_s, const control::Knot& knot) override;
  Played playback() override { return commander_.playback(); }
  Played start(const Start& start) override;
  Result<double> board_s() override { return NAN; }
  void send_sync(std::uint8_t number, double master_time_s) override;
  std::string why_not_started() const override { return "no Sync arrived, or too late"; }
  void release() override { commander_.release(); }

 private:
  Commander commander_;
};

/// The board's own clock suffices to start its channels together.
class LocalMotionLink final : public MotionLink {
 public:
  /// channel: from 1.
  LocalMotionLink(BoardSocket socket, int channel)
      : socket_(std::move(socket)), channel_(std::to_string(channel)) {}
  Answered ask(Verb verb, double value) override;
  Played add_knot(double after_s, const control::Knot& knot) override;
  Played playback() override;
  Played start(const Start& start) override;
  Result<double> board_s() override;
  void send_sync(std::uint8_t /*number*/, double /*master_time_s*/) override {}
  std::string why_not_started() const override { return "the board's clock is not advancing"; }
  void release() override {}

 private:
  struct Status {
    can_client::Played played;
    double board_s;
  };
  Result<Status> read_status();
  Answered command(const std::string& words);
  /// Sends the command, then reads the state of the trajectory.
  Played command_then_status(const std::string& words);

  BoardSocket socket_;
  std::string channel_;
};

}  // namespace supercoil::operating
