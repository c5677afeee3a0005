#include <cmath>

#include <nlohmann/json.hpp>

#include "apps/supercoil/identify/findings.hpp"

namespace supercoil::operating {

namespace {

using identification::EvaluatedModel;
using identification::Fit;
using Json = nlohmann::ordered_json;

Json parameters_of(const Fit& fit) {
  Json result = Json::object();
  for (std::size_t i = 0; i < fit.parameters.size(); ++i) {
    const auto& parameter = fit.parameters[i];
    if (!parameter.of_muscle) continue;
    result[std::string(parameter.name)] = {{"value", fit.muscle.*parameter.member},
                                           {"deviation", fit.deviation(i)},
                                           {"determined", is_determined(fit, i)}};
  }
  return result;
}

Json model_of(const EvaluatedModel& model) {
  return {{"model", name(model.fit.effects)},
          {"fitted_rms_m", model.fitted_rms_m},
          {"left_out_rms_m", model.fit.cross_validated_m},
          {"unseen_rms_m", model.unseen_rms_m},
          {"fitted_explained", model.fitted_explained},
          {"unseen_explained", model.unseen_explained},
          {"parameters", parameters_of(model.fit)}};
}

Json vector_of(const control::Vector<double, 4>& values) {
  return {values[0], values[1], values[2], values[3]};
}

}  // namespace

std::string json_report(const Findings& f) {
  const auto& c = f.comparison;
  Json models = Json::array();
  for (const EvaluatedModel& model : c.models)
    models.push_back(model_of(model));
  Json result{{"file", f.file},
              {"stroke_m", c.sizes.stroke_m},
              {"max_W", c.sizes.full_W},
              {"fitted_s", {c.parts.fitted.from_s, c.parts.fitted.to_s}},
              {"unseen_s", {c.parts.unseen.from_s, c.parts.unseen.to_s}},
              {"unseen_stroke_ratio", c.unseen_stroke_ratio},
              {"models", models},
              {"transformation", model_of(c.transformation)},
              {"is_muscle", c.rejection_reason.empty()}};
  if (!c.rejection_reason.empty()) {
    result["reason"] = c.rejection_reason;
    return result.dump() + "\n";
  }
  const auto change = identification::max_change(f.linear_first, f.linear);
  const auto theta = identification::theta_of(f.linear, f.assumed);
  result["chosen"] = name(c.best().fit.effects);
  result["whole"] = parameters_of(f.whole);
  result["linear_fitted"] = parameters_of(f.linear_first);
  result["linear_whole"] = parameters_of(f.linear);
  result["change"] = {{"parameter", f.linear.parameters[change.parameter].name},
                      {"ratio", change.ratio},
                      {"deviations", change.deviations}};
  result["theta"] = vector_of(theta.theta);
  result["theta_deviation"] = vector_of(theta.deviation);
  const auto physical = identification::physical_from(f.linear.muscle, f.assumed);
  for (const control::PhysicalRange& range : control::physical_ranges)
    result["muscle"][range.name] = physical.*range.member;
  return result.dump() + "\n";
}

}  // namespace supercoil::operating
