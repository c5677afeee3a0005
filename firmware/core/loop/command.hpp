// Commands to a running board, and its answers.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

#include "supercoil/control/estimation/estimator.hpp"
#include "supercoil/control/tracking/controller.hpp"

#include "board/learned.hpp"
#include "supervisor/channel_state.hpp"

namespace supercoil {

/// What a command asks of a channel. Numbers up to that of store are opcodes on CAN and must not
/// change.
enum class Verb : std::uint8_t {
  none = 0,
  arm = 1,               ///< probes the heater, then armed if the probe succeeded
  disarm = 2,            ///< makes the channel cold, from any state, for any sender
  reset = 3,             ///< leaves `fault` when its cause is gone
  position = 4,          ///< follow a position: value in m; renews
  power = 5,             ///< open loop: value in W; renews
  renew = 6,             ///< keeps the last command to heat valid
  rest = 7,              ///< active → armed
  identify = 8,          ///< learn the muscle; renewed like every command to heat
  calibrate = 9,         ///< cold zero and cold resistance
  scale = 10,            ///< value: the true position now, in m
  controller = 11,       ///< value: place in the configuration
  estimator = 12,        ///< value: place in the configuration
  store = 13,            ///< value: 1 stores the trusted estimates for the next start, 0 clears the
                         ///< stored muscle; 2 stores the tuning in use, and which controller and
                         ///< estimator are chosen; 3 clears that
  compare_supply = 14,   ///< value: a meter's reading of the supply, in V; 0 clears the comparison
  compare_current = 15,  ///< value: a meter's reading in the channel's line, in A
  compare_rise = 16,     ///< value: the muscle's rise by a thermometer, in K; 0 clears the reading
  tune = 17,             ///< value: place of what takes its prepared values (Tuner)
  knot = 18,             ///< value: m; the next knot of a trajectory (Playback); renews
  start = 19,            ///< value: on the board's clock, in s; the trajectory begins then
};

inline constexpr std::array<std::string_view, 20> verb_names{
    "none",      "arm",   "disarm",         "reset",           "position",     "power",
    "renew",     "rest",  "identify",       "calibrate",       "scale",        "controller",
    "estimator", "store", "compare_supply", "compare_current", "compare_rise", "tune",
    "knot",      "start"};
/// Verbs that need no more than their value; the others belong to trajectories.
inline constexpr auto plain_verb_names = std::span(verb_names).first<18>();
static_assert(verb_names[plain_verb_names.size()] == "knot");
constexpr std::string_view name(Verb verb) {
  return verb_names[static_cast<std::size_t>(verb)];
}

/// A verb without a value is refused unless its value is 0: the sender may mean something that this
/// firmware does not know. Disarm is always obeyed.
constexpr bool takes(Verb verb, double value) {
  switch (verb) {
    case Verb::arm:
    case Verb::reset:
    case Verb::renew:
    case Verb::rest:
    case Verb::identify:
    case Verb::calibrate:
      return value == 0.0;
    default:
      return true;
  }
}

/// Whether the Tuner adds what the loop needs to this command, and receives its answer.
constexpr bool is_tuning(Verb verb) {
  return verb == Verb::tune || verb == Verb::store;
}

/// In `tune`, an estimator's place has this added; a controller's place is used as it is.
inline constexpr std::size_t first_estimator_place = 8;

/// Values of Verb::store for the tuning.
inline constexpr double store_tuning = 2.0;
inline constexpr double clear_tuning = 3.0;

/// The source of a command, to which its answer returns.
enum class Source : std::uint8_t { local, can };

/// CAN carries a value as float, so that a limit may arrive as slightly more than it is.
inline constexpr double float_rounding = 1.0 + std::numeric_limits<float>::epsilon();
/// The lowest position that counts as this far below rest: a computed 0 may be slightly less.
constexpr double lowest_m(double max_reverse_travel_m) {
  constexpr double rounding_m = 1e-9;
  return -(float_rounding * max_reverse_travel_m + rounding_m);
}

/// A command, from whichever source, on its way to the loop.
struct Command {
  std::uint8_t channel = 0;  ///< from 0
  Verb verb = Verb::none;
  double value = 0.0;
  Source source = Source::local;
  std::uint32_t id = 0;  ///< chosen by the sender, repeated in the answer
  // Of `knot`.
  float after_s = 0.0F;  ///< time since the knot before it
  float velocity_m_per_s = 0.0F;
  // Owned by the Tuner until the answer. `tune` has one of the first two, swapped with the one in
  // use.
  control::Controller* tuned_controller = nullptr;
  control::Estimator* tuned_estimator = nullptr;
  const board::StoredTuning* tuning = nullptr;  ///< of `store`
};

/// A channel's reply to a command.
struct Reply {
  Reply(Refusal why, double instead = NAN) : refusal(why), nearest(instead) {}

  Refusal refusal;
  /// For a value out of range, the nearest one that would have been obeyed; NaN: none is known.
  double nearest;
};

/// Every command is answered, in order.
struct Answer {
  Command command;
  Refusal refusal = Refusal::none;
  double nearest = NAN;  ///< as in Reply
};

}  // namespace supercoil
