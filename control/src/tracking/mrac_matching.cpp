#include "supercoil/control/tracking/mrac_matching.hpp"

#include "supercoil/control/actuator/conversions.hpp"

namespace supercoil::control {

std::optional<MracMatching> match(const TransferFunction& plant, const MracSettings& settings,
                                  const ReferenceModelSettings& model) {
  if (!(plant.b3 > 0.0) || settings.alpha[0] == 0.0 || settings.alpha[1] == 0.0) {
    return std::nullopt;
  }
  const Polynomial<2>& l = settings.lambda;
  const Polynomial<3>& m = model.denominator;
  const Polynomial<3> r{plant.b0, plant.b1, plant.b2, 1.0};
  // λ Rm, ascending.
  std::array<double, 6> target{};
  for (std::size_t i = 0; i < l.size(); ++i) {
    for (std::size_t j = 0; j < m.size(); ++j)
      target[i + j] += l[i] * m[j];
  }
  // C = s² + c1 s + c0 follows from the powers 4 and 3, to which y's own filters add nothing.
  const double c1 = target[4] - r[2];
  const double c0 = target[3] - r[1] - c1 * r[2];
  // D = θ2ᵀα + θ3 λ = d2 s² + d1 s + d0 takes what remains of C R.
  const double d2 = (r[0] + c1 * r[1] + c0 * r[2] - target[2]) / plant.b3;
  const double d1 = (c1 * r[0] + c0 * r[1] - target[1]) / plant.b3;
  const double d0 = (c0 * r[0] - target[0]) / plant.b3;
  MracMatching result;
  result.compensator = {c0, c1, 1.0};
  result.compensator_stable = is_hurwitz<2>(result.compensator);
  result.theta << (l[1] - c1) / settings.alpha[0], (l[0] - c0) / settings.alpha[1],
      (d1 - d2 * l[1]) / settings.alpha[0], (d0 - d2 * l[0]) / settings.alpha[1], d2,
      model.gain / plant.b3;
  return result;
}

// The laws take positions in watts at rest.
std::optional<FixedLaw> add_matched(FixedLaw law, const MracSettings& filters,
                                    const LawContext& context, const PhysicalParameters& muscle) {
  TransferFunction plant = transfer_function_from(muscle);
  plant.b3 /= context.dc_gain_m_per_W;
  const auto matching = match(plant, filters, context.model);
  if (!matching) return std::nullopt;
  const MracSettings::Parameters& theta = matching->theta;
  const std::array<double, 2>& alpha = filters.alpha;
  const double per_m = 1.0 / context.dc_gain_m_per_W;
  law.filtered = {filters.lambda,
                  {theta[1] * alpha[1], theta[0] * alpha[0]},
                  {theta[3] * alpha[1] * per_m, theta[2] * alpha[0] * per_m},
                  theta[4] * per_m};
  return law;
}

}  // namespace supercoil::control
