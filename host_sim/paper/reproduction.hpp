// The parts of the paper that the program reproduces.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "paper/reproduction_row.hpp"
#include "plot/figure.hpp"

namespace supercoil::host_sim::paper {

struct NamedFigure {
  std::string name;  ///< the file's stem
  std::string title;
  std::string caption;
  Figure figure;
};

struct Part {
  std::string title;
  std::string introduction;
  std::vector<ReproductionRow> rows;
  std::vector<NamedFigure> figures;
};

/// Figure 2: the gradient estimator.
Part repeat_estimation();
/// Figures 3 and 4: PI, PD with feedforward and MRAC, before and after the muscle softens.
Part repeat_tracking();
/// What the paper prints and what its own equations give.
Part compute_errata();
/// The same controllers on a muscle of true size, with noise, quantisation and limits.
Part run_physical();
/// Double against fixed point on the physical muscle.
Part compare_arithmetic();

/// All parts in order. progress: called before each part with its place (0 to 1).
std::vector<Part> reproduce(const std::function<void(double)>& progress);

}  // namespace supercoil::host_sim::paper
