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

/// Each step waits only for the nodes' answers. Call one every 20 ms or so, because commands to
/// heat expire. Errors name the node or channel, and the request.
class Player {
 public:
  using Problem = std::optional<std::string>;

  /// bus: by its name.
  static Result<Player> open(const std::string& bus, std::vector<Motion> motions);
  /// On the supercoild that listens at this socket; a motion's node is the channel.
  static Result<Player> open_local(const std::string& socket, std::vector<Motion> motions);

  /// Tells all nodes to go to their first knots.
  Problem go_to_start();
  /// Renews the commands.
  Problem renew();
  /// Sends knots to nodes that have room; loaded(): no node has room left.
  Problem load();
  bool loaded() const;
  /// Starts all together: at the Sync that this sends, or at a time of the board.
  Problem start();
  /// Like load() and renew(), and sends a Sync every second.
  Problem continue_playing();
  /// Whether all nodes hold their last knots.
  bool ended() const;
  /// 0 to 1.
  double progress() const;
  /// Releases all nodes; commands to heat expire anyway.
  void rest();

 private:
  using Clock = std::chrono::steady_clock;
  struct Node {
    std::unique_ptr<MotionLink> link;
    Motion motion;
    std::size_t next = 0;  ///< index of the next knot to send
    can_client::Played played{};
    Clock::time_point renewed{};

    bool has_sent_all() const { return next == motion.knots.size(); }
  };

  explicit Player(std::string_view kind);
  /// Prefix for errors: "node 5: ".
  std::string prefix_of(const Node& node) const;
  /// verb: the command that was sent; none: not a command.
  Problem take(Node& node, Verb verb, const std::string& what, const MotionLink::Played& played);
  /// Runs the step for each node on its own thread, as each has its own connection. Returns the
  /// first problem in the order of the nodes.
  Problem run_in_parallel(Problem (Player::*step)(Node&));
  Problem renew(Node& node);
  Problem load(Node& node);
  /// The problem that ended a motion early, by the node's last answer.
  Problem stopped(const Node& node) const;
  void send_sync();

  std::string kind_;  ///< "node" or "channel"
  std::vector<Node> nodes_;
  std::uint8_t sync_ = 0;
  Clock::time_point synced_{};
  Clock::time_point started_ = Clock::time_point::max();
};

}  // namespace supercoil::operating
