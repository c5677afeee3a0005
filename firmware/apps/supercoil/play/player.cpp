#include "apps/supercoil/play/player.hpp"

#include <algorithm>
#include <cmath>
#include <future>
#include <random>
#include <utility>

#include "apps/supercoil/bus/bus_name.hpp"
#include "text/refusal_words.hpp"

namespace supercoil::operating {

namespace {

using namespace std::chrono_literals;

constexpr auto renewal_period = 80ms;
constexpr auto sync_period = 1s;
/// Knots sent in a row before all commands are renewed.
constexpr int max_knots_at_once = 6;
/// From Play to the start: time to tell each node in turn and to send Sync.
constexpr double start_after_s = 0.1;
/// Over the socket the start time counts from when the first channel was told.
constexpr double start_after_s_per_channel = 0.05;
constexpr auto start_timeout = 2s;

std::string seconds_text(double time_s) {
  std::string text = std::to_string(time_s);
  return text.substr(0, text.find('.') + 4) + " s";
}

}  // namespace

Player::Player(std::string_view kind)
    : kind_(kind), sync_(static_cast<std::uint8_t>(std::random_device()())) {}

Result<Player> Player::open(const std::string& bus, std::vector<Motion> motions) {
  Player player("node");
  for (Motion& motion : motions) {
    auto opened = open_bus(bus, can_client::answer_ids(motion.node));
    if (!opened) return tl::unexpected(opened.error());
    auto link = std::make_unique<CanMotionLink>(Commander(std::move(*opened), motion.node));
    player.nodes_.push_back({std::move(link), std::move(motion)});
  }
  return player;
}

Result<Player> Player::open_local(const std::string& socket, std::vector<Motion> motions) {
  Player player("channel");
  for (Motion& motion : motions) {
    auto opened = BoardSocket::open(socket);
    if (!opened) return tl::unexpected(opened.error());
    auto link = std::make_unique<LocalMotionLink>(std::move(*opened), motion.node);
    player.nodes_.push_back({std::move(link), std::move(motion)});
  }
  return player;
}

std::string Player::prefix_of(const Node& node) const {
  return kind_ + " " + std::to_string(node.motion.node) + ": ";
}

Player::Problem Player::take(Node& node, Verb verb, const std::string& what,
                             const MotionLink::Played& played) {
  if (!played) return prefix_of(node) + what + ": " + played.error().text();
  if (played->refusal != Refusal::none)
    return prefix_of(node) + what + ": " + answer_with_reason(Reply(played->refusal), verb);
  node.played = *played;
  return std::nullopt;
}

Player::Problem Player::go_to_start() {
  for (Node& node : nodes_) {
    const double first_m = node.motion.knots.front().position_m;
    const auto answer = node.link->ask(Verb::position, first_m);
    const std::string what = prefix_of(node) + "position " + std::to_string(first_m) + ": ";
    if (!answer) return what + answer.error().text();
    if (answer->refusal != Refusal::none) return what + answer_with_reason(*answer, Verb::position);
    node.renewed = Clock::now();
  }
  return std::nullopt;
}

Player::Problem Player::renew(Node& node) {
  if (Clock::now() - node.renewed < renewal_period) return std::nullopt;
  node.renewed = Clock::now();
  const auto answer = node.link->ask(Verb::renew, 0.0);
  if (!answer) return prefix_of(node) + answer.error().text();
  if (answer->refusal != Refusal::none) {
    return prefix_of(node) + "the board stopped it (" + answer_with_reason(*answer, Verb::renew) +
           ")";
  }
  return take(node, Verb::none, "playback", node.link->playback());
}

// A board takes some 10 ms per answer: one after the other, two nodes would not get 50 knots a
// second.
Player::Problem Player::run_in_parallel(Problem (Player::*step)(Node&)) {
  std::vector<std::future<Problem>> others;
  for (std::size_t i = 1; i < nodes_.size(); ++i)
    others.push_back(std::async(std::launch::async, step, this, std::ref(nodes_[i])));
  Problem found = (this->*step)(nodes_.front());
  for (auto& other : others) {
    Problem problem = other.get();
    if (!found) found = std::move(problem);
  }
  return found;
}

Player::Problem Player::renew() {
  return run_in_parallel(&Player::renew);
}

Player::Problem Player::load(Node& node) {
  const auto& knots = node.motion.knots;
  for (int i = 0; i < max_knots_at_once && !node.has_sent_all(); ++i) {
    const bool first = node.next == 0;
    if (!first && node.played.room == 0) break;
    const control::Knot& knot = knots[node.next];
    const double after_s = first ? 0.0 : knot.time_s - knots[node.next - 1].time_s;
    const auto played = node.link->add_knot(after_s, knot);
    if (played && played->refusal == Refusal::queue_full) break;
    if (played && !first && played->refusal == Refusal::wrong_state) {
      node.played = *played;
      if (auto problem = stopped(node)) return problem;
    }
    if (auto problem = take(node, Verb::knot, "the knot at " + seconds_text(knot.time_s), played))
      return problem;
    node.renewed = Clock::now();
    ++node.next;
  }
  return std::nullopt;
}

Player::Problem Player::load() {
  if (auto problem = run_in_parallel(&Player::load)) return problem;
  return renew();
}

bool Player::loaded() const {
  return std::ranges::all_of(nodes_, [](const Node& node) {
    return node.has_sent_all() || (node.next > 0 && node.played.room == 0);
  });
}

Player::Problem Player::start() {
  const auto board_s = nodes_.front().link->board_s();
  if (!board_s) return prefix_of(nodes_.front()) + board_s.error().text();
  const bool by_socket = std::isfinite(*board_s);
  const double channels = by_socket ? static_cast<double>(nodes_.size()) : 0.0;
  const MotionLink::Start start{static_cast<std::uint8_t>(sync_ + 1),
                                start_after_s + start_after_s_per_channel * channels, *board_s};
  for (Node& node : nodes_) {
    if (auto problem = take(node, Verb::start, "play", node.link->start(start))) return problem;
  }
  send_sync();
  started_ = synced_;
  return std::nullopt;
}

void Player::send_sync() {
  synced_ = Clock::now();
  ++sync_;
  const double time_s = std::chrono::duration<double>(synced_.time_since_epoch()).count();
  nodes_.front().link->send_sync(sync_, time_s);
}

Player::Problem Player::continue_playing() {
  if (Clock::now() - synced_ >= sync_period) send_sync();
  if (auto problem = load()) return problem;
  for (const Node& node : nodes_) {
    if (auto problem = stopped(node)) return problem;
  }
  return std::nullopt;
}

Player::Problem Player::stopped(const Node& node) const {
  const PlaybackState state = node.played.state;
  // If the last knot it got is at rest, the board considers the motion ended.
  if (state == PlaybackState::dry || (state == PlaybackState::ended && !node.has_sent_all())) {
    const double last_s = node.motion.knots[node.next - 1].time_s;
    return prefix_of(node) + "ran dry: the knot after the one at " + seconds_text(last_s) +
           " came too late";
  }
  if (state == PlaybackState::empty)
    return prefix_of(node) + "received another command in the meantime";
  const bool waits = state == PlaybackState::loaded || state == PlaybackState::waiting;
  if (waits && Clock::now() - started_ > start_timeout)
    return prefix_of(node) + "has not started: " + node.link->why_not_started();
  return std::nullopt;
}

bool Player::ended() const {
  return std::ranges::all_of(nodes_, [](const Node& node) {
    return node.has_sent_all() && node.played.state == PlaybackState::ended;
  });
}

double Player::progress() const {
  const Node& node = nodes_.front();
  const auto& knots = node.motion.knots;
  const double sent_s = node.next == 0 ? 0.0 : knots[node.next - 1].time_s;
  return std::clamp((sent_s - node.played.buffered_s) / knots.back().time_s, 0.0, 1.0);
}

void Player::rest() {
  for (Node& node : nodes_) {
    static_cast<void>(node.link->ask(Verb::rest, 0.0));
    node.link->release();
  }
}

}  // namespace supercoil::operating
