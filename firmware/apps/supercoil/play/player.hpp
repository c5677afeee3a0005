// Plays motions on nodes of a bus, or on channels of this board, all in step.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "supercoil/hal/error.hpp"

#include "apps/supercoil/play/motion_file.hpp"
#include "apps/supercoil/play/motion_link.hpp"

namespace supercoil::operating {

/// Each step waits for the nodes' answers alone; one is to be called every 20 ms or so, as commands
/// to heat expire. Errors name the node, or the channel, and what it was asked.
class Player {
 public:
  using Problem = std::optional<std::string>;

  /// bus: by its name.
  static Result<Player> open(const std::string& bus, std::vector<Motion> motions);
  /// Of the supercoild that listens at this socket; a motion's node is the channel.
  static Result<Player> open_local(const std::string& socket, std::vector<Motion> motions);

  /// Tells all to go to their first knot.
  Problem go_to_start();
  /// Renews what is commanded.
  Problem renew();
  /// Sends knots for which there is room; loaded(): no more have any.
  Problem load();
  bool loaded() const;
  /// All start together: at the Sync that this sends, or at a time of the board.
  Problem start();
  /// As load() and renew(), with a Sync a second.
  Problem go_on();
  /// All hold their last knot.
  bool ended() const;
  /// 0 to 1.
  double progress() const;
  /// Lets go of all; what heats expires anyway.
  void rest();

 private:
  using Clock = std::chrono::steady_clock;
  struct Node {
    std::unique_ptr<MotionLink> link;
    Motion motion;
    std::size_t next = 0;  ///< of its knots
    can_client::Played played{};
    Clock::time_point renewed{};

    bool has_sent_all() const { return next == motion.knots.size(); }
  };

  explicit Player(std::string_view kind);
  /// "node 5: "
  std::string whose(const Node& node) const;
  /// verb: what was asked; none: no command.
  Problem take(Node& node, Verb verb, const std::string& what, const MotionLink::Played& played);
  /// Each on a thread of its own, as each has a connection of its own. The first
  /// problem in the order of the nodes.
  Problem for_each_at_once(Problem (Player::*step)(Node&));
  Problem renew(Node& node);
  Problem load(Node& node);
  /// Of what ends a motion early, by what the node told last.
  Problem stopped(const Node& node) const;
  void send_sync();

  std::string kind_;  ///< "node" or "channel"
  std::vector<Node> nodes_;
  std::uint8_t sync_ = 0;
  Clock::time_point synced_{};
  Clock::time_point started_ = Clock::time_point::max();
};

}  // namespace supercoil::operating
