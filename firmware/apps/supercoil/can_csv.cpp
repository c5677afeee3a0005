#include "apps/supercoil/can_csv.hpp"

#include <array>
#include <cmath>
#include <cstdio>

#include "can/codec.hpp"
#include "text/number_text.hpp"

namespace supercoil::operating {

namespace {

using can::Decoded;
using can::SignalInfo;

/// Written in pieces of about this size.
constexpr std::size_t piece_bytes = 1U << 16U;

/// A named value as its name; empty: not available.
std::string value_text(const SignalInfo& signal, double value) {
  const std::string_view name = can::value_name(signal, value);
  if (!name.empty()) return std::string(name);
  return std::isnan(value) ? "" : number_text(value, can::significant_digits(signal));
}

std::string row_begin(const Decoded& decoded, hal::Time time) {
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), "%.6f,%d,", hal::seconds(time), int{decoded.node});
  return text.data();
}

std::string header(const CanSelection& selection) {
  if (selection.message.empty()) return "time_s,node,message,signal,value,unit\n";
  std::string text = "time_s,node";
  for (const SignalInfo& signal : can::find_message(selection.message)->signals)
    text.append(",").append(signal.name);
  return text + '\n';
}

std::size_t add_values(std::string& csv, const Decoded& decoded, hal::Time time) {
  const std::string begin = row_begin(decoded, time);
  std::size_t rows = 0;
  for (std::size_t i = 0; i < decoded.message->signals.size(); ++i) {
    const SignalInfo& signal = decoded.message->signals[i];
    const std::string value = value_text(signal, decoded.values.at(i));
    if (value.empty()) continue;
    csv.append(begin).append(decoded.message->name).append(",").append(signal.name);
    csv.append(",").append(value).append(",").append(signal.unit).append("\n");
    ++rows;
  }
  return rows;
}

std::size_t add_row(std::string& csv, const Decoded& decoded, hal::Time time) {
  csv += row_begin(decoded, time);
  for (std::size_t i = 0; i < decoded.message->signals.size(); ++i)
    csv.append(value_text(decoded.message->signals[i], decoded.values.at(i))).append(",");
  csv.back() = '\n';
  return 1;
}

}  // namespace

bool is_wanted(const CanSelection& selection, const Decoded& decoded, double time_s) {
  // Logs have microseconds: a time as printed there must select that line.
  constexpr double rounding_s = 0.5e-6;
  return time_s >= selection.from_s - rounding_s && time_s <= selection.to_s + rounding_s &&
         (selection.node == 0 || selection.node == decoded.node) &&
         (selection.message.empty() || selection.message == decoded.message->name);
}

Result<std::size_t> can_to_csv(const std::vector<hal::CanFrame>& frames,
                               const CanSelection& selection, const recorder::Sink& write) {
  const auto add = selection.message.empty() ? add_values : add_row;
  std::string csv = header(selection);
  std::size_t rows = 0;
  for (const hal::CanFrame& frame : frames) {
    const auto decoded = can::decode(frame);
    if (!decoded || !is_wanted(selection, *decoded, hal::seconds(frame.received))) continue;
    rows += add(csv, *decoded, frame.received);
    if (csv.size() < piece_bytes) continue;
    if (auto written = write(csv); !written) return tl::unexpected(written.error());
    csv.clear();
  }
  if (rows == 0) return rows;
  if (auto written = write(csv); !written) return tl::unexpected(written.error());
  return rows;
}

}  // namespace supercoil::operating
