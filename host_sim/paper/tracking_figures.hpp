// Figures 3 and 4 from the loops' curves.
#pragma once

#include <cmath>
#include <vector>

#include "paper/experiment.hpp"
#include "paper/reproduction.hpp"

namespace supercoil::host_sim::paper {

/// One loop, every 100th tick.
struct LoopCurves {
  std::vector<double> time_s;
  std::vector<double> reference;
  std::vector<double> position;
  std::vector<double> error;

  void add(const Moment& m) {
    if (std::llround(m.time_s / step_s) % 100 != 0) return;
    time_s.push_back(m.time_s);
    reference.push_back(m.reference);
    position.push_back(m.position);
    error.push_back(m.position - m.target);
  }
};

struct SignalCurves {
  LoopCurves pi;
  LoopCurves pdff;
  LoopCurves mrac_printed;  ///< Eq. (8), printed gains, saturated
  LoopCurves mrac_fast;     ///< wm16, gains × 200
};

struct TrackingCurves {
  SignalCurves sine;
  SignalCurves step;
};

std::vector<NamedFigure> tracking_figures(const TrackingCurves& curves);

}  // namespace supercoil::host_sim::paper
