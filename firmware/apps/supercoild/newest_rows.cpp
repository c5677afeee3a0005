#include "apps/supercoild/newest_rows.hpp"

#include <sstream>

#include "recorder/names.hpp"

namespace supercoil::daemon {

std::string NewestRows::describe() const {
  std::ostringstream text;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& r = rows_[i];
    text << i + 1 << ' ' << recorder::state_name(r.state) << ' ' << recorder::mode_name(r.mode)
         << ' ' << recorder::fault_name(r.fault) << ' ' << r.reference << ' ' << r.model_m << ' '
         << r.position_m << ' ' << r.applied_W << ' ' << r.coldest_C << ' ' << r.hottest_C << ' '
         << r.progress << ' ' << recorder::result_name(r.result) << ' '
         << (r.identify_notes == 0 ? "-" : describe_notes(r.identify_notes, ",")) << '\n';
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
