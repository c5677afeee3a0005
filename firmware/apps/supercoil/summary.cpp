#include "apps/supercoil/summary.hpp"

#include <algorithm>
#include <array>
#include <cinttypes>
#include <cmath>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <utility>
#include <vector>

#include "apps/supercoil/fault_history.hpp"
#include "recorder/names.hpp"
#include "text/margin_unit.hpp"

namespace supercoil::operating {

namespace {

class Lines {
 public:
  [[gnu::format(printf, 2, 3)]] void add(const char* format, ...) {
    std::array<char, 400> text{};
    va_list values;
    va_start(values, format);
    // NOLINTNEXTLINE(clang-analyzer-valist.Uninitialized): va_start is two lines above.
    std::vsnprintf(text.data(), text.size(), format, values);
    va_end(values);
    all_ += text.data();
    all_ += '\n';
  }
  std::string take() { return std::move(all_); }

 private:
  std::string all_;
};

void print_fault(Lines& lines, const recorder::Recording& recording) {
  const recorder::Header& h = recording.header;
  if (h.fault == 0) {
    lines.add("The part that could be read has no fault; times are relative to the last row.");
    return;
  }
  const std::string name = h.fault_name.empty() ? recorder::fault_name(h.fault) : h.fault_name;
  lines.add("%s (fault %d) on channel %d", name.c_str(), h.fault, h.fault_channel + 1);
  if (const auto known = info(static_cast<Fault>(h.fault))) {
    lines.add("  meaning: %s", std::string(known->meaning).c_str());
  }
  lines.add("  when: %.6f s after the board's clock began (normally at its start)",
            static_cast<double>(h.fault_time_ns) / 1e9);
  if (!h.program.empty()) lines.add("  recorded by: supercoil %s", h.program.c_str());
}

void print_extent(Lines& lines, const recorder::Recording& recording) {
  const auto& rows = recording.rows;
  lines.add("  recorded: %.3f s to %.3f s, %zu rows", recording.time_s(rows.front()),
            recording.time_s(rows.back()), rows.size());
  if (const double end_s = recording.time_s(rows.back()); end_s < 0.0) {
    lines.add("  the fault is not in it: all below is from %.3f s before the fault and earlier",
              -end_s);
  }
  const double rate_Hz = recording.header.rate_Hz;
  if (rate_Hz <= 0.0) return;
  const int channels = recording.header.channels;
  lines.add("  %d channel%s at %g Hz", channels, channels == 1 ? "" : "s", rate_Hz);
  const Gaps gaps = gaps_of(recording);
  if (gaps.count > 0) {
    lines.add("  ticks are missing: %" PRId64 " gap%s, the longest %.3f s, from %.3f s on",
              gaps.count, gaps.count == 1 ? "" : "s", gaps.max_s, gaps.max_from_s);
  }
}

void print_other_faults(Lines& lines, const recorder::Recording& recording) {
  constexpr std::size_t max_shown = 20;
  const std::vector<OtherFault> other_faults = other_faults_of(recording);
  const std::size_t shown = std::min(max_shown, other_faults.size());
  for (std::size_t i = 0; i < shown; ++i) {
    const auto& [at_s, channel, fault] = other_faults[i];
    const std::string what = fault == 0 ? "fault reset" : recorder::fault_name(fault);
    if (at_s) {
      lines.add("  %+.3f s: channel %d: %s", *at_s, channel + 1, what.c_str());
    } else {
      lines.add("  channel %d: already in fault at the start: %s", channel + 1, what.c_str());
    }
  }
  if (shown < other_faults.size())
    lines.add("  and %zu more faults and resets", other_faults.size() - shown);
}

double of(float value) {
  return static_cast<double>(value);
}

/// A converter's counts less its offset leave -4e-16 where nothing flows. No quantity here is
/// resolved to a billionth of its unit.
double without_rounding(float value) {
  constexpr double resolved = 1e-9;
  return std::abs(of(value)) < resolved ? 0.0 : of(value);
}

/// "?" for what could not be measured.
std::string number(float value) {
  if (std::isnan(value)) return "?";
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", without_rounding(value));
  return text.data();
}

const char* unit_of_reference(const Row& r) {
  const auto mode = static_cast<Mode>(r.mode);
  return mode == Mode::power || is_led(mode) ? "W" : "m";
}

void print_last(Lines& lines, const Row& r) {
  lines.add("  just before: %s, %s, limited by %s; position %s m, reference %s %s",
            recorder::state_name(r.state).c_str(), recorder::mode_name(r.mode).c_str(),
            recorder::limit_name(r.limited_by).c_str(), number(r.position_m).c_str(),
            number(r.reference).c_str(), unit_of_reference(r));
  lines.add("  just before: supply %s V, current %s A, resistance %s Ohm, %s s old",
            number(r.supply_V).c_str(), number(r.current_A).c_str(),
            number(r.resistance_Ohm).c_str(), number(r.resistance_age_s).c_str());
  for (const auto& [flag, what] :
       {std::pair{row_proof_off, "no proof of response"},
        std::pair{row_oscillated, "the loop had oscillated: its feedback was slower"},
        std::pair{row_slack, "slack at that joint angle, by its model"}}) {
    if ((r.flags & flag) != 0) lines.add("  just before: %s", what);
  }
}

void print_channel(Lines& lines, const recorder::Recording& recording, int number_,
                   const ChannelHistory& c) {
  lines.add("channel %d", number_ + 1);
  if (c.last_before != nullptr) print_last(lines, *c.last_before);
  if (c.powers > 0) {
    lines.add("  power: %.4g W on average before the fault, %.4g W at most", c.mean_W(),
              of(c.max_W));
  }
  if (c.hottest != nullptr) {
    lines.add("  hottest: at most %.1f C, at %.3f s", of(c.hottest->hottest_C),
              recording.time_s(*c.hottest));
  }
}

void print_margins(Lines& lines, const ChannelHistory& c, const recorder::Recording& recording) {
  if (c.margins.empty()) return;
  lines.add("  last margins up to the fault, largest first:");
  for (const Row* row : c.ranked_margins()) {
    const std::string unit = margin_unit_after(static_cast<Fault>(row->margin_selector));
    lines.add("    %-24s %6.0f %% used: %.5g of %.5g%s, at %.3f s",
              recorder::fault_name(row->margin_selector).c_str(), 100.0 * of(row->margin_used),
              without_rounding(row->margin_measured), without_rounding(row->margin_limit),
              unit.c_str(), recording.time_s(*row));
  }
}

}  // namespace

std::string summary(const recorder::Recording& recording) {
  Lines lines;
  print_fault(lines, recording);
  print_extent(lines, recording);
  print_other_faults(lines, recording);
  for (const auto& [number, channel] : channels_of(recording)) {
    print_channel(lines, recording, number, channel);
    if (number == recording.header.fault_channel) print_margins(lines, channel, recording);
  }
  return lines.take();
}

}  // namespace supercoil::operating
