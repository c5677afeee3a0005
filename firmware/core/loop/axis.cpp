#include "loop/axis.hpp"

#include <algorithm>
#include <cmath>

namespace supercoil {

namespace {

board::MeterComparison::Settings comparison_settings(const ChannelSettings& channel,
                                                     const BoardSettings& board) {
  return {board.supervision.min_supply_V, board.supervision.max_supply_V,
          channel.supervision.resistance_ratio, board.supply.scaling.per_count,
          channel.heater.current.scaling.per_count};
}

/// All time constants within the configured bounds of mass and heat transfer, without the bound of
/// their ratio: a fit that explains the motion with another time constant must be visible as such.
control::CoolingFit::Settings cooling_settings(const ChannelSettings& channel) {
  const control::ThermalBounds b = board::with_weighed_mass(channel.thermal);
  return {b.min_mass_J_per_K / b.max_transfer_W_per_K, b.max_mass_J_per_K / b.min_transfer_W_per_K,
          channel.limiter.max_W};
}

/// Two muscles of a joint can cool against each other without motion, and a resistance that is to
/// indicate a temperature must be that of a cold muscle, whatever holds it.
modes::Calibrate::Settings calibrate_settings(const ChannelSettings& channel) {
  modes::Calibrate::Settings s;
  constexpr double still_K = 20.0, remaining_ratio = 1e-3;
  if (!channel.joint.has_other() && !channel.bundle.bundled &&
      channel.heater.temperature_coefficient_per_K == 0.0)
    s.still_K = still_K;
  s.max_remaining_m = remaining_ratio * channel.supervision.max_travel_m;
  s.count_m = std::abs(channel.position.scaling.per_count);
  return s;
}

}  // namespace

Axis::Axis(const ChannelSettings& settings, const BoardSettings& board,
           const board::ChannelDevices& devices, const ChannelState& state)
    : settings_(settings),
      state_(state),
      step_s_(board.step_s()),
      sensor_(devices.position),
      heater_(settings, board, devices),
      pull_(settings.joint),
      tracking_(settings.controllers, settings.muscle, step_s_),
      estimation_(settings.estimators, step_s_),
      ticks_per_s_(std::llround(board.rate_Hz)),
      proof_(proof_settings(settings, board), settings.muscle, settings.muscle_identified,
             board.rate_Hz),
      muscle_(settings.muscle),
      has_muscle_(settings.has_muscle),
      calibration_(settings.calibration),
      response_ratio_(settings.response_ratio),
      unexplained_ratio_(settings.unexplained_ratio),
      identification_(settings.identification),
      stored_tuning_(settings.tuning),
      identify_({}, settings.muscle, settings.supervision.max_travel_m, step_s_),
      calibrate_(calibrate_settings(settings)),
      comparison_(comparison_settings(settings, board), step_s_),
      steady_state_(settings.thermal, step_s_) {
  publish_muscle();
  const auto choose = [](std::optional<double> stored, std::size_t places, auto& among) {
    if (stored && *stored < static_cast<double>(places))
      among.choose(static_cast<std::size_t>(*stored));
  };
  choose(stored_tuning_.controller, tracking_.controllers(), tracking_);
  choose(stored_tuning_.estimator, estimation_.estimators(), estimation_);
  // The cooling of a whole bundle is not that of any one muscle.
  if (settings.thermal.weighed() && !settings.bundle.bundled)
    cooling_fit_ = std::make_unique<control::CoolingFit>(cooling_settings(settings), step_s_);
}

void Axis::sample(hal::Time now) {
  now_ = now;
  const hal::Sample sample = sensor_->latest();
  const InputSettings& input = settings_.position;
  board::Measured& position = inputs_.position;
  board::measure(sample, input.scaling, now, input.max_age_s, position);
  inputs_.sensor_m = position.value;
  position.value = calibrated(inputs_.sensor_m);
  const bool fresh = position.present && sample.taken != position_taken_;
  inputs_.position_elapsed_s = fresh ? hal::seconds(sample.taken - position_taken_) : 0.0;
  if (fresh) position_taken_ = sample.taken;
  heater_.sample(now);
}

void Axis::observe(double supply_V, const board::Measured* air, std::int64_t periods) {
  heater_.observe(supply_V, air, periods);
  pull_.step(heater_.acting().power_W, static_cast<double>(periods) * step_s_, muscle_);
  prove(periods);
  inputs_.from_position_K = from_position_K();
  inputs_.demanded_W = share_W_;
  inputs_.opposed_m = other_.expected_m;
}

/// From where this muscle alone would be. How far a joint's other muscle moves it is known roughly,
/// and may be many kelvin of a weaker one: what contradicts the resistance least counts.
double Axis::from_position_K() const {
  if (!heater_.indicates_temperature()) return 0.0;
  const auto rise_K = [&](double other_m) {
    return (inputs_.position.value + other_m) / heater_.heat().metres_per_K();
  };
  // Expected motions are 0 or more.
  const auto [min_m, max_m] = std::ranges::minmax(other_.expected_m);
  const double ratio = settings_.supervision.responding_ratio;
  const double min_K = rise_K(ratio * min_m);
  return std::clamp(heater_.from_resistance_K(), min_K, std::max(min_K, rise_K(max_m / ratio)));
}

control::PowerRange Axis::own_range() const {
  return bundle_ ? bundle_->range : heater_.power_range();
}

control::PowerRange Axis::range() const {
  const control::PowerRange own = own_range();
  return {own.min_W - other_.range.max_W, own.max_W - other_.range.min_W};
}

control::PowerRange Axis::allowed_range() const {
  const control::PowerRange range = heater_.power_range();
  const double cool_W = heater_.limiter().max_W(heater_.heat().hottest_C());
  return {range.min_W, std::min({range.max_W, cool_W, proof_.max_W()})};
}

/// A demand that makes room for a dither is limited like any other that exceeds a limit:
/// controllers must not wind up, and saturation must be detected.
void Axis::limit(double share_W, double max_W) {
  share_W_ = share_W;
  const Limiter& limiter = heater_.limiter();
  const double cool_W = limiter.max_W(heater_.heat().hottest_C());
  const double limit_W = std::fmin(max_W, cool_W);
  LimitedBy lowered_by = LimitedBy::nothing;
  if (proof_.lowers(share_W, limit_W)) {
    if (proof_.max_W() < limit_W) {
      lowered_by = LimitedBy::unproven;
    } else {
      lowered_by = limit_W < limiter.max_W() ? LimitedBy::temperature : LimitedBy::maximum;
    }
  }
  heater_.limit(state_, proof_.with_dither_W(share_W, limit_W), proof_.max_W(), lowered_by);
}

double Axis::held_W() const {
  const double limit_W = std::min({own_range().max_W, max_hot_W(), proof_.held_W()});
  return std::max(0.0, limit_W - proof_.reserve_W());
}

control::PowerRange Axis::held_range() const {
  return {own_range().min_W - other_.held_W, held_W() - other_.range.min_W};
}

Opposition Axis::opposition(double gain_ratio, double lever_ratio) const {
  const board::AppliedPower& acting = heater_.acting();
  const control::PowerRange own = heater_.power_range();
  detectors::NotResponding::Expected expected_m = heater_.heat().expected_m();
  for (double& each_m : expected_m)
    each_m *= lever_ratio;
  return {
      gain_ratio * acting.power_W, acting.limited, {gain_ratio * own.min_W, gain_ratio * own.max_W},
      gain_ratio * held_W(),       expected_m,     heater_.heat().hottest_K(),
      inputs_.expected_jumped};
}

void Axis::lead(const WholeBundle& whole) {
  const bool replan = !bundle_ || bundle_->max_power_ratio != whole.max_power_ratio;
  bundle_ = whole;
  if (replan) plan_proof();
}

/// With the widest power bounds.
void Axis::plan_proof() {
  const double own = heater_.power_bounds().true_over_measured().max;
  proof_.plan(bundle_ ? std::max(own, bundle_->max_power_ratio) : own, muscle_);
}

double Axis::max_W() const {
  return bundle_ ? bundle_->max_W : heater_.limiter().max_W();
}

double Axis::max_hot_W() const {
  return bundle_ ? bundle_->max_hot_W : heater_.limiter().max_W(heater_.heat().hottest_C());
}

void Axis::prove(std::int64_t periods) {
  const bool heats = state_.may_heat() && (mode_ == Mode::position || mode_ == Mode::power);
  const board::Measured& position = inputs_.position;
  const board::AppliedPower& acting = heater_.acting();
  const board::Heat& heat = heater_.heat();
  proof_.step({acting.power_W, acting.dither_W, periods, position.present, position.value,
               bundle_ ? bundle_->hottest_K : heat.hottest_K(), heats,
               heat.air().above_configured_K()});
  inputs_.answered = proof_.answered();
  inputs_.unanswered = proof_.unanswered();
  if (inputs_.unanswered) inputs_.answer = proof_.margin();
}

void Axis::estimate() {
  // A led axis would only learn what its leader learns, from the same motion and power.
  if (!state_.may_heat() || !inputs_.position.present || is_led(mode_)) return;
  estimation_.step(inputs_.position.value, moving_W());
  // Once a second: what the estimator knows of cooling, if it is trusted.
  if (++estimated_ticks_ < ticks_per_s_) return;
  estimated_ticks_ = 0;
  learn_heat();
}

void Axis::learn_heat() {
  if (const auto muscle = estimation_.trusted_muscle(muscle_))
    heater_.learn(muscle->thermal_pole_rad_per_s());
}

void Axis::follow_power(double demanded_W, double power_W) {
  if (is_led(mode_) && demanded_W != reference_) restart_comparisons();
  if (is_led(mode_)) reference_ = demanded_W;
  demanded_.demanded_power_W = demanded_W;
  limit(power_W);
}

bool Axis::control() {
  demanded_ = {};
  if (mode_ == Mode::position) reference_ = playback_.step(now_, reference_);
  if (playback_.is_over()) {
    rest();
    return true;
  }
  if (!state_.may_heat() || !inputs_.position.present) return false;
  switch (mode_) {
    case Mode::position: {
      control::ControllerInput input;
      input.reference_m = reference_;
      input.trajectory = playback_.point();
      input.position_m = inputs_.position.value;
      input.applied_power_W = moving_W();
      input.limited = is_limited();
      input.range = held_range();
      demanded_ = tracking_.step(input, estimation_.estimate());
      return false;
    }
    case Mode::power:
      demanded_.demanded_power_W = reference_;
      tracking_.set_power(moving_W());
      follow_comparisons();
      return false;
    case Mode::joint:
      // The joint divides the power between its heaters.
      demanded_.demanded_power_W = reference_;
      return false;
    case Mode::bundle:
      follow_comparisons();  // its leader gives it its power
      return false;
    case Mode::identify:
      return step_identify();
    case Mode::calibrate:
      return step_calibrate();
    case Mode::rest:
      break;
  }
  return false;
}

/// The limit that made the controller shape a reference which needs more heating.
LimitedBy Axis::held_by() const {
  const double hot_W = max_hot_W();
  const double proven_W = proof_.held_W();
  if (std::min(hot_W, proven_W) >= own_range().max_W) return LimitedBy::maximum;
  return hot_W <= proven_W ? LimitedBy::temperature : LimitedBy::unproven;
}

/// The limiter's reason, or else why the reference was shaped.
LimitedBy Axis::limited_by() const {
  using control::Infeasible;
  LimitedBy by = heater_.allowed().by;
  if (by == LimitedBy::nothing && followers_limited()) by = bundle_->limited_by;
  const bool at_an_end = by <= LimitedBy::maximum;
  if (!at_an_end || demanded_.infeasible == Infeasible::nothing) return by;
  return demanded_.infeasible == Infeasible::cooling ? LimitedBy::cooling : held_by();
}

void Axis::rest() {
  if (result_ == ModeResult::running) result_ = ModeResult::interrupted;
  mode_ = Mode::rest;
  playback_.forget();
  reference_ = 0.0;
  heater_.rest();
}

void Axis::disarm() {
  comparison_.forget();
  rest();
  heater_.cut();
}

void Axis::publish(std::uint32_t selector, Snapshot& s) const {
  s.mode = mode_;
  s.limited_by = limited_by();
  s.controller = static_cast<std::uint8_t>(tracking_.chosen());
  s.reference = reference_;
  s.model_m = demanded_.model_m;
  s.position_m = inputs_.position.present ? inputs_.position.value : std::nan("");
  s.demanded_W = demanded_.demanded_power_W;
  s.proof_off = !settings_.supervision.proof_of_response;
  s.slack = pull_N() <= 0.0;
  s.oscillation_period_s = demanded_.oscillation_period_s;
  s.progress = mode_ == Mode::identify    ? identify_.progress()
               : mode_ == Mode::calibrate ? calibrate_.progress()
                                          : 0.0F;
  s.result = result_;
  const bool friction =
      response_ratio_ > 0.0 && response_ratio_ < detectors::Response::min_response_ratio;
  s.identify_notes = static_cast<std::uint8_t>(identify_.notes() | (friction ? note_friction : 0));
  s.gain = tracking_.gain(selector);
  estimation_.publish(selector, s);
  heater_.publish(s);
  s.limited = s.limited || followers_limited();
}

}  // namespace supercoil
