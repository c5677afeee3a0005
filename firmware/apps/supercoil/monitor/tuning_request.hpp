// Requests of a page about a node's controllers and estimators.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "supercoil/hal/error.hpp"

#include "apps/supercoil/monitor/manual_control.hpp"

namespace supercoil::operating {

struct TuningRequest {
  std::uint8_t node;   ///< 1 to 63
  std::uint8_t place;  ///< as in Tuner: 0 to 3 a controller, 8 to 11 an estimator
  TuningSet from;      ///< the set to change
  struct Value {
    std::uint8_t tunable;
    double value;
  };
  std::vector<Value> values;  ///< in the order of control::tunables()
};

/// {"node":1,"place":0,"from":"in_use","values":{"kind":"pi"}}; values are text, as on the command
/// line. The error says what is wrong, and with which value.
Result<TuningRequest> parse_tuning_request(const std::string& text);

/// Prepares the requested values, and puts them into use. The error: the board did not answer.
ManualControl::Answer tune(ManualControl& control, const TuningRequest& request);

}  // namespace supercoil::operating
