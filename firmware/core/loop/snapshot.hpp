// All quantities of one channel after one tick.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "supercoil/control/actuator/parameters.hpp"
#include "supercoil/control/tracking/gain.hpp"
#include "supercoil/hal/clock.hpp"

#include "modes/result.hpp"
#include "supervisor/channel_state.hpp"
#include "supervisor/detectors/margin.hpp"
#include "supervisor/limiter.hpp"

namespace supercoil {

/// What an active channel does.
enum class Mode : std::uint8_t {
  rest,
  position,
  power,
  identify,
  calibrate,
  joint,   ///< does its part of what the joint's other channel follows
  bundle,  ///< gets the power of its bundle's leader
};

/// Needs the muscle's own motion, and ends by itself with a ModeResult.
constexpr bool measures(Mode mode) {
  return mode == Mode::identify || mode == Mode::calibrate;
}

/// Is led by another channel.
constexpr bool is_led(Mode mode) {
  return mode == Mode::joint || mode == Mode::bundle;
}

inline constexpr std::array<std::string_view, 7> mode_names{
    "rest", "position", "power", "identify", "calibrate", "joint", "bundle"};

/// An estimator's values beside theta: a power bias, and standard deviations.
inline constexpr std::array<std::string_view, 7> multiplexed_names{
    "none",
    "bias",
    "theta1_deviation",
    "theta2_deviation",
    "theta3_deviation",
    "theta4_deviation",
    "bias_deviation",
};

/// Quantities that could not be measured are NaN. Powers act from this tick to the next.
struct Snapshot {
  hal::Time time{};
  std::uint8_t channel = 0;  ///< from 0
  State state = State::disarmed;
  Mode mode = Mode::rest;
  Fault fault = Fault::none;  ///< the first cause
  LimitedBy limited_by = LimitedBy::nothing;
  std::uint8_t controller = 0;  ///< place in the configuration
  bool probing = false;
  bool trusted = false;    ///< the estimates
  bool limited = false;    ///< the acting power is not the one wanted
  bool proof_off = false;  ///< proof_of_response = false
  bool slack = false;      ///< by its model, a joint's muscle no longer pulls
  /// Of an oscillation that the running controller has detected in its own loop; 0: none.
  double oscillation_period_s = 0.0;
  double reference = 0.0;  ///< in m, or in W in open loop
  double model_m = 0.0;    ///< of the reference model: what tracking is measured against
  double position_m = 0.0;
  double demanded_W = 0.0;
  double applied_W = 0.0;  ///< after limits and quantisation
  double duty = 0.0;
  double supply_V = 0.0;
  double current_A = 0.0;
  double resistance_Ohm = 0.0;
  double resistance_age_s = 0.0;
  double coldest_C = 0.0;  ///< the muscle's temperature lies between these
  double hottest_C = 0.0;
  control::Theta theta = control::Theta::Zero();
  double error_bound = 0.0;  ///< of theta, relative
  double bias_W = 0.0;       ///< NaN while not available, like the next two
  control::Theta deviation = control::Theta::Zero();  ///< standard deviation of theta
  double bias_deviation_W = 0.0;
  std::uint8_t multiplexed_selector =
      0;                  ///< in turn: place in multiplexed_names, each within 8 ticks
  float progress = 0.0F;  ///< of identify and calibrate, 0 to 1
  ModeResult result = ModeResult::none;
  std::uint8_t identify_notes = 0;  ///< bits of IdentifyNote, of the last identify that ended
  /// One detector's margin in turn; each comes round within 55 ticks.
  Fault margin_selector = Fault::none;
  detectors::Margin margin;
  /// One gain of the controller in turn.
  control::GainValue gain;
};

}  // namespace supercoil
