#include "report/trace_columns.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace supercoil::host_sim {

namespace {

using Number = std::optional<double>;

Number if_finite(double value) {
  return std::isfinite(value) ? Number(value) : std::nullopt;
}

template <double TickRecord::*Member>
Number of_record(const TraceRow& row) {
  return row.record.*Member;
}

template <double AntagonistRecord::*Member>
Number of_other(const TraceRow& row) {
  return row.record.antagonist ? Number((*row.record.antagonist).*Member) : std::nullopt;
}

template <double BundleRecord::*Member>
Number of_bundle(const TraceRow& row) {
  return row.record.bundle ? Number((*row.record.bundle).*Member) : std::nullopt;
}

template <int Place>
Number theta(const TraceRow& row) {
  return row.estimate ? Number(row.estimate->theta[Place]) : std::nullopt;
}

/// Least squares reports standard deviations, the others do not.
bool deviates(const TraceRow& row) {
  return row.estimate && std::isfinite(row.estimate->bias_deviation_W);
}

template <int Place>
Number deviation(const TraceRow& row) {
  return deviates(row) ? Number(row.estimate->deviation[Place]) : std::nullopt;
}

template <double control::Estimate::*Member>
Number bias(const TraceRow& row) {
  return deviates(row) ? Number((*row.estimate).*Member) : std::nullopt;
}

template <double TickRecord::*Member>
Number of_tracking(const TraceRow& row) {
  return row.record.open_loop ? std::nullopt : Number(row.record.*Member);
}

double angle_deg(const TraceRow& row, double position_m) {
  return row.lever.angle_rad(position_m) * 180.0 / std::numbers::pi;
}

Number flag(bool set) {
  return set ? 1.0 : 0.0;
}

constexpr std::array common_columns{
    TraceColumn{"time_s", of_record<&TickRecord::time_s>},
    TraceColumn{"reference_m", of_tracking<&TickRecord::reference>},
    TraceColumn{"model_m", of_tracking<&TickRecord::model_m>},
    TraceColumn{"position_m", of_record<&TickRecord::position_m>},
    TraceColumn{"measured_m", of_record<&TickRecord::measured_m>},
    TraceColumn{"power_W", of_record<&TickRecord::power_W>},
    TraceColumn{"applied_power_W", of_record<&TickRecord::applied_power_W>},
    TraceColumn{"temperature_rise_K", of_record<&TickRecord::temperature_rise_K>},
    TraceColumn{"limited", [](const TraceRow& row) { return flag(row.record.limited); }},
    TraceColumn{"theta1", theta<0>},
    TraceColumn{"theta2", theta<1>},
    TraceColumn{"theta3", theta<2>},
    TraceColumn{"theta4", theta<3>},
    TraceColumn{"trusted",
                [](const TraceRow& row) {
                  return row.estimate ? flag(row.estimate->trusted) : std::nullopt;
                }},
    TraceColumn{"reference_power_W",
                [](const TraceRow& row) {
                  return row.record.commands_power ? Number(row.record.reference) : std::nullopt;
                }},
    TraceColumn{"coldest_K", of_record<&TickRecord::coldest_K>},
    TraceColumn{"hottest_K", of_record<&TickRecord::hottest_K>},
    TraceColumn{"state", nullptr, [](const TraceRow& row) { return name(row.record.state); }},
    TraceColumn{"fault", nullptr, [](const TraceRow& row) { return name(row.record.fault); }},
    TraceColumn{"limited_by", nullptr,
                [](const TraceRow& row) { return name(row.record.limited_by); }},
    TraceColumn{"bias_W", bias<&control::Estimate::bias_W>},
    TraceColumn{"theta1_deviation", deviation<0>},
    TraceColumn{"theta2_deviation", deviation<1>},
    TraceColumn{"theta3_deviation", deviation<2>},
    TraceColumn{"theta4_deviation", deviation<3>},
    TraceColumn{"bias_deviation_W", bias<&control::Estimate::bias_deviation_W>},
    TraceColumn{"thermometer_C",
                [](const TraceRow& row) { return if_finite(row.record.thermometer_C); }},
};

constexpr std::array joint_columns{
    TraceColumn{"joint_angle_deg",
                [](const TraceRow& row) { return Number(angle_deg(row, row.record.position_m)); }},
    TraceColumn{"joint_reference_deg",
                [](const TraceRow& row) {
                  return row.record.open_loop ? std::nullopt
                                              : Number(angle_deg(row, row.record.model_m));
                }},
};

constexpr std::array antagonist_columns{
    TraceColumn{"antagonist_applied_power_W", of_other<&AntagonistRecord::applied_power_W>},
    TraceColumn{"antagonist_temperature_rise_K", of_other<&AntagonistRecord::temperature_rise_K>},
    TraceColumn{"antagonist_coldest_K", of_other<&AntagonistRecord::coldest_K>},
    TraceColumn{"antagonist_hottest_K", of_other<&AntagonistRecord::hottest_K>},
    TraceColumn{"antagonist_limited_by", nullptr,
                [](const TraceRow& row) {
                  const auto& other = row.record.antagonist;
                  return name(other ? other->limited_by : LimitedBy::nothing);
                }},
};

constexpr std::array bundle_columns{
    TraceColumn{"bundle_min_temperature_rise_K", of_bundle<&BundleRecord::min_temperature_rise_K>},
    TraceColumn{"bundle_max_temperature_rise_K", of_bundle<&BundleRecord::max_temperature_rise_K>},
    TraceColumn{"bundle_hottest_K", of_bundle<&BundleRecord::hottest_K>},
};

}  // namespace

std::vector<TraceColumn> trace_columns(const Conditions* conditions) {
  std::vector<TraceColumn> columns(common_columns.begin(), common_columns.end());
  const auto add = [&columns](const auto& more) {
    columns.insert(columns.end(), more.begin(), more.end());
  };
  if (conditions == nullptr) return columns;
  if (conditions->joint) add(joint_columns);
  if (conditions->antagonist() != nullptr) add(antagonist_columns);
  if (!conditions->companions.empty()) add(bundle_columns);
  return columns;
}

}  // namespace supercoil::host_sim
