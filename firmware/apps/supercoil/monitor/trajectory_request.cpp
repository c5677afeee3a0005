#include "apps/supercoil/monitor/trajectory_request.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "apps/supercoil/monitor/command_request.hpp"
#include "can/codec.hpp"
#include "can/generated/messages.hpp"

namespace supercoil::operating {

namespace {

using nlohmann::json;

/// The value nearest to an out-of-range one that a knot's frame can carry.
double nearest_sent(can::SignalOf<can::message::knot> signal, double value) {
  hal::CanFrame frame;
  can::put(frame, signal.info(), value);
  return can::get(frame, signal.info());
}

class KnotReader {
 public:
  explicit KnotReader(std::size_t number) : name_("knot " + std::to_string(number)) {}

  Result<ManualControl::NextKnot> read(const json& knot) {
    if (!knot.is_object()) return failure(name_ + " must be an object");
    const ManualControl::NextKnot read{value(knot, "after_s", "after_s"),
                                       value(knot, "position_m", "position_m"),
                                       value(knot, "velocity_m_per_s", "velocity_m_per_s")};
    if (problem_) return failure(*problem_);
    return read;
  }

 private:
  double value(const json& knot, const char* key, can::SignalOf<can::message::knot> signal) {
    constexpr double beyond = std::numeric_limits<double>::infinity();
    const double min_value = nearest_sent(signal, -beyond);
    const double max_value = nearest_sent(signal, beyond);
    const auto given = knot.find(key);
    const bool number = given != knot.end() && given->is_number();
    const double value = number ? given->get<double>() : NAN;
    if (value >= min_value && value <= max_value) return value;
    const std::string given_text = given == knot.end() ? "missing" : given->dump();
    if (!problem_) {
      problem_ = name_ + ": " + key + " is " + given_text + "; it must be " +
                 json(min_value).dump() + " to " + json(max_value).dump();
    }
    return NAN;
  }

  std::string name_;
  std::optional<std::string> problem_;
};

Result<std::vector<ManualControl::NextKnot>> knots_of(const json& given) {
  if (!given.is_array() || given.size() > max_knots_at_once) {
    const std::string given_text =
        given.is_array() ? std::to_string(given.size()) + " knots" : "no list";
    return failure("knots is " + given_text + "; it must be a list of 0 to " +
                   std::to_string(max_knots_at_once));
  }
  std::vector<ManualControl::NextKnot> knots;
  for (const json& one : given) {
    const auto knot = KnotReader(knots.size() + 1).read(one);
    if (!knot) return tl::unexpected(knot.error());
    knots.push_back(*knot);
  }
  return knots;
}

}  // namespace

Result<TrajectoryRequest> parse_trajectory_request(const std::string& text) {
  const auto node = parse_node(text);
  if (!node) return tl::unexpected(node.error());
  const json read = json::parse(text);
  const auto start = read.find("start");
  if (start != read.end() && !start->is_boolean())
    return failure("start is " + start->dump() + "; it must be true or false");
  auto knots = knots_of(read.value("knots", json::array()));
  if (!knots) return tl::unexpected(knots.error());
  return TrajectoryRequest{*node, std::move(*knots), start != read.end() && start->get<bool>()};
}

std::string sent_json(const ManualControl::Sent& sent) {
  const can_client::Played& played = sent.played;
  return json{{"refusal", name(played.refusal)},
              {"taken", sent.knots},
              {"playback", playback_state_names[static_cast<std::size_t>(played.state)]},
              {"room", played.room},
              {"buffered_s", played.buffered_s}}
      .dump();
}

}  // namespace supercoil::operating
