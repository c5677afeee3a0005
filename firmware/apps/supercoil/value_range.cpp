#include "apps/supercoil/value_range.hpp"

#include <cmath>

#include "apps/supercoil/tuned_place.hpp"
#include "text/number_text.hpp"

namespace supercoil::operating {

namespace {

constexpr int digits = 3;

/// NaN: the board reports none within a second. On a bus it comes with the next frame.
double newest_position_m(BoardLink& board, const std::string& channel) {
  constexpr int tries = 20;
  double position_m = NAN;
  for (int i = 0; i < tries && std::isnan(position_m); ++i) {
    if (i > 0) board.wait(std::chrono::milliseconds(50));
    position_m = board.position_m(channel).value_or(NAN);
  }
  return position_m;
}

/// The rule for the scale that a board applies.
control::Violation scale_rule() {
  board::Learned learned;
  learned.calibration.position_scale = NAN;
  return board::check(learned).value();
}

std::string scale_range(BoardLink& board, const std::string& channel) {
  const auto known = board.muscle(channel);
  const double shown_m = newest_position_m(board, channel);
  if (!known || std::isnan(shown_m)) return "";
  const double raw_m = shown_m / (*known)[known_position_scale];
  const std::string shown = "; the sensor shows " + number_text(shown_m, digits) + " m there";
  if (!(raw_m > 0.0)) return shown + ": no scale can turn that into a place";
  return shown + ": " + number_text(scale_rule().min * raw_m, digits) + " to " +
         number_text(scale_rule().max * raw_m, digits) + " are in range";
}

std::string place_range(BoardLink& board, const std::string& channel, Tuned what) {
  const auto kinds = read_kinds(what, tunable_reader(board, channel));
  if (!kinds || kinds->empty()) return "";
  return std::string(kinds->size() == 1 ? "; there is " : "; there are ") + places_text(*kinds);
}

}  // namespace

std::string accepted_range_text(BoardLink& board, const std::string& channel, Verb verb) {
  if (verb == Verb::scale) return scale_range(board, channel);
  if (verb == Verb::controller) return place_range(board, channel, Tuned::controller);
  if (verb == Verb::estimator) return place_range(board, channel, Tuned::estimator);
  return "";
}

}  // namespace supercoil::operating
