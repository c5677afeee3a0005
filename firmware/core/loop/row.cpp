#include "loop/row.hpp"

#include <cmath>

namespace supercoil {

namespace {

float narrow(double value) {
  return static_cast<float>(value);
}

double multiplexed_value_of(const Snapshot& s) {
  if (s.multiplexed_selector == 0) return std::nan("");
  const std::array<double, multiplexed_names.size() - 1> all{
      s.bias_W, s.deviation[0], s.deviation[1], s.deviation[2], s.deviation[3], s.bias_deviation_W};
  return all.at(s.multiplexed_selector - 1U);
}

}  // namespace

Row row_of(const Snapshot& s) {
  Row row{};
  row.time_ns = s.time.count();
  row.channel = s.channel;
  row.state = static_cast<std::uint8_t>(s.state);
  row.mode = static_cast<std::uint8_t>(s.mode);
  row.fault = static_cast<std::uint8_t>(s.fault);
  row.limited_by = static_cast<std::uint8_t>(s.limited_by);
  row.controller = s.controller;
  row.flags = static_cast<std::uint8_t>(
      (s.probing ? row_probing : 0) | (s.trusted ? row_trusted : 0) |
      (s.limited ? row_limited : 0) | (s.proof_off ? row_proof_off : 0) |
      (s.oscillation_period_s > 0.0 ? row_oscillated : 0) | (s.slack ? row_slack : 0));
  row.margin_selector = static_cast<std::uint8_t>(s.margin_selector);
  row.reference = narrow(s.reference);
  row.model_m = narrow(s.model_m);
  row.position_m = narrow(s.position_m);
  row.demanded_W = narrow(s.demanded_W);
  row.applied_W = narrow(s.applied_W);
  row.duty = narrow(s.duty);
  row.supply_V = narrow(s.supply_V);
  row.current_A = narrow(s.current_A);
  row.resistance_Ohm = narrow(s.resistance_Ohm);
  row.resistance_age_s = narrow(s.resistance_age_s);
  row.coldest_C = narrow(s.coldest_C);
  row.hottest_C = narrow(s.hottest_C);
  for (std::size_t i = 0; i < row.theta.size(); ++i)
    row.theta[i] = narrow(s.theta[static_cast<Eigen::Index>(i)]);
  row.error_bound = narrow(s.error_bound);
  row.progress = narrow(s.progress);
  row.margin_used = narrow(s.margin.used());
  row.margin_measured = narrow(s.margin.measured);
  row.margin_limit = narrow(s.margin.limit);
  row.gain = narrow(s.gain.value);
  row.result = static_cast<std::uint8_t>(s.result);
  row.multiplexed_value = narrow(multiplexed_value_of(s));
  row.multiplexed_selector = s.multiplexed_selector;
  row.identify_notes = s.identify_notes;
  row.gain_selector = static_cast<std::uint8_t>(s.gain.gain);
  return row;
}

}  // namespace supercoil
