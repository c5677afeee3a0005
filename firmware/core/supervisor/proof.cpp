#include "supervisor/proof.hpp"

#include <algorithm>

namespace supercoil {

namespace {

/// Worst-case fraction of the minimum heat transfer: a muscle that is wrapped, or off its sensor
/// and in still air.
constexpr double worst_cooling_ratio = 0.25;
constexpr double target_step_s = 0.01;
/// A closed loop cancels part of the dither.
constexpr double loop_ratio = 1.3;
/// Of the time to the limit: a dither begins early enough to be decided by the first; without a
/// decision, power is lowered at the second.
constexpr double decided_ratio = 0.5;
constexpr double overdue_ratio = 0.75;
/// A power is provable if a dither is decided in closed loop before the proof is overdue.
constexpr double provable_ratio = loop_ratio / overdue_ratio;
/// A motion has this long to prove the muscle before a dither is added to it.
constexpr double patience_s = 0.2;
constexpr double usual_block_s = 2.0;
/// Of obvious_m, rms: a position that moves this much by itself is not from a dead sensor.
constexpr double loud_ratio = 0.1;
constexpr double max_release_s = 3.0;
/// Powers are rounded to steps of the PWM.
constexpr double above_safe_ratio = 1.05;
/// Of obvious_m: friction of 2 % of the paper's load holds 1.1 mm.
constexpr double release_ratio = 2.0;

std::int64_t ticks_of_step(double rate_Hz) {
  return std::max<std::int64_t>(1, std::llround(rate_Hz * target_step_s));
}

SensorStep sensor_of(const ProofSettings& s, double rate_Hz) {
  const double noise_m2 = s.position_noise_rms_m * s.position_noise_rms_m;
  const double mean_m2 = noise_m2 / static_cast<double>(ticks_of_step(rate_Hz));
  // Rounding may be the same for all ticks of a step.
  return {std::sqrt(mean_m2 + s.count_m * s.count_m / 12.0), s.count_m};
}

double min_transfer_W_per_K(const ProofSettings& s) {
  return worst_cooling_ratio * s.thermal.bounds.min_transfer_W_per_K;
}

double rest_K(const ProofSettings& s, double power_W) {
  return power_W * s.max_power_ratio / min_transfer_W_per_K(s);
}

/// Rise at which the interval's hot end settles.
double hot_end_K(const ProofSettings& s, double power_W) {
  return worst_cooling_ratio * rest_K(s, power_W);
}

double slowest_s(const ProofSettings& s) {
  return s.thermal.bounds.min_mass_J_per_K / min_transfer_W_per_K(s);
}

/// At full_W, from hottest_K, with the minimum mass.
double time_to_limit_s(const ProofSettings& s, double full_W, double hottest_K) {
  const double full_K = rest_K(s, full_W);
  const double limit_K = s.trip_C - s.thermal.air.warmest_C;
  if (full_K <= limit_K) return INFINITY;
  if (hottest_K >= limit_K) return 0.0;
  return slowest_s(s) * std::log((full_K - hottest_K) / (full_K - limit_K));
}

/// Held indefinitely at a quarter of the minimum cooling, this power stays below derating.
double safe_W(const ProofSettings& s, double warmer_air_K) {
  const double W_per_rest_K = s.max_W / rest_K(s, s.max_W);
  return std::max(0.0, s.derate_from_C - s.thermal.air.warmest_C - warmer_air_K) * W_per_rest_K;
}

/// The maximum power at which the hot end, once cooling fails, takes provable_ratio of the dither's
/// time to reach the limit: time_to_limit_s() with this power as full and as held.
double provable_W(const ProofSettings& s, const Dither& dither, double warmer_air_K) {
  const double limit_K = s.trip_C - s.thermal.air.warmest_C - warmer_air_K;
  const bool decides = std::isfinite(dither.decided_s) || rest_K(s, s.max_W) <= limit_K;
  if (!decides) return safe_W(s, warmer_air_K);
  const double growth = std::exp(provable_ratio * dither.decided_s / slowest_s(s));
  const double provable_K = limit_K / (1.0 - (1.0 - worst_cooling_ratio) / growth);
  return std::clamp(provable_K * s.max_W / rest_K(s, s.max_W), 0.0, s.max_W);
}

/// Rise of a muscle with worst-case cooling since its last answer.
control::BasicIntervalEnd<double> uncooled(const ProofSettings& s, double step_s) {
  return control::hot_end(min_transfer_W_per_K(s), s.thermal.bounds, step_s);
}

double steps_s(double rate_Hz) {
  return static_cast<double>(ticks_of_step(rate_Hz)) / rate_Hz;
}

}  // namespace

void ProofPlan::adjust_for_air(const ProofSettings& s, double warmer_K) {
  safe_W = supercoil::safe_W(s, warmer_K);
  provable_W = supercoil::provable_W(s, dither, warmer_K);
}

ProofPlan plan_proof(const ProofSettings& s, const control::PhysicalParameters& muscle,
                     double rate_Hz) {
  ProofPlan plan;
  const double in_time_s =
      decided_ratio / loop_ratio * time_to_limit_s(s, s.max_W, hot_end_K(s, s.max_W));
  const ExpectedMotion motion(muscle, steps_s(rate_Hz), s.response_ratio);
  plan.dither = dither_for(motion, sensor_of(s, rate_Hz), s.max_W, in_time_s, steps_s(rate_Hz));
  plan.adjust_for_air(s, 0.0);
  return plan;
}

SmallSignal::Settings plan_small_signal(const ProofSettings& settings,
                                        const control::PhysicalParameters& muscle, double hold_W,
                                        double max_hold_W, double rate_Hz) {
  constexpr double time_constants = 5.0;
  constexpr double max_settle_s = 45.0;
  ProofSettings full_response = settings;
  full_response.response_ratio = 1.0;
  SmallSignal::Settings s;
  s.dither = plan_proof(full_response, muscle, rate_Hz).dither;
  // Both halves of the dither need room. A strong muscle may have so little that its dither must be
  // smaller; noise may then hide the answer.
  const double clear_W = std::clamp(hold_W, 2.0 * s.dither.amplitude_W, 0.5 * settings.max_W);
  s.hold_W = std::min(clear_W, max_hold_W);
  s.dither.amplitude_W = std::min(s.dither.amplitude_W, 0.5 * s.hold_W);
  s.settle_s = std::min(max_settle_s, -time_constants / muscle.thermal_pole_rad_per_s());
  s.rate_Hz = rate_Hz;
  s.step_s = steps_s(rate_Hz);
  s.noise_m = sensor_of(settings, rate_Hz).noise_m;
  return s;
}

Proof::Proof(const ProofSettings& settings, const control::PhysicalParameters& muscle, bool known,
             double rate_Hz)
    : settings_(settings),
      known_(known),
      rate_Hz_(rate_Hz),
      step_s_(steps_s(rate_Hz)),
      step_ticks_(ticks_of_step(rate_Hz)),
      plan_(plan_proof(settings, muscle, rate_Hz)),
      all_(match_for(muscle, motion_corner_rad_per_s)),
      dither_(match_for(muscle, plan_.dither.corner_rad_per_s, settings.response_ratio)),
      uncooled_(uncooled(settings, step_s_)) {
  enter(Stage::watching);
}

Proof::Match Proof::match_for(const control::PhysicalParameters& muscle, double corner_rad_per_s,
                              double response_ratio) const {
  const detectors::HighPass fast(corner_rad_per_s, step_s_);
  return {ExpectedMotion(muscle, step_s_, response_ratio), fast, fast,
          detectors::Response(sensor_of(settings_, rate_Hz_).noise_m)};
}

void Proof::learn(const control::PhysicalParameters& muscle, double response_ratio) {
  known_ = true;
  settings_.response_ratio = response_ratio;
  plan_ = plan_proof(settings_, muscle, rate_Hz_);
  plan_.adjust_for_air(settings_, warmer_air_K_);
  const ExpectedMotion before = all_.motion;
  all_ = match_for(muscle, motion_corner_rad_per_s);
  dither_ = match_for(muscle, plan_.dither.corner_rad_per_s, response_ratio);
  all_.motion.take_over(before);
  stop_dither();
  settled_ = false;
  enter(Stage::watching);
}

void Proof::plan(double max_power_ratio, const control::PhysicalParameters& muscle) {
  settings_.max_power_ratio = max_power_ratio;
  plan_ = plan_proof(settings_, muscle, rate_Hz_);
  plan_.adjust_for_air(settings_, warmer_air_K_);
  stop_dither();  // its halves may differ in the new plan
  dither_ = match_for(muscle, plan_.dither.corner_rad_per_s, settings_.response_ratio);
  settled_ = false;
  allow();
}

/// The muscle is given no more than the provable power.
double Proof::time_to_limit_s(double hottest_K) const {
  return supercoil::time_to_limit_s(settings_, plan_.provable_W, hottest_K);
}

/// Whether this fraction of the time to the limit, less a reserve, is used up: by the clock, or by
/// the heat since the last answer.
bool Proof::is_used(double ratio, double reserve_s, double hottest_K) const {
  const double proven_s = time_to_limit_s(proven_K_);
  return unproven_s_ > ratio * time_to_limit_s(hottest_K) - reserve_s ||
         proven_s - time_to_limit_s(worst_K_) > ratio * proven_s - reserve_s;
}

/// Time in which a dither is decided in closed loop.
double Proof::decision_s() const {
  return loop_ratio * plan_.dither.decided_s;
}

void Proof::step(const Input& in) {
  answered_ = unanswered_ = false;
  if (!active()) return;
  const auto periods = static_cast<double>(in.periods);
  sums_.power_W += in.power_W * periods;
  sums_.dither_W += in.dither_W * periods;
  sums_.ticks += in.periods;
  if (in.present) {
    sums_.position_m += in.position_m;
    ++sums_.positions;
  }
  if (sums_.ticks >= step_ticks_) end_step(in);
}

void Proof::end_step(const Input& in) {
  const auto ticks = static_cast<double>(sums_.ticks);
  const double power_W = sums_.power_W / ticks;
  all_.expect(power_W);
  dither_.expect(sums_.dither_W / ticks);
  if (in.warmer_air_K != warmer_air_K_) {
    warmer_air_K_ = in.warmer_air_K;
    plan_.adjust_for_air(settings_, warmer_air_K_);
    allow();
  }
  const double hottest_K = in.hottest_K + in.warmer_air_K;
  warm(power_W, in.heating, hottest_K);
  if (sums_.positions > 0) {
    compare(sums_.position_m / static_cast<double>(sums_.positions));
    in.heating ? judge(power_W, hottest_K) : rest(hottest_K);
  } else {
    settled_ = false;
  }
  sums_ = {};
}

/// Before the first heating only the hot end is known.
void Proof::warm(double power_W, bool heating, double hottest_K) {
  if (!heating && worst_K_ == 0.0) return;
  if (worst_K_ == 0.0) proven_K_ = hottest_K;
  const double true_W = settings_.max_power_ratio * power_W;
  for (std::int64_t ticks = 0; ticks < sums_.ticks; ticks += step_ticks_)
    worst_K_ = warmer_air_K_ + uncooled_.next_K(worst_K_ - warmer_air_K_, true_W);
  worst_K_ = std::fmax(worst_K_, hottest_K);
}

void Proof::compare(double position_m) {
  if (!settled_) {
    all_.settle(position_m);
    dither_.settle(position_m);
    begin_block();
    settled_ = true;
  }
  all_.compare(position_m);
  dither_.compare(position_m);
  low_m_ = std::min(low_m_, all_.expected_m);
  high_m_ = std::max(high_m_, all_.expected_m);
  block_s_ += step_s_;
  stage_s_ += step_s_;
}

/// Rest alone proves nothing: an unproven muscle stays so until it answers, or must have cooled far
/// enough to leave time for a dither.
void Proof::rest(double hottest_K) {
  unproven_s_ = 0.0;
  stop_dither();
  const bool answered = all_.answered();
  if (answered) prove(hottest_K);
  const double needed_s = decided_ratio * time_to_limit_s(hottest_K) + decision_s();
  const bool in_time = time_to_limit_s(worst_K_) >= needed_s;
  if (stage_ != Stage::watching && (answered || in_time)) {
    enter(Stage::watching);
  } else if (stage_ == Stage::released) {
    enter(Stage::overdue);
  }
  end_block();
}

void Proof::judge(double power_W, double hottest_K) {
  answered_ = all_.answered() || dither_.answered();
  const bool silent = stage_ == Stage::watching ? dither_.silent() : all_.silent() && must_move();
  const bool above_safe = power_W > above_safe_ratio * plan_.safe_W;
  unproven_s_ = above_safe ? unproven_s_ + step_s_ : 0.0;
  if (stage_ == Stage::released) {
    judge_release(hottest_K);
  } else if (answered_) {
    prove(hottest_K);
    if (stage_ == Stage::overdue) enter(Stage::watching);
  } else if (silent && (stage_ == Stage::watching || stage_ == Stage::overdue)) {
    enter(Stage::released);
  } else {
    // Only the clock restarts: the heat that was used still counts.
    if (all_.answer.moved(loud_ratio * settings_.obvious_m)) unproven_s_ = 0.0;
    if (above_safe && is_used(overdue_ratio, 0.0, hottest_K)) {
      if (stage_ == Stage::watching) {
        enter(Stage::overdue);
      } else if (stage_ == Stage::moving) {
        enter(Stage::swallowed);
      }
    }
  }
  end_block();
  drive_dither(power_W, hottest_K);
}

/// The muscle is proven at this moment; it may lose contact from now on.
void Proof::prove(double hottest_K) {
  unproven_s_ = 0.0;
  proven_K_ = worst_K_ = hottest_K;
  begin_block();
}

bool Proof::must_move() const {
  return high_m_ - low_m_ >= release_ratio * settings_.obvious_m || stage_s_ >= max_release_s;
}

void Proof::judge_release(double hottest_K) {
  if (!must_move()) return;
  unanswered_ = all_.silent();
  if (all_.answered()) {
    prove(hottest_K);
    enter(Stage::moving);
  } else if (!unanswered_ && stage_s_ >= max_release_s) {
    enter(Stage::swallowed);
  }
}

void Proof::enter(Stage stage) {
  stage_ = stage;
  stage_s_ = 0.0;
  low_m_ = high_m_ = all_.expected_m;
  begin_block();
  allow();
}

void Proof::allow() {
  switch (stage_) {
    case Stage::watching:
    case Stage::moving:
      max_W_ = active() ? plan_.provable_W : INFINITY;
      break;
    case Stage::overdue:
    case Stage::swallowed:
      max_W_ = plan_.safe_W;
      break;
    case Stage::released:
      max_W_ = 0.0;
      break;
  }
}

void Proof::begin_block() {
  all_.restart();
  dither_.restart();
  block_s_ = 0.0;
}

/// A block without a decision is discarded: it may be from before contact was lost.
void Proof::end_block() {
  const double dithered_s = dither_place_ < 0 ? 0.0 : decision_s();
  if (block_s_ > std::fmax(usual_block_s, dithered_s)) begin_block();
}

/// Also adds the dither while the power is held down, where nothing else could be answered.
void Proof::drive_dither(double power_W, double hottest_K) {
  const bool watching = stage_ == Stage::watching;
  const bool overdue = stage_ == Stage::overdue && power_W > 2.0 * plan_.dither.amplitude_W;
  const bool in_time =
      watching && unproven_s_ > patience_s && is_used(decided_ratio, decision_s(), hottest_K);
  const bool due = (in_time || overdue) && std::isfinite(plan_.dither.decided_s);
  const int period = 2 * plan_.dither.half_steps;
  if (dither_place_ >= 0) dither_place_ = (dither_place_ + 1) % period;
  // A period that has begun is completed: part of one would leave the position displaced.
  const bool between = dither_place_ <= 0;
  if (!(watching || stage_ == Stage::overdue) || (between && !due)) {
    dither_place_ = -1;
  } else if (dither_place_ < 0) {
    dither_place_ = 0;
    begin_block();  // earlier motion says nothing about now
  }
  dither_W_ = dither_place_ < 0 ? 0.0 : plan_.dither.step_W(dither_place_);
}

void Proof::stop_dither() {
  dither_place_ = -1;
  dither_W_ = 0.0;
}

detectors::Margin Proof::margin() const {
  const double expected_m = high_m_ - low_m_;
  return {all_.answer.ratio() * expected_m, detectors::Response::silent_ratio * expected_m, true,
          true};
}

}  // namespace supercoil
