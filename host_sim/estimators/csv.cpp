#include <cmath>

#include "estimators/measures.hpp"
#include "estimators/results.hpp"

namespace supercoil::host_sim::estimators {

namespace {

std::string csv_line(const std::string& head, std::string_view measure,
                     const control::Theta& values) {
  std::string line = head + "," + std::string(measure);
  for (const double value : values) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.9g", value);
    line += "," + std::string(std::isnan(value) ? "" : text.data());
  }
  return line + "\n";
}

}  // namespace

std::string to_csv(const Outcomes& outcomes, const AllBounds& bounds) {
  std::string csv = "trial,estimator,seed,measure,theta1,theta2,theta3,theta4\n";
  for (std::size_t i = 0; i < trials.size(); ++i) {
    if (!bounds[i]) continue;
    for (const Measure& measure : measures) {
      csv += csv_line(std::string(trials[i].name) + ",bound,0", measure.name,
                      (*bounds[i]).*measure.bound * measure.shown_unit);
    }
  }
  for (const auto& [key, outcome] : outcomes) {
    const std::string head = std::string(trials[key.trial].name) + "," +
                             std::string(contenders[key.contender].name) + "," +
                             std::to_string(key.seed);
    for (const Measure& measure : measures)
      csv += csv_line(head, measure.name, outcome.*measure.value * measure.shown_unit);
    csv += csv_line(head, "reported_rms_percent", outcome.reported_rms * 100.0);
  }
  return csv;
}

}  // namespace supercoil::host_sim::estimators
