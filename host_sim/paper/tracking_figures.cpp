#include "paper/tracking_figures.hpp"

#include <algorithm>

namespace supercoil::host_sim::paper {

namespace {

struct Span {
  double from_s;
  double to_s;
};

Curve cut(const char* label, const LoopCurves& loop, const std::vector<double>& values, Span span,
          int colour, bool dashed = false) {
  Curve curve{label, {}, {}, dashed, colour};
  for (std::size_t i = 0; i < loop.time_s.size(); ++i) {
    if (loop.time_s[i] < span.from_s || loop.time_s[i] > span.to_s) continue;
    curve.x.push_back(loop.time_s[i]);
    curve.y.push_back(values[i]);
  }
  return curve;
}

/// The controllers of one signal over one span: positions and errors.
void add_panels(Figure& figure, const SignalCurves& c, Span span, char letter, double low,
                double high, double error_limit) {
  const std::string first = std::string("(") + letter + ") position";
  const std::string second = std::string("(") + static_cast<char>(letter + 1) + ") error";
  figure.panels.push_back(
      {first,
       "time (s)",
       "paper's m",
       {cut("reference", c.pi, c.pi.reference, span, 6, true),
        cut("PI", c.pi, c.pi.position, span, 1), cut("PDff", c.pdff, c.pdff.position, span, 2),
        cut("MRAC, as printed", c.mrac_printed, c.mrac_printed.position, span, 0),
        cut("MRAC, wm16 x 200", c.mrac_fast, c.mrac_fast.position, span, 3)},
       low,
       high});
  figure.panels.push_back(
      {second,
       "time (s)",
       "paper's m",
       {cut("PI", c.pi, c.pi.error, span, 1), cut("PDff", c.pdff, c.pdff.error, span, 2),
        cut("MRAC, as printed", c.mrac_printed, c.mrac_printed.error, span, 0),
        cut("MRAC, wm16 x 200", c.mrac_fast, c.mrac_fast.error, span, 3)},
       -error_limit,
       error_limit});
}

}  // namespace

std::vector<NamedFigure> tracking_figures(const TrackingCurves& curves) {
  Figure three;
  three.columns = 2;
  three.width_px = 1000;
  three.panel_height_px = 320;
  Figure four = three;
  const Span before{0.0, change_at_s};
  const Span around{60.0, 130.0};
  add_panels(three, curves.sine, before, 'a', -0.5, 3.0, 0.5);
  add_panels(three, curves.step, before, 'c', -0.1, 2.0, 0.1);
  add_panels(four, curves.sine, around, 'a', -1.0, 4.0, 0.2);
  add_panels(four, curves.step, around, 'c', 0.5, 1.6, 0.1);
  return {{"figure3", "Figure 3: three controllers, known muscle",
           "Sine (a, b) and step (c, d). Errors are against r for PI and PDff, against the "
           "reference model for MRAC, as in the paper.",
           three},
          {"figure4", "Figure 4: the muscle softens at 80 s",
           "The same loops around the change. The PI loop is unstable afterwards.", four}};
}

}  // namespace supercoil::host_sim::paper
