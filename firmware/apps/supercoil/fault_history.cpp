#include "apps/supercoil/fault_history.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace supercoil::operating {

void ChannelHistory::add(const Row& row, double time_s) {
  if (!std::isnan(row.hottest_C) && (hottest == nullptr || row.hottest_C > hottest->hottest_C))
    hottest = &row;
  max_W = std::fmax(max_W, row.applied_W);
  if (time_s < 0.0) {
    last_before = &row;
    if (!std::isnan(row.applied_W)) {
      sum_W += static_cast<double>(row.applied_W);
      ++powers;
    }
  }
  if (time_s <= 0.0 && row.margin_selector != 0) margins[row.margin_selector] = &row;
}

std::vector<const Row*> ChannelHistory::ranked_margins() const {
  std::vector<const Row*> rows;
  for (const auto& [margin_selector, row] : margins)
    rows.push_back(row);
  std::stable_sort(rows.begin(), rows.end(),
                   [](const Row* a, const Row* b) { return a->margin_used > b->margin_used; });
  return rows;
}

Gaps gaps_of(const recorder::Recording& recording) {
  const auto& rows = recording.rows;
  const double rate_Hz = recording.header.rate_Hz;
  Gaps gaps;
  if (rate_Hz <= 0.0) return gaps;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double before_s = recording.time_s(rows[i - 1]);
    const double gap_s = recording.time_s(rows[i]) - before_s;
    if (gap_s * rate_Hz <= 1.5) continue;
    ++gaps.count;
    if (gap_s > gaps.max_s) gaps.max_from_s = before_s;
    gaps.max_s = std::max(gaps.max_s, gap_s);
  }
  return gaps;
}

std::vector<OtherFault> other_faults_of(const recorder::Recording& recording) {
  std::array<const Row*, 256> last{};
  std::vector<OtherFault> others;
  for (const Row& row : recording.rows) {
    const Row* before = std::exchange(last[row.channel], &row);
    const bool changed = row.fault != (before == nullptr ? 0 : before->fault);
    const bool is_recorded_fault = row.channel == recording.header.fault_channel &&
                                   row.time_ns == recording.header.fault_time_ns;
    if (!changed || is_recorded_fault) continue;
    const auto at_s = before == nullptr ? std::nullopt : std::optional(recording.time_s(row));
    others.push_back({at_s, row.channel, row.fault});
  }
  return others;
}

std::map<int, ChannelHistory> channels_of(const recorder::Recording& recording) {
  std::map<int, ChannelHistory> channels;
  for (const Row& row : recording.rows)
    channels[row.channel].add(row, recording.time_s(row));
  return channels;
}

}  // namespace supercoil::operating
