// What can be asked of a running board, and what it answers.
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

enum class Verb : std::uint8_t {
  none = 0,
  arm = 1,              ///< probes the heater; armed when that went well
  disarm = 2,           ///< cold, from everywhere, for everybody
  reset = 3,            ///< leaves `fault` when its cause is gone
  position = 4,         ///< follow a position: value in m; renews
  power = 5,            ///< open loop: value in W; renews
  renew = 6,            ///< the last command to heat still holds
  rest = 7,             ///< active → armed
  identify = 8,         ///< learn the muscle; renewed like every command to heat
  calibrate = 9,        ///< cold zero and cold resistance
  scale = 10,           ///< value: the true position now, in m
  controller = 11,      ///< value: place in the configuration
  estimator = 12,       ///< value: place in the configuration
  store = 13,           ///< value: 1 keeps the trusted estimates for the next start, 0 forgets the
                        ///< muscle that is kept; 2 keeps the tuning that is in use, and which
                        ///< controller and estimator are chosen; 3 forgets that
  compare_supply = 14,  ///< value: what a meter shows at the supply, in V; 0 forgets the comparison
  compare_current = 15,  ///< value: what a meter shows in the channel's line, in A
  compare_rise = 16,  ///< value: how much warmer than the air a thermometer shows the muscle, in K;
                      ///< 0 forgets what was read
  tune = 17,          ///< value: place of what gets its prepared values (Tuner)
  knot = 18,          ///< value: m; the next knot of a trajectory (Playback); renews
  start = 19,         ///< value: on the board's clock, in s; plays the trajectory from then on
};

inline constexpr std::array<std::string_view, 20> verb_names{
    "none",      "arm",   "disarm",         "reset",           "position",     "power",
    "renew",     "rest",  "identify",       "calibrate",       "scale",        "controller",
    "estimator", "store", "compare_supply", "compare_current", "compare_rise", "tune",
    "knot",      "start"};
/// Those that have all of their meaning in their value: the rest are of trajectories.
inline constexpr auto plain_verb_names = std::span(verb_names).first<18>();
static_assert(verb_names[plain_verb_names.size()] == "knot");
constexpr std::string_view name(Verb verb) {
  return verb_names[static_cast<std::size_t>(verb)];
}

/// A verb without a value is refused with any other than 0: who sends one means something that this
/// firmware does not know. But for disarm, which is obeyed however it comes.
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

/// The Tuner gives it what the loop needs for it, and is told the answer.
constexpr bool is_tuning(Verb verb) {
  return verb == Verb::tune || verb == Verb::store;
}

/// Places of what is tuned: a controller's is its own, an estimator's has this much added.
inline constexpr std::size_t first_estimator_place = 8;

/// Values of Verb::store for the tuning.
inline constexpr double store_tuning = 2.0;
inline constexpr double clear_tuning = 3.0;

/// Who asked: the answer goes back there.
enum class Source : std::uint8_t { local, can };

/// Over CAN a value is a float: a limit itself, too, may come as a little more than it is.
inline constexpr double float_rounding = 1.0 + std::numeric_limits<float>::epsilon();

struct Command {
  std::uint8_t channel = 0;  ///< from 0
  Verb verb = Verb::none;
  double value = 0.0;
  Source source = Source::local;
  std::uint32_t id = 0;  ///< chosen by whoever asks; the answer has it
  // Of `knot`.
  float after_s = 0.0F;  ///< the one before it
  float velocity_m_per_s = 0.0F;
  // From the Tuner, which owns them until the answer.
  // Of `tune`: one of them, exchanged for the one in use.
  control::Controller* tuned_controller = nullptr;
  control::Estimator* tuned_estimator = nullptr;
  const board::StoredTuning* tuning = nullptr;  ///< of `store`
};

/// How a channel takes a command.
struct Reply {
  Reply(Refusal why, double instead = NAN) : refusal(why), nearest(instead) {}

  Refusal refusal;
  /// Of what is out of range: the nearest value that would have been obeyed; NaN: none is known.
  double nearest;
};

/// Every command is answered, in order.
struct Answer {
  Command command;
  Refusal refusal = Refusal::none;
  double nearest = NAN;  ///< as in Reply
};

}  // namespace supercoil
