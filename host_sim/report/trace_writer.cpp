#include "report/trace_writer.hpp"

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <system_error>

namespace supercoil::host_sim {

namespace {

constexpr std::size_t flush_bytes = 1 << 20;
constexpr const char* header =
    "time_s,reference_m,model_m,position_m,measured_m,power_W,applied_power_W,temperature_rise_K,"
    "limited,theta1,theta2,theta3,theta4,trusted,reference_power_W,coldest_K,hottest_K,state,"
    "fault,limited_by,bias_W,theta1_deviation,theta2_deviation,theta3_deviation,theta4_deviation,"
    "bias_deviation_W,thermometer_C";
constexpr const char* joint_header =
    ",antagonist_applied_power_W,antagonist_temperature_rise_K,antagonist_coldest_K,"
    "antagonist_hottest_K";

}  // namespace

TraceWriter::TraceWriter(const std::filesystem::path& path, std::int64_t every, bool of_joint)
    : out_(path, std::ios::binary), every_(every), buffer_(header) {
  if (of_joint) buffer_ += joint_header;
  buffer_ += '\n';
  buffer_.reserve(flush_bytes + 4096);
}

void TraceWriter::number(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  buffer_.append(text.data(), end);
}

void TraceWriter::add(const TickRecord& record, const std::optional<control::Estimate>& estimate) {
  number(record.time_s);
  for (const double value : {record.reference, record.model_m}) {
    buffer_ += ',';
    if (!record.open_loop) number(value);
  }
  for (const double value : {record.position_m, record.measured_m, record.power_W,
                             record.applied_power_W, record.temperature_rise_K}) {
    buffer_ += ',';
    number(value);
  }
  buffer_ += record.limited ? ",1" : ",0";
  for (int i = 0; i < 4; ++i) {
    buffer_ += ',';
    if (estimate) number(estimate->theta[i]);
  }
  buffer_ += !estimate ? "," : estimate->trusted ? ",1" : ",0";
  buffer_ += ',';
  if (record.commands_power) number(record.reference);
  for (const double value : {record.coldest_K, record.hottest_K}) {
    buffer_ += ',';
    number(value);
  }
  for (const std::string_view word :
       {name(record.state), name(record.fault), name(record.limited_by)}) {
    buffer_ += ',';
    buffer_ += word;
  }
  const bool deviates = estimate && std::isfinite(estimate->bias_deviation_W);
  buffer_ += ',';
  if (deviates) number(estimate->bias_W);
  for (int i = 0; i < 4; ++i) {
    buffer_ += ',';
    if (deviates) number(estimate->deviation[i]);
  }
  buffer_ += ',';
  if (deviates) number(estimate->bias_deviation_W);
  buffer_ += ',';
  if (std::isfinite(record.thermometer_C)) number(record.thermometer_C);
  if (record.antagonist) {
    const AntagonistRecord& other = *record.antagonist;
    for (const double value :
         {other.applied_power_W, other.temperature_rise_K, other.coldest_K, other.hottest_K}) {
      buffer_ += ',';
      number(value);
    }
  }
  buffer_ += '\n';
  if (buffer_.size() >= flush_bytes) flush();
}

void TraceWriter::flush() {
  out_ << buffer_;
  buffer_.clear();
}

tl::expected<void, std::string> TraceWriter::finish() {
  flush();
  out_.close();
  if (out_) return {};
  return tl::unexpected("trace.csv: cannot be written: " + std::generic_category().message(errno));
}

}  // namespace supercoil::host_sim
