#include <array>
#include <charconv>
#include <cmath>

#include <nlohmann/json.hpp>

#include "apps/supercoil/fault_history.hpp"
#include "apps/supercoil/summary.hpp"
#include "recorder/names.hpp"
#include "text/program_version.hpp"

namespace supercoil::operating {

namespace {

using Json = nlohmann::ordered_json;

/// Increases when a key is renamed or changes its meaning.
constexpr int schema_version = 1;

/// With as many digits as a float has; null: not measured, as JSON has no NaN.
Json json_of(float value) {
  if (!std::isfinite(value)) return nullptr;
  std::array<char, 32> text{};
  const char* end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  double same = 0.0;
  std::from_chars(text.data(), end, same);
  return same;
}

Json fault_of(const recorder::Header& h) {
  if (h.fault == 0) return nullptr;
  const auto known = info(static_cast<Fault>(h.fault));
  return {{"name", h.fault_name.empty() ? recorder::fault_name(h.fault) : h.fault_name},
          {"number", h.fault},
          {"channel", h.fault_channel + 1},
          {"meaning", known ? Json(known->meaning) : nullptr},
          {"clock_s", static_cast<double>(h.fault_time_ns) / 1e9}};
}

Json gaps_json(const Gaps& gaps) {
  const bool any = gaps.count > 0;
  return {{"count", gaps.count},
          {"max_s", any ? Json(gaps.max_s) : nullptr},
          {"max_from_s", any ? Json(gaps.max_from_s) : nullptr}};
}

Json others_of(const recorder::Recording& recording) {
  Json others = Json::array();
  for (const auto& [at_s, channel, fault] : other_faults_of(recording)) {
    others.push_back({{"at_s", at_s ? Json(*at_s) : Json(nullptr)},
                      {"channel", channel + 1},
                      {"name", fault == 0 ? Json(nullptr) : Json(recorder::fault_name(fault))}});
  }
  return others;
}

Json last_of(const Row* row) {
  if (row == nullptr) return nullptr;
  const auto mode = static_cast<Mode>(row->mode);
  const bool power = mode == Mode::power || is_led(mode);
  return {{"state", recorder::state_name(row->state)},
          {"mode", recorder::mode_name(row->mode)},
          {"limited_by", recorder::limit_name(row->limited_by)},
          {"position_m", json_of(row->position_m)},
          {power ? "reference_W" : "reference_m", json_of(row->reference)},
          {"supply_V", json_of(row->supply_V)},
          {"current_A", json_of(row->current_A)},
          {"resistance_Ohm", json_of(row->resistance_Ohm)},
          {"resistance_age_s", json_of(row->resistance_age_s)},
          {"proof_off", (row->flags & row_proof_off) != 0},
          {"oscillated", (row->flags & row_oscillated) != 0},
          {"slack", (row->flags & row_slack) != 0}};
}

Json margins_of(const ChannelHistory& c, const recorder::Recording& recording) {
  Json margins = Json::array();
  for (const Row* row : c.ranked_margins()) {
    margins.push_back({{"detector", recorder::fault_name(row->margin_selector)},
                       {"used_ratio", json_of(row->margin_used)},
                       {"measured", json_of(row->margin_measured)},
                       {"limit", json_of(row->margin_limit)},
                       {"at_s", recording.time_s(*row)}});
  }
  return margins;
}

Json channel_of(int number, const ChannelHistory& c, const recorder::Recording& recording) {
  const bool hot = c.hottest != nullptr;
  return {{"channel", number + 1},
          {"just_before", last_of(c.last_before)},
          {"mean_W", c.powers > 0 ? Json(c.mean_W()) : nullptr},
          {"max_W", json_of(c.max_W)},
          {"hottest_C", hot ? json_of(c.hottest->hottest_C) : nullptr},
          {"hottest_at_s", hot ? Json(recording.time_s(*c.hottest)) : nullptr},
          {"margins", margins_of(c, recording)}};
}

}  // namespace

std::string summary_json(const recorder::Recording& recording) {
  const recorder::Header& h = recording.header;
  Json channels = Json::array();
  for (const auto& [number, channel] : channels_of(recording))
    channels.push_back(channel_of(number, channel, recording));
  const Json all{{"schema_version", schema_version},
                 {"program_version", program_version()},
                 {"recorded_by", h.program.empty() ? Json(nullptr) : Json(h.program)},
                 {"damage", recording.damage.empty() ? Json(nullptr) : Json(recording.damage)},
                 {"fault", fault_of(h)},
                 {"from_s", recording.time_s(recording.rows.front())},
                 {"to_s", recording.time_s(recording.rows.back())},
                 {"row_count", recording.rows.size()},
                 {"rate_Hz", h.rate_Hz},
                 {"gaps", gaps_json(gaps_of(recording))},
                 {"other_faults", others_of(recording)},
                 {"channels", channels}};
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace supercoil::operating
