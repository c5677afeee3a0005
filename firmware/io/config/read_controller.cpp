#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/control/tracking/mrac_premises.hpp"

#include "config/read_control.hpp"

namespace supercoil::config {

namespace {

using control::MracSettings;

MracSettings::Parameters read_six(Section& section, const char* key,
                                  const MracSettings::Parameters& fallback, Range range) {
  const std::vector<double> list = section.numbers(
      key, std::vector<double>(fallback.data(), fallback.data() + fallback.size()), range, 6, 6);
  return Eigen::Map<const MracSettings::Parameters>(list.data());
}

void read_mrac_constants(Section& section, MracSettings& m) {
  const auto alpha = section.numbers("alpha", {m.alpha[0], m.alpha[1]}, {1e-6, 1e6}, 2, 2);
  m.alpha = {alpha[0], alpha[1]};
  const auto lambda = section.numbers("lambda", {m.lambda[1], m.lambda[0]}, {-1e6, 1e6}, 2, 2);
  m.lambda = {lambda[1], lambda[0], 1.0};
  m.p0_rad_per_s = section.number("p0_rad_per_s", m.p0_rad_per_s, {-1e3, 1e3});
  m.p1_rad_per_s = section.number("p1_rad_per_s", m.p1_rad_per_s, {-1e3, 1e3});
  m.q0_rad_per_s = section.number("q0_rad_per_s", m.q0_rad_per_s, {-1e3, 1e3});
  m.gain = read_six(section, "gain", m.gain, {-1e9, 1e9});
  m.sigma_gain = section.number("sigma_gain", m.sigma_gain, {-1e9, 1e9});
  m.damping = section.number("damping", m.damping, {-1e6, 1e6});
  m.initial = read_six(section, "initial", m.initial, {-1e6, 1e6});
  m.initial_sigma = section.number("initial_sigma", m.initial_sigma, {-1e6, 1e6});
  m.freeze_when_limited = section.flag("freeze_when_limited", m.freeze_when_limited);
  m.sigma_modification = section.number("sigma_modification", m.sigma_modification, {0.0, 1e3});
  m.dead_zone_W = section.number("dead_zone_W", m.dead_zone_W, {0.0, 1e3});
  const MracSettings::Parameters wide = MracSettings::Parameters::Constant(1e6);
  const bool bounded = section.has("lower") || section.has("upper");
  const auto lower = read_six(section, "lower", -wide, {-1e6, 1e6});
  const auto upper = read_six(section, "upper", wide, {-1e6, 1e6});
  if ((lower.array() > upper.array()).any()) {
    section.wrong(section.has("lower") ? "lower" : "upper", "lower must not exceed upper");
  }
  if (bounded) m.bounds = control::Box<double, 6>{lower, upper};
}

MracSettings read_mrac(Section& section, const control::ReferenceModelSettings& model) {
  const std::string preset = section.text("preset", "a");
  MracSettings m;
  if (const auto named = control::mrac_preset(preset)) {
    m = *named;
  } else {
    std::string names;
    for (const auto& [name, text] : control::mrac_presets) {
      names += (names.empty() ? "" : ", ") + std::string(name);
    }
    section.wrong("preset", "must be one of: " + names);
  }
  m = m.scaled(section.number("adaptation_scale", 1.0, {1e-6, 1e6}));
  read_mrac_constants(section, m);
  const bool accepted = section.flag("accept_failed_premises", false);
  if (!accepted) {
    for (const char* failure : control::check_premises(m, model).failures()) {
      if (failure == nullptr) continue;
      section.wrong("kind", std::string("premise fails: ") + failure +
                                " (accept_failed_premises = true runs it nevertheless)");
    }
  }
  return m;
}

control::MracLeastSquaresSettings read_mrac_ls(Section& section,
                                               const control::RegressionScale& nominal) {
  control::MracLeastSquaresSettings m;
  m.scale = nominal;
  m.filter_rad_per_s = section.number("filter_rad_per_s", m.filter_rad_per_s, {0.5, 100.0});
  m.regression_rad_per_s =
      section.number("regression_rad_per_s", m.regression_rad_per_s, {0.5, 100.0});
  m.forgetting_s = section.number("forgetting_s", m.forgetting_s, {1.0, 3600.0});
  m.change_W = section.number("change_W", m.change_W, {1e-6, 1e3});
  m.hold_s = section.number("hold_s", m.hold_s, {0.0, 3600.0});
  m.follow_s = section.number("follow_s", m.follow_s, {0.02, 3600.0});
  m.bandwidth_rad_per_s =
      section.number("bandwidth_rad_per_s", m.bandwidth_rad_per_s, {0.0, 100.0});
  m.derivative_filter_rad_per_s =
      section.number("derivative_filter_rad_per_s", m.derivative_filter_rad_per_s, {0.1, 1e4});
  return m;
}

control::LearnedFeedforwardSettings read_learned_ff(Section& section,
                                                    const control::RegressionScale& nominal,
                                                    double max_W) {
  control::LearnedFeedforwardSettings l;
  l.scale = nominal;
  if (std::isfinite(max_W)) l.max_W = max_W;
  l.bandwidth_rad_per_s =
      section.number("bandwidth_rad_per_s", l.bandwidth_rad_per_s, {0.01, 100.0});
  l.derivative_filter_rad_per_s =
      section.number("derivative_filter_rad_per_s", l.derivative_filter_rad_per_s, {0.1, 1e4});
  l.follow_s = section.number("follow_s", l.follow_s, {0.02, 3600.0});
  l.forgetting_s = section.number("forgetting_s", l.forgetting_s, {1.0, 3600.0});
  l.learn = section.flag("learn", l.learn);
  l.period_s = section.number("period_s", l.period_s, {0.0, 600.0});
  if (l.period_s > 0.0 && l.period_s < 2.0)
    section.wrong("period_s", "must be 0 (the reference does not repeat itself) or 2 to 600");
  l.find_period = section.flag("find_period", l.find_period);
  if (l.find_period && l.period_s > 0.0)
    section.wrong("find_period", "must be false where period_s is given");
  return l;
}

}  // namespace

control::ControllerSettings read_controller(
    Section& section, const control::PhysicalParameters& muscle,
    const std::optional<control::ReferenceModelSettings>& model, double max_W) {
  using control::ControllerKind;
  control::ControllerSettings c;
  c.kind = section.choice("kind", c.kind, control::controller_names);
  c.dc_gain_m_per_W = muscle.dc_gain_m_per_W();
  const control::RegressionScale nominal{control::theta_from(muscle), c.dc_gain_m_per_W,
                                         muscle.moving_mass_kg};
  const bool is_mrac = c.kind == ControllerKind::mrac || c.kind == ControllerKind::mrac_ls;
  c.model = model.value_or(is_mrac ? control::wm16_model() : control::design_model());
  if (c.kind != ControllerKind::power) {
    c.arithmetic = section.choice("arithmetic", c.arithmetic, control::arithmetic_names);
    if (!control::supported(c.kind, c.arithmetic)) {
      section.wrong("arithmetic",
                    "must be double or float: the covariance of " +
                        std::string(control::name_of(control::controller_names, c.kind)) +
                        " does not fit q8.24");
    }
    if (section.flag("shape_reference", false)) c.shaped_for = nominal;
    if (!is_mrac)
      c.slow_when_oscillating = section.flag("slow_when_oscillating", c.slow_when_oscillating);
  }
  if (c.kind == ControllerKind::pi) {
    c.pi.proportional_W_per_m =
        section.number("proportional_W_per_m", c.pi.proportional_W_per_m, {0.0, 1e7});
    c.pi.integral_W_per_m_s =
        section.number("integral_W_per_m_s", c.pi.integral_W_per_m_s, {0.0, 1e7});
  } else if (c.kind == ControllerKind::pd_ff) {
    control::PdFeedforwardSettings& pd = c.pd_ff;
    pd.feedforward_W_per_m = 1.0 / c.dc_gain_m_per_W;
    pd.proportional_W_per_m =
        section.number("proportional_W_per_m", pd.proportional_W_per_m, {0.0, 1e7});
    pd.derivative_Ws_per_m =
        section.number("derivative_Ws_per_m", pd.derivative_Ws_per_m, {0.0, 1e7});
    pd.feedforward_W_per_m =
        section.number("feedforward_W_per_m", pd.feedforward_W_per_m, {0.0, 1e7});
    pd.derivative_filter_rad_per_s =
        section.number("derivative_filter_rad_per_s", pd.derivative_filter_rad_per_s, {0.1, 1e4});
  } else if (c.kind == ControllerKind::adaptive_ff) {
    control::AdaptiveFeedforwardSettings& a = c.adaptive_ff;
    a.scale = nominal;
    a.bandwidth_rad_per_s =
        section.number("bandwidth_rad_per_s", a.bandwidth_rad_per_s, {0.01, 100.0});
    a.derivative_filter_rad_per_s =
        section.number("derivative_filter_rad_per_s", a.derivative_filter_rad_per_s, {0.1, 1e4});
    a.follow_s = section.number("follow_s", a.follow_s, {0.02, 3600.0});
  } else if (c.kind == ControllerKind::learned_ff) {
    c.learned_ff = read_learned_ff(section, nominal, max_W);
  } else if (c.kind == ControllerKind::mrac_ls) {
    c.mrac_ls = read_mrac_ls(section, nominal);
  } else if (c.kind == ControllerKind::mrac) {
    c.mrac = read_mrac(section, c.model);
  }
  section.finish();
  return c;
}

}  // namespace supercoil::config
