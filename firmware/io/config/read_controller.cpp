#include <cmath>

#include "config/read_control.hpp"
#include "loop/settings.hpp"

namespace supercoil::config {

namespace {

using control::MracSettings;

MracSettings::Parameters read_six(Section& section, const char* key,
                                  const MracSettings::Parameters& fallback, Range range) {
  const std::vector<double> list = section.numbers(
      key, std::vector<double>(fallback.data(), fallback.data() + fallback.size()), range, 6, 6);
  return Eigen::Map<const MracSettings::Parameters>(list.data());
}

/// Both absent: no projection.
void read_bounds(Section& section, MracSettings& m) {
  constexpr Range range{-1e6, 1e6};
  const auto lower = section.numbers("lower", {}, range, 6, 6);
  const auto upper = section.numbers("upper", {}, range, 6, 6);
  if (lower.empty() && upper.empty()) return;
  using Map = Eigen::Map<const MracSettings::Parameters>;
  const MracSettings::Parameters wide = MracSettings::Parameters::Constant(range.max);
  m.bounds = control::Box<double, 6>{
      lower.empty() ? MracSettings::Parameters(-wide) : MracSettings::Parameters(Map(lower.data())),
      upper.empty() ? wide : MracSettings::Parameters(Map(upper.data()))};
  if ((m.bounds->lower.array() > m.bounds->upper.array()).any()) {
    section.wrong(section.has("lower") ? "lower" : "upper", "lower must not exceed upper");
  }
}

/// Reads lists, and what else is not a tunable.
void read_mrac_lists(Section& section, MracSettings& m) {
  const auto alpha =
      section.numbers("alpha", {m.alpha[0], m.alpha[1]}, range_of_tunable("alpha_1"), 2, 2);
  m.alpha = {alpha[0], alpha[1]};
  const auto lambda =
      section.numbers("lambda", {m.lambda[1], m.lambda[0]}, range_of_tunable("lambda_1"), 2, 2);
  m.lambda = {lambda[1], lambda[0], 1.0};
  m.gain = read_six(section, "gain", m.gain, range_of_tunable("gain_1"));
  m.initial = read_six(section, "initial", m.initial, {-1e6, 1e6});
  m.initial_sigma = section.number("initial_sigma", m.initial_sigma, {-1e6, 1e6});
  read_bounds(section, m);
  m.accept_failed_premises = section.flag("accept_failed_premises", false);
}

MracSettings read_mrac_preset(Section& section, double max_W) {
  std::vector<std::string> names;
  names.reserve(control::mrac_presets.size());
  for (const auto& [name, text] : control::mrac_presets)
    names.emplace_back(name);
  return *control::mrac_preset(section.one_of("preset", "a", std::move(names)), max_W);
}

}  // namespace

control::ControllerSettings read_controller(
    Section& section, const control::PhysicalParameters& muscle,
    const std::optional<control::ReferenceModelSettings>& model, double max_W) {
  using control::ControllerKind;
  control::ControllerSettings c;
  c.kind = section.choice("kind", c.kind, control::controller_names);
  c.set_nominal(muscle, max_W);
  // The premises of adaptive controllers hold for wm16.
  c.model =
      model.value_or(control::adapts(c.kind) ? control::wm16_model() : control::design_model());
  if (c.kind != ControllerKind::power)
    c.arithmetic = section.choice("arithmetic", c.arithmetic, control::arithmetic_names);
  const double known_W = std::isfinite(max_W) ? max_W : control::paper_max_W;
  c.mrac = c.kind == ControllerKind::mrac ? read_mrac_preset(section, known_W)
                                          : *control::mrac_preset("a", known_W);
  read_tunables(section, c);
  if (c.kind == ControllerKind::mrac) read_mrac_lists(section, c.mrac);
  for (const SettingsProblem& problem : contradictions(c))
    section.wrong(problem.key, problem.message);
  section.finish();
  return c;
}

}  // namespace supercoil::config
