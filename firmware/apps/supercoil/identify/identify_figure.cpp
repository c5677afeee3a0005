#include <algorithm>

#include "apps/supercoil/identify/findings.hpp"

namespace supercoil::operating {

namespace {

constexpr std::size_t max_points = 2000;
constexpr double in_mm = 1e3;
constexpr double in_um = 1e6;

template <class Value>
Curve curve_over(const identification::Samples& samples, const char* label, int colour,
                 const Value& value) {
  Curve curve{label, {}, {}, false, colour, {}};
  const std::size_t every = std::max<std::size_t>(1, samples.size() / max_points);
  for (std::size_t k = 0; k < samples.size(); k += every) {
    curve.x.push_back(samples.time_s(k));
    curve.y.push_back(value(k));
  }
  return curve;
}

}  // namespace

Figure identify_figure(const Findings& f) {
  const identification::Samples& s = f.samples;
  const auto& c = f.comparison;
  const auto& best = c.rejection_reason.empty() ? c.best().fit : c.transformation.fit;
  const auto& linear = c.models.front().fit;
  const auto curve = [&](const char* label, int colour, auto value) {
    return curve_over(s, label, colour, value);
  };
  const std::string title = f.file + ": " + name(best.effects) + ", fitted to " +
                            std::to_string(static_cast<int>(c.parts.fitted.from_s)) + " to " +
                            std::to_string(static_cast<int>(c.parts.fitted.to_s)) + " s";
  Figure figure;
  figure.panels.push_back(
      {title,
       "",
       "mm",
       {curve("measured", 6, [&](std::size_t k) { return s.position_m[k] * in_mm; }),
        curve("linear", 1, [&](std::size_t k) { return linear.predicted_m[k] * in_mm; }),
        curve("predicted", 0, [&](std::size_t k) { return best.predicted_m[k] * in_mm; })}});
  const auto left = [&](const identification::Fit& fit) {
    return [&](std::size_t k) { return (s.position_m[k] - fit.predicted_m[k]) * in_um; };
  };
  figure.panels.push_back({"measured − predicted",
                           "",
                           "µm",
                           {curve("linear", 1, left(linear)), curve("predicted", 0, left(best))}});
  figure.panels.push_back(
      {"power", "time (s)", "W", {curve("power", 3, [&](std::size_t k) { return s.power_W[k]; })}});
  return figure;
}

}  // namespace supercoil::operating
