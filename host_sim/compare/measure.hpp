// The measures that compare runs: the true error against the controller's reference model.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "runner/summary.hpp"
#include "scenario/scenario.hpp"

namespace supercoil::host_sim::compare {

enum class MeasureKind {
  rms,       ///< root mean square, m
  max,       ///< of the error, m
  settling,  ///< from the window's begin until the error stays below settled_m, s
};

struct Measure {
  std::string_view name;  ///< its unit is the last part
  MeasureKind kind;
  std::string_view meaning;
};

inline constexpr double settled_m = 200e-6;

/// Every measure that there is. A run has those for which its scenario has room.
inline constexpr std::array<Measure, 8> measures{{
    {"start_rms_m", MeasureKind::rms, "0 to 3 s, without an event"},
    {"early_rms_m", MeasureKind::rms, "3 to 10 s, without an event"},
    {"learned_rms_m", MeasureKind::rms, "10 to 20 s, without an event"},
    {"steady_rms_m", MeasureKind::rms,
     "the last 1.6 periods or two holds (40 s of the paper's) before the first event or the end"},
    {"changed_rms_m", MeasureKind::rms, "the first 10 s after the first event"},
    {"peak_m", MeasureKind::max, "the largest error within 60 s after the first event"},
    {"settling_s", MeasureKind::settling,
     "from the first event until the error stays below 0.2 mm"},
    {"after_rms_m", MeasureKind::rms, "from 60 s after the first event to the end"},
}};

/// Of one run, in the order of `measures`; NaN: not available. Infinite: the muscle no longer
/// followed (a fault), or never settled.
using Values = std::array<double, measures.size()>;

/// Each measure's window in this scenario, empty (from_s >= to_s) if there is no room for it.
std::array<Window, measures.size()> windows_of(const Scenario& scenario);

/// Computes the measures of a run as it goes.
class Meters {
 public:
  explicit Meters(const Scenario& scenario);

  void add(const TickRecord& record);
  Values values() const;

 private:
  struct Meter {
    Window window;
    ErrorMeter errors;
    double outside_until_s = 0.0;  ///< the end of the last tick whose error was not below settled_m
    double end_s = 0.0;
    bool lost = false;
  };
  double value(std::size_t measure) const;

  double step_s_;
  std::array<Meter, measures.size()> meters_;
};

}  // namespace supercoil::host_sim::compare
