#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/control/linear/matrix_functions.hpp"
#include "supercoil/control/tracking/mrac.hpp"
#include "supercoil/control/tracking/mrac_matching.hpp"
#include "supercoil/control/tracking/mrac_premises.hpp"

#include "paper/experiment.hpp"
#include "paper/reproduction.hpp"
#include "scenario/reference.hpp"
#include "text/documentation.hpp"

namespace supercoil::host_sim::paper {

namespace {

using control::Mrac;
using control::MracSettings;
using control::PhysicalParameters;
using Complex = std::complex<double>;

/// Roots of s³ + c2 s² + c1 s + c0: the real one first, then the one above the real axis.
std::array<Complex, 2> roots(double c2, double c1, double c0) {
  Eigen::Matrix3d companion;
  companion << -c2, -c1, -c0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0;
  const Eigen::VectorXcd values = control::eigenvalues(companion);
  std::array<Complex, 2> result;
  for (const Complex& value : values) {
    if (std::abs(value.imag()) < 1e-9) result[0] = value;
    if (value.imag() > 1e-9) result[1] = value;
  }
  return result;
}

std::string pair_shown(const Complex& value) {
  return paper::shown(value.real()) + " ± " + paper::shown(std::abs(value.imag())) + "j";
}

void add_coefficients(Part& part) {
  const PhysicalParameters p;
  const control::TransferFunction f = control::transfer_function_from(p);
  const double mass = p.moving_mass_kg;
  part.rows.push_back({"errata.b3", "Eq. (5)", "b3 = γ/(ψm̂)", "", "0.0048", shown(f.b3), ""});
  part.rows.push_back({"errata.b3", "as printed", "γ·m̂/ψ", "", "0.0048",
                       shown(p.force_per_kelvin_N_per_K * mass / p.thermal_mass_J_per_K),
                       "what was computed instead of Eq. (5)"});
  part.rows.push_back({"errata.numerator", "used in Sec. 5.2", "1/(ψm̂)", "", "",
                       shown(1.0 / (p.thermal_mass_J_per_K * mass)),
                       "gives the printed PI and PD errors: position there is x/γ"});
  part.rows.push_back({"errata.b0", "Eq. (5)", "b0", "", "97.67", shown(f.b0), ""});
  part.rows.push_back({"errata.b1", "Eq. (5)", "b1", "", "189.99", shown(f.b1), ""});
  part.rows.push_back({"errata.b2", "Eq. (5)", "b2", "", "22.77", shown(f.b2), ""});
  const control::Theta theta = control::theta_from(p);
  const std::array<const char*, 4> printed{"18.84", "38.61", "322.10", "165.58"};
  for (int i = 0; i < 4; ++i) {
    const std::string name = "theta" + std::to_string(i + 1);
    part.rows.push_back({"errata." + name, "divided by γ", "θ" + std::to_string(i + 1), "",
                         printed[static_cast<std::size_t>(i)], shown(theta[i]),
                         "the text says z = γP/Λ; these are for z = P/Λ"});
  }
  PhysicalParameters softer;
  softer.stiffness_N_per_m = stiffness_after_N_per_m;
  const control::TransferFunction after = control::transfer_function_from(softer);
  part.rows.push_back({"errata.perturbation.b0", "ϱ = 12", "b0", "", "73.25", shown(after.b0),
                       "the change at 80 s is the stiffness alone"});
  part.rows.push_back(
      {"errata.perturbation.b1", "ϱ = 12", "b1", "", "145.54", shown(after.b1), ""});
}

/// How far the maximum of a model's step response exceeds its final value, in percent.
double overshoot_percent(const control::ReferenceModelSettings& settings) {
  control::ReferenceModel<double> model(settings, step_s);
  double highest = 0.0;
  for (int tick = 0; tick < 60000; ++tick) {
    model.step(1.0);
    highest = std::fmax(highest, model.motion().position);
  }
  return (highest / settings.dc_gain() - 1.0) * 100.0;
}

void add_models(Part& part) {
  const auto eq8 = control::eq8_model();
  const auto pole = roots(eq8.denominator[2], eq8.denominator[1], eq8.denominator[0]);
  const double damping = -pole[1].real() / std::abs(pole[1]);
  const double formula =
      100.0 * std::exp(-std::numbers::pi * damping / std::sqrt(1.0 - damping * damping));
  part.rows.push_back({"errata.eq8.damping", "Eq. (8)", "damping ratio ζ", "", "overshoot < 5 %",
                       shown(damping), "the text's 5 % needs 0.69"});
  part.rows.push_back({"errata.eq8.poles", "Eq. (8)", "dominant poles", "rad/s", "-0.093 ± 1.1j",
                       pair_shown(pole[1]), ""});
  part.rows.push_back({"errata.eq8.real_pole", "Eq. (8)", "real pole", "rad/s", "0.81",
                       shown(pole[0].real()), "printed without its sign"});
  part.rows.push_back({"errata.eq8.overshoot", "second-order formula", "overshoot", "%", "< 5",
                       shown(formula), ""});
  part.rows.push_back({"errata.eq8.overshoot", "simulated step", "overshoot", "%", "< 5",
                       shown(overshoot_percent(eq8)), ""});
  part.rows.push_back({"errata.eq8.overshoot", "design", "overshoot", "%", "< 5",
                       shown(overshoot_percent(control::design_model())),
                       "0.8/(s³ + 2.18s² + 2.104s + 0.8): what the text describes"});
  const double natural = 1.0;
  const double q0 = 0.8;
  part.rows.push_back({"errata.eq7.dc_gain", "Eq. (7)", "DC gain ωn²/(ωn² q0)", "", "1",
                       shown(natural * natural / (natural * natural * q0)),
                       "its numerator must be ωn² q0"});
}

void add_premises(Part& part) {
  const MracSettings printed;
  for (const char* name : {"eq8", "design", "wm16"}) {
    const auto model = control::reference_model_named(name).value();
    const auto premises = control::check_premises(printed, model);
    part.rows.push_back({"errata.wm.spr", name, "Wm(s)(s+p0)(s+p1) strictly positive real", "",
                         "assumed", premises.realness.strict() ? "yes" : "no",
                         premises.realness.high_frequency ? "" : "Re G < 0 at high frequency"});
    part.rows.push_back({"errata.eq12", name, "Wm(s)(s+p0)(s+p1) = k/(s+q0)", "", "assumed",
                         premises.model_factors ? "yes" : "no", ""});
  }
  PhysicalParameters unit;
  unit.force_per_kelvin_N_per_K = 1.0;
  const auto plant = control::transfer_function_from(unit);
  for (const char* name : {"eq8", "design", "wm16"}) {
    const auto model = control::reference_model_named(name).value();
    const auto matched = control::match(plant, printed, model);
    part.rows.push_back({"errata.compensator", name,
                         "d1 + a2m, necessary for a stable compensator: > b2 = 22.77", "rad/s", "",
                         shown(printed.lambda[1] + model.denominator[2]),
                         matched->compensator_stable ? "stable" : "compensator unstable"});
  }
  const auto a = control::mrac_preset("a").value();
  const auto wm16 = control::wm16_model();
  part.rows.push_back(
      {"errata.compensator", "preset a", "d1 + a2m", "rad/s", "",
       shown(a.lambda[1] + wm16.denominator[2]),
       control::match(plant, a, wm16)->compensator_stable ? "stable" : "compensator unstable"});
}

/// The largest |u/((s+p0)(s+p1)) − θᵀφ − r0| over the largest |u/((s+p0)(s+p1))|: what Eq. (17) is
/// made to keep at zero.
double damping_identity_error(const control::PowerRange& range) {
  const MracSettings settings = MracSettings{}.scaled(10.0);
  Mrac<double> mrac(settings, step_s);
  control::OnePoleBank<double, 1> first(settings.p1_rad_per_s, step_s, {true});
  control::OnePoleBank<double, 1> second(settings.p0_rad_per_s, step_s, {false});
  double largest = 0.0;
  double scale = 0.0;
  run(
      [&](const control::LawInput<double>& in) {
        first.step(control::Vector<double, 1>(in.applied));
        second.step(first.state());
        const double r0 = mrac.r0();
        const control::Vector<double, 6> theta = mrac.theta();
        const double demanded = mrac.step(in);
        const double filtered = second.state()[0];
        largest = std::fmax(largest, std::abs(filtered - theta.dot(mrac.phi()) - r0));
        scale = std::fmax(scale, std::abs(filtered));
        return demanded;
      },
      Target::model, control::wm16_model(), Signal::sine, range, [](const Moment&) {});
  return largest / scale;
}

void add_damping_identity(Part& part) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  part.rows.push_back({"errata.eq17", "not clipped", "largest relative |uf − θᵀφ − r0|", "", "0",
                       shown(damping_identity_error({-infinity, infinity})),
                       "Eq. (17) is right: only the discretisation error remains"});
  part.rows.push_back({"errata.eq16", "clipped", "largest relative |uf − θᵀφ − r0|", "", "0",
                       shown(damping_identity_error({0.0, 4.5})),
                       "the r0 equation holds only while the power is not clipped"});
}

void add_signals(Part& part) {
  const Reference excitation = paper_excitation();
  const double period_s = 8.0 * std::numbers::pi;
  const int samples = 1000000;
  double lowest = 1e9;
  double highest = -1e9;
  int above = 0;
  for (int i = 0; i < samples; ++i) {
    const double power = excitation.at(period_s * i / samples);
    lowest = std::fmin(lowest, power);
    highest = std::fmax(highest, power);
    above += power > 4.5 ? 1 : 0;
  }
  part.rows.push_back(
      {"errata.power.range", "least", "P(t) of Eq. (18)", "W", "0", shown(lowest), ""});
  part.rows.push_back({"errata.power.range", "greatest", "P(t) of Eq. (18)", "W", "4.5",
                       shown(highest), "the text: 4.5 W peak to peak"});
  part.rows.push_back({"errata.power.range", "above 4.5 W", "fraction of the time", "%", "0",
                       shown(100.0 * above / samples), ""});

  PhysicalParameters unit;
  unit.force_per_kelvin_N_per_K = 1.0;
  const auto f = control::transfer_function_from(unit);
  const Complex s(0.0, 0.25);
  const Complex inverse_plant = (((s + f.b2) * s + f.b1) * s + f.b0) / f.b3;
  for (const char* name : {"eq8", "design", "wm16"}) {
    const auto model = control::reference_model_named(name).value();
    const auto& d = model.denominator;
    const Complex answer = model.gain / (((s + d[2]) * s + d[1]) * s + d[0]);
    part.rows.push_back({"errata.reference.negative_power", name,
                         "minimum power needed to follow the sine", "W", ">= 0",
                         shown(1.01 * f.b0 / f.b3 - std::abs(inverse_plant * answer)),
                         "with Eq. (19) active the model cannot be followed"});
  }
}

void add_scale(Part& part) {
  const PhysicalParameters p;
  const auto f = control::transfer_function_from(p);
  const auto pole = roots(f.b2, f.b1, f.b0);
  const double full_W = 4.5;
  part.rows.push_back({"errata.scale.dc_gain", "true units", "position held per watt", "mm/W", "",
                       shown(p.dc_gain_m_per_W() * 1e3), "a model of 1 m/W cannot be followed"});
  part.rows.push_back({"errata.scale.position", "true units", "position at 4.5 W", "mm", "",
                       shown(p.dc_gain_m_per_W() * full_W * 1e3), ""});
  part.rows.push_back({"errata.scale.temperature", "true units", "temperature rise at 4.5 W", "K",
                       "", shown(full_W / p.heat_transfer_W_per_K), ""});
  part.rows.push_back({"errata.scale.thermal_pole", "true units", "thermal pole", "rad/s", "",
                       shown(pole[0].real()), ""});
  part.rows.push_back({"errata.scale.mechanical_poles", "true units", "mechanical poles", "rad/s",
                       "", pair_shown(pole[1]), ""});
  // PI after the change: s⁴ + b2 s³ + b1 s² + (b0 + b3 Kp) s + b3 Ki.
  PhysicalParameters soft;
  soft.stiffness_N_per_m = stiffness_after_N_per_m;
  soft.force_per_kelvin_N_per_K = 1.0;
  const auto g = control::transfer_function_from(soft);
  Eigen::Matrix4d loop = Eigen::Matrix4d::Zero();
  loop.row(0) << -g.b2, -g.b1, -(g.b0 + 50.0 * g.b3), -2.5 * g.b3;
  loop.bottomLeftCorner<3, 3>().setIdentity();
  const Eigen::VectorXcd values = control::eigenvalues(loop);
  Complex worst = values[0];
  for (const Complex& value : values) {
    if (value.real() > worst.real()) worst = value;
  }
  part.rows.push_back({"errata.pi.perturbed_roots", "continuous loop", "least stable roots",
                       "rad/s", "unstable", pair_shown(worst), "unstable, as the paper says"});
}

}  // namespace

Part compute_errata() {
  Part part;
  part.title = "Errata";
  part.introduction =
      "What the paper prints, and what its own equations and parameters give. For the derivations "
      "see " +
      documentation_page("paper") + ".";
  add_coefficients(part);
  add_models(part);
  add_premises(part);
  add_damping_identity(part);
  add_signals(part);
  add_scale(part);
  return part;
}

}  // namespace supercoil::host_sim::paper
