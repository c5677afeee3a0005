// Plots, described as data and drawn by gnuplot.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "supercoil/hal/error.hpp"

namespace supercoil {

struct Curve {
  std::string label;
  std::vector<double> x;
  std::vector<double> y;  ///< a value that is not finite leaves a gap
  bool dashed = false;
  /// Index into the figure's colours; a colour means the same in every panel.
  int colour = 0;
  /// Not empty: points at y with bars up to here, instead of a line.
  std::vector<double> bars_to{};
  bool points = false;  ///< instead of a line
};

struct Panel {
  std::string title;
  std::string x_label = "time (s)";
  std::string y_label;
  std::vector<Curve> curves;
  double y_low = 0.0;  ///< equal to y_high: chosen by gnuplot
  double y_high = 0.0;
  bool x_logarithmic = false;  ///< values must be above 0
  bool y_logarithmic = false;
  /// Not empty: labels at x = 0, 1, …; y is then logarithmic.
  std::vector<std::string> x_names{};
  double x_low = 0.0;  ///< equal to x_high: as far as the curves go
  double x_high = 0.0;
  /// Not empty: labels at y = 0, 1, …
  std::vector<std::string> y_names{};
};

struct Figure {
  std::vector<Panel> panels;
  int columns = 1;
  int width_px = 900;
  int panel_height_px = 240;
};

/// gnuplot's input for the figure, data included.
std::string gnuplot_script(const Figure& figure, const std::filesystem::path& svg);

/// Draws the figure as SVG. The error quotes gnuplot, or says how to install it.
Result<void> draw(const Figure& figure, const std::filesystem::path& svg);

}  // namespace supercoil
