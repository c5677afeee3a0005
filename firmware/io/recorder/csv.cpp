#include <array>
#include <charconv>
#include <cmath>

#include "recorder/names.hpp"
#include "recorder/recording.hpp"

namespace supercoil::recorder {

namespace {

constexpr std::size_t part_bytes = 1 << 18;
constexpr std::string_view columns =
    "time_s,channel,state,mode,fault,limited_by,controller,probing,trusted,limited,reference,"
    "model_m,position_m,wanted_W,applied_W,duty,supply_V,current_A,resistance_Ohm,"
    "resistance_age_s,coldest_C,hottest_C,theta1,theta2,theta3,theta4,error_bound,progress,"
    "margin_of,margin_used,margin_measured,margin_limit,gain_of,gain,result,aside_of,aside,"
    "identify_notes\n";

/// Never in exponents, which some spreadsheets take for text.
template <class Number>
void add(std::string& line, Number value) {
  if (!std::isnan(value)) {
    std::array<char, 400> text{};
    char* const end = text.data() + text.size();
    line.append(text.data(), std::to_chars(text.data(), end, value, std::chars_format::fixed).ptr);
  }
  line += ',';
}

void add(std::string& line, const std::string& name) {
  line += name;
  line += ',';
}

void add_row(std::string& line, const Row& row, double time_s) {
  add(line, time_s);
  add(line, std::to_string(row.channel + 1));
  add(line, state_name(row.state));
  add(line, mode_name(row.mode));
  add(line, fault_name(row.fault));
  add(line, limit_name(row.limited_by));
  add(line, std::to_string(row.controller));
  for (const int bit : {1, 2, 4})
    line += (row.flags & bit) != 0 ? "1," : "0,";
  for (const float value :
       {row.reference, row.model_m, row.position_m, row.wanted_W, row.applied_W, row.duty,
        row.supply_V, row.current_A, row.resistance_Ohm, row.resistance_age_s, row.coldest_C,
        row.hottest_C, row.theta[0], row.theta[1], row.theta[2], row.theta[3], row.error_bound,
        row.progress}) {
    add(line, value);
  }
  add(line, fault_name(row.turn));
  for (const float value : {row.margin_used, row.margin_measured, row.margin_limit})
    add(line, value);
  add(line, gain_name(row.gain_turn));
  add(line, row.gain);
  add(line, result_name(row.result));
  add(line, aside_name(row.aside_turn));
  add(line, row.aside);
  add(line, std::to_string(row.identify_notes));
  line.back() = '\n';
}

}  // namespace

tl::expected<void, std::string> to_csv(const Recording& recording, const Sink& sink) {
  std::string part(columns);
  part.reserve(part_bytes + 4096);
  for (const Row& row : recording.rows) {
    add_row(part, row, recording.time_s(row));
    if (part.size() < part_bytes) continue;
    if (auto written = sink(part); !written) return written;
    part.clear();
  }
  return part.empty() ? tl::expected<void, std::string>{} : sink(part);
}

}  // namespace supercoil::recorder
