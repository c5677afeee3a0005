// A row's quantities by their names: the columns of CSV, and the signals of frames.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "loop/row.hpp"
#include "recorder/names.hpp"

namespace supercoil::recorder {

/// A quantity of a row, as a number.
struct Quantity {
  std::string_view name;     ///< with its unit
  double (*of)(const Row&);  ///< NaN: not available
  /// For an enumeration: the name of a number.
  std::string (*word)(std::uint8_t number) = nullptr;
};

/// member: a pointer to a number in Row.
template <auto member>
constexpr double value_of(const Row& row) {
  return row.*member;
}
/// i: from 0 to 3.
template <std::size_t i>
constexpr double theta_of(const Row& row) {
  return row.theta[i];
}
/// 1 if the flag is set, else 0.
template <RowFlag flag>
constexpr double flag_of(const Row& row) {
  return (row.flags & flag) != 0 ? 1.0 : 0.0;
}

/// In the order of the CSV columns: add new ones at the end.
inline constexpr std::array quantities{
    Quantity{"state", value_of<&Row::state>, state_name},
    Quantity{"mode", value_of<&Row::mode>, mode_name},
    Quantity{"fault", value_of<&Row::fault>, fault_name},
    Quantity{"limited_by", value_of<&Row::limited_by>, limit_name},
    Quantity{"controller", value_of<&Row::controller>},
    Quantity{"probing", flag_of<row_probing>},
    Quantity{"trusted", flag_of<row_trusted>},
    Quantity{"limited", flag_of<row_limited>},
    Quantity{"reference", value_of<&Row::reference>},
    Quantity{"model_m", value_of<&Row::model_m>},
    Quantity{"position_m", value_of<&Row::position_m>},
    Quantity{"demanded_W", value_of<&Row::demanded_W>},
    Quantity{"applied_W", value_of<&Row::applied_W>},
    Quantity{"duty", value_of<&Row::duty>},
    Quantity{"supply_V", value_of<&Row::supply_V>},
    Quantity{"current_A", value_of<&Row::current_A>},
    Quantity{"resistance_Ohm", value_of<&Row::resistance_Ohm>},
    Quantity{"resistance_age_s", value_of<&Row::resistance_age_s>},
    Quantity{"coldest_C", value_of<&Row::coldest_C>},
    Quantity{"hottest_C", value_of<&Row::hottest_C>},
    Quantity{"theta1", theta_of<0>},
    Quantity{"theta2", theta_of<1>},
    Quantity{"theta3", theta_of<2>},
    Quantity{"theta4", theta_of<3>},
    Quantity{"error_bound", value_of<&Row::error_bound>},
    Quantity{"progress", value_of<&Row::progress>},
    Quantity{"margin_selector", value_of<&Row::margin_selector>, fault_name},
    Quantity{"margin_used", value_of<&Row::margin_used>},
    Quantity{"margin_measured", value_of<&Row::margin_measured>},
    Quantity{"margin_limit", value_of<&Row::margin_limit>},
    Quantity{"gain_selector", value_of<&Row::gain_selector>, gain_name},
    Quantity{"gain", value_of<&Row::gain>},
    Quantity{"result", value_of<&Row::result>, result_name},
    Quantity{"multiplexed_selector", value_of<&Row::multiplexed_selector>, multiplexed_name},
    Quantity{"multiplexed_value", value_of<&Row::multiplexed_value>},
    Quantity{"identify_notes", value_of<&Row::identify_notes>},
    Quantity{"proof_off", flag_of<row_proof_off>},
    Quantity{"oscillated", flag_of<row_oscillated>},
    Quantity{"slack", flag_of<row_slack>},
};

/// Null: a row has no quantity of this name.
constexpr const Quantity* find_quantity(std::string_view name) {
  for (const Quantity& quantity : quantities) {
    if (quantity.name == name) return &quantity;
  }
  return nullptr;
}

}  // namespace supercoil::recorder
