// Least squares over many muscles that differ from its model: false changes, and whether its
// deviations and its trust are honest. Fails when a figure in estimation-theory.md no longer holds.
#include <cstdio>
#include <string>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "unit/host_sim/estimators/support/followed_muscle.hpp"

namespace {

using namespace supercoil;
using namespace supercoil::control;
using supercoil::test::Course;
using supercoil::test::FollowedMuscle;
using Parameters = Vector<double, 5>;
using Square = Matrix<double, 5>;

int failures = 0;

void expect_within(const char* what, double value, double min, double max) {
  const bool right = value >= min && value <= max;
  std::printf("%-58s %8.4f, %.4f to %.4f%s\n", what, value, min, max, right ? "" : "  FAILED");
  if (!right) ++failures;
}

struct Effect {
  double host_sim::PlantEffects::*member;
  double value;
};

/// Each effect alone, and the presets.
std::vector<FollowedMuscle> muscles() {
  using host_sim::PlantEffects;
  std::vector<FollowedMuscle> list;
  for (const auto preset : {host_sim::MusclePreset::paper, host_sim::MusclePreset::real,
                            host_sim::MusclePreset::real_hard, host_sim::MusclePreset::b})
    list.push_back(test::followed(preset));
  for (const Effect& effect :
       std::initializer_list<Effect>{{&PlantEffects::force_ratio, 6.0},
                                     {&PlantEffects::softening_ratio, 0.4},
                                     {&PlantEffects::hysteresis_ratio, 0.15},
                                     {&PlantEffects::creep_ratio, 0.1},
                                     {&PlantEffects::convection_ratio, 1.0},
                                     {&PlantEffects::friction_ratio, 0.005},
                                     {&PlantEffects::friction_ratio, 0.02}}) {
    FollowedMuscle muscle;
    muscle.effects.*effect.member = effect.value;
    muscle.effects.hanging_mass_kg = 0.03;  // 0.09 would lengthen the softening one as it warms
    list.push_back(muscle);
  }
  return list;
}

void false_changes() {
  constexpr double duration_s = 1000.0;
  double total_s = 0.0;
  std::int64_t changes = 0;
  for (FollowedMuscle muscle : muscles()) {
    for (const Course motion : {Course::sine, Course::steps, Course::random_steps}) {
      muscle.motion = motion;
      std::int64_t found = 0;
      muscle.run(duration_s, [&](const FollowedMuscle::Tick& tick) {
        found = tick.estimator.changes();
        return true;
      });
      changes += found;
      total_s += duration_s;
    }
  }
  expect_within("false changes in 20,000 s", static_cast<double>(changes) * 20e3 / total_s, 0.0,
                1.0);
}

/// Time from the change until the error has stayed for 5 s below 0.2 mm, or below its maximum
/// before the change if that is larger.
double settled_s(const FollowedMuscle& muscle) {
  constexpr double stays_s = 5.0;
  double max_m = 200e-6;
  double outside_s = 0.0;
  muscle.run(muscle.change_at_s + 40.0, [&](const FollowedMuscle::Tick& tick) {
    const double since_s = tick.time_s - muscle.change_at_s;
    const double error_m = std::abs(tick.error_m);
    if (since_s < -80.0) return true;
    if (since_s < 0.0) {
      max_m = std::fmax(max_m, error_m);
    } else if (error_m > max_m) {
      outside_s = since_s;
    }
    return since_s < outside_s + stays_s;
  });
  return outside_s;
}

/// The slowest run, relative to the same muscle with an estimator that only forgets.
void settling(const char* what, host_sim::MusclePreset preset, double max) {
  constexpr int phases = 8;
  double worst = 0.0;
  for (const Course motion : {Course::sine, Course::steps, Course::random_steps}) {
    for (const bool loaded : {false, true}) {
      for (int i = 0; i < phases; ++i) {
        FollowedMuscle muscle = test::followed(preset);
        muscle.motion = motion;
        muscle.seed = static_cast<unsigned>(1 + i);
        muscle.change_at_s = 140.0 + (motion == Course::sine ? 25.132741 : 80.0) * i / phases;
        if (loaded) {
          muscle.load_N = 0.1;
          if (motion != Course::sine) muscle.max_m = 0.015;  // 4.5 W hold 19 mm with the load
        } else {
          muscle.stiffness_ratio = 0.75;
        }
        const double with_s = settled_s(muscle);
        muscle.detects_changes = false;
        worst = std::fmax(worst, with_s / settled_s(muscle));
      }
    }
  }
  expect_within(what, worst, 0.0, max);
}

/// Linear if odd. What a maker of muscles might sell: no two are alike.
FollowedMuscle random_muscle(unsigned seed) {
  boost::random::mt19937 source(seed * 7919);
  boost::random::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto between = [&](double low, double high) {
    return low + (high - low) * uniform(source);
  };
  const auto ratio = [&](double low, double high) {
    return low * std::pow(high / low, uniform(source));
  };
  const auto one_in_two = [&] { return uniform(source) < 0.5; };
  FollowedMuscle m;
  m.seed = seed;
  m.motion = std::array{Course::sine, Course::steps, Course::random_steps}[seed % 3];
  PhysicalParameters& p = m.parameters;
  p.thermal_mass_J_per_K *= ratio(0.2, 3.0);
  p.heat_transfer_W_per_K *= ratio(0.5, 1.5);
  p.stiffness_N_per_m *= ratio(0.5, 3.0);
  p.damping_Ns_per_m *= ratio(0.5, 2.0);
  p.force_per_kelvin_N_per_K *= ratio(0.5, 2.0);
  p.moving_mass_kg *= ratio(0.5, 2.0);
  m.max_W = 50.0 * p.heat_transfer_W_per_K;
  const double reach_m = m.max_W * p.dc_gain_m_per_W();
  m.min_m = 0.08 * reach_m;
  m.max_m = 0.5 * reach_m;
  for (int i = 0; i < 4; ++i)
    m.believed[i] = between(0.7, 1.4);
  if (seed % 2 == 1) return m;
  host_sim::PlantEffects& e = m.effects;
  e.hanging_mass_kg = 0.03;
  e.force_ratio = between(1.0, 6.0);
  if (one_in_two()) e.softening_ratio = between(0.0, 0.4);
  if (one_in_two()) e.hysteresis_ratio = between(0.01, 0.15);
  if (one_in_two()) e.creep_ratio = between(0.01, 0.1);
  if (one_in_two()) e.lonely_stroke_m = between(0.0, 0.2) * reach_m;
  if (one_in_two()) e.convection_ratio = 0.7;
  if (one_in_two()) e.friction_ratio = between(0.0, 0.01);
  return m;
}

/// What the estimator reported at a time, and the regressions of the minute after it.
struct Outcome {
  Parameters estimate;
  Square covariance;
  bool trusted;
  Square information = Square::Zero();
  Parameters correlation = Parameters::Zero();
};

Outcome outcome_of(const FollowedMuscle& muscle, double at_s) {
  const EstimatorSettings usual;
  const double slow = std::fmax(1.0, muscle.slowness());
  FilteredRegression<double> regression(muscle.scale(), FollowedMuscle::step_s, 0.01);
  regression.restart(0.0);
  Outcome outcome{};
  long tick_count = 0;
  bool recorded = false;
  muscle.run((at_s + 60.0) * slow, [&](const FollowedMuscle::Tick& tick) {
    regression.step(tick.position_W, tick.applied_W);
    if (++tick_count % 10 != 0) return true;
    regression.update();
    if (tick.time_s < at_s * slow) return true;
    if (!recorded) {
      recorded = true;
      outcome.estimate = tick.estimator.parameters();
      outcome.covariance = tick.estimator.covariance();
      outcome.trusted = relative_error_bound(tick.estimator.standard_deviations()) <=
                        usual.excitation.trusted_error;
    }
    const Parameters phi = regression.phi().tail<5>();
    outcome.information += phi * phi.transpose();
    outcome.correlation += phi * regression.z();
    return true;
  });
  return outcome;
}

/// The error in deviations (rms over the directions that are known to a quarter), and in θ.
struct EstimateError {
  double deviations = 0.0;
  double theta = 0.0;
  bool known = false;
};

EstimateError error_of(const Outcome& o, const FollowedMuscle& muscle) {
  Parameters units = Parameters::Ones();
  units[4] = muscle.max_W / 2.0;
  const Square inverse = units.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Square> solver(inverse * o.covariance * inverse);
  int known = 0;
  while (known < 5 && solver.eigenvalues()[known] < 0.25 * 0.25)
    ++known;
  EstimateError error{.known = known > 0};
  if (known == 0) return error;
  // Unknown directions are not judged: the best fit is along the others.
  const Eigen::MatrixXd along = units.asDiagonal() * solver.eigenvectors().leftCols(known);
  Eigen::VectorXd best;
  if (muscle.effects.any()) {
    best = (along.transpose() * o.information * along)
               .ldlt()
               .solve(along.transpose() * (o.correlation - o.information * o.estimate));
  } else {
    Parameters truth = Parameters::Ones();
    truth[4] = 0.0;
    best = solver.eigenvectors().leftCols(known).transpose() * (inverse * (truth - o.estimate));
  }
  const Eigen::VectorXd spread = solver.eigenvalues().head(known).cwiseSqrt();
  error.deviations = best.cwiseQuotient(spread).norm() / std::sqrt(known);
  error.theta = (along * best).head(4).norm();
  return error;
}

void check_deviations() {
  constexpr unsigned count = 200;
  double judged = 0.0;
  double within = 0.0;
  double judged_real = 0.0;
  double within_real = 0.0;
  double trusted = 0.0;
  double wrong = 0.0;
  for (unsigned seed = 1; seed <= count; ++seed) {
    const FollowedMuscle muscle = random_muscle(seed);
    const Outcome outcome = outcome_of(muscle, 100.0 + seed % 100);
    const EstimateError error = error_of(outcome, muscle);
    if (outcome.trusted) {
      trusted += 1.0;
      if (error.theta > EstimatorSettings{}.excitation.trusted_error) wrong += 1.0;
    }
    if (!error.known) continue;
    judged += 1.0;
    if (error.deviations <= 2.0) within += 1.0;
    if (!muscle.effects.any()) continue;
    judged_real += 1.0;
    if (error.deviations <= 2.0) within_real += 1.0;
  }
  expect_within("of 200 random muscles, something is known of", judged, 150.0, count);
  expect_within("  within two deviations", within / judged, 0.90, 0.99);
  expect_within("  of those that are not linear", within_real / judged_real, 0.90, 0.99);
  expect_within("trusted muscles", trusted, 10.0, count);
  expect_within("  wrongly", wrong / trusted, 0.0, 0.01);
}

}  // namespace

int main() {
  false_changes();
  settling("settling with over without a detector, paper", host_sim::MusclePreset::paper, 1.1);
  settling("  real", host_sim::MusclePreset::real, 1.1);
  settling("  real_hard", host_sim::MusclePreset::real_hard, 1.1);
  check_deviations();
  return failures == 0 ? 0 : 1;
}
