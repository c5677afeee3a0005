#include "apps/supercoild/newest_rows.hpp"

#include <cmath>
#include <sstream>

#include "recorder/names.hpp"

namespace supercoil::daemon {

namespace {

std::string_view kind_of(const Loop& loop, std::size_t channel, std::size_t place) {
  constexpr std::size_t kind = 0;
  const double value = loop.channel(channel).tuner().value(TuningSet::in_use, place, kind);
  return std::isnan(value) ? "-" : control::controller_names[static_cast<std::size_t>(value)].first;
}

}  // namespace

std::string NewestRows::describe(const Loop& loop) const {
  std::ostringstream text;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& r = rows_[i];
    text << i + 1 << ' ' << recorder::state_name(r.state) << ' ' << recorder::mode_name(r.mode)
         << ' ' << recorder::fault_name(r.fault) << ' ' << r.reference << ' ' << r.model_m << ' '
         << r.position_m << ' ' << r.applied_W << ' ' << r.coldest_C << ' ' << r.hottest_C << ' '
         << r.progress << ' ' << recorder::result_name(r.result) << ' '
         << (r.identify_notes == 0 ? "-" : describe_notes(r.identify_notes, ",")) << ' '
         << static_cast<int>(r.controller) << ' ' << kind_of(loop, i, r.controller)
         << ((r.flags & row_slack) != 0 ? " slack" : " -") << '\n';
  }
  return text.str();
}

std::string NewestRows::describe_status() const {
  std::ostringstream text;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& r = rows_[i];
    text << i + 1 << ' ' << recorder::state_name(r.state) << ' ' << recorder::fault_name(r.fault)
         << ' ' << ((r.flags & row_probing) != 0 ? "probing" : "-") << '\n';
  }
  return text.str();
}

}  // namespace supercoil::daemon
