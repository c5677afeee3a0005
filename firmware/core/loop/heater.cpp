#include "loop/heater.hpp"

#include <algorithm>
#include <cmath>

namespace supercoil {

namespace {

/// Above this multiple of the cold resistance the wire is open; the reading is sense offset.
constexpr double open_circuit_ratio = 4.0;

board::Resistance::Settings resistance_settings(const HeaterSettings& h) {
  return {h.sense_filter_s, h.resistance_filter_s, h.probe_duty, h.cold_resistance_Ohm};
}

/// How long the current sense shows a pulse: it acts late, is averaged, and is read late.
double sense_settling_s(const HeaterSettings& h) {
  constexpr double time_constants = 5.0;
  return h.delay_s + time_constants * h.sense_filter_s + h.current.max_age_s;
}

std::size_t ticks_of(double time_s, double step_s) {
  return static_cast<std::size_t>(std::nearbyint(time_s / step_s));
}

}  // namespace

Heater::Heater(const ChannelSettings& settings, const BoardSettings& board,
               const board::ChannelDevices& devices)
    : settings_(settings.heater),
      devices_(devices),
      current_noise_A_(settings.supervision.current_noise_A),
      derate_from_C_(settings.limiter.derate_from_C),
      cold_Ohm_(settings.calibration.cold_resistance_Ohm),
      senses_(settings.senses),
      resistance_(resistance_settings(settings.heater), board.step_s()),
      power_bounds_(supercoil::power_bounds(settings, board)),
      heat_(settings.thermal, settings.muscle, board.step_s()),
      probe_(settings.heater.probe_s, board.step_s()),
      sense_ticks_(static_cast<int>(std::ceil(sense_settling_s(settings.heater) / board.step_s()))),
      max_power_W_(settings.limiter.max_W),
      limiter_(settings.limiter, board.step_s()),
      power_stage_({devices.pwm->steps(), settings.heater.error_feedback}),
      delay_(ticks_of(settings.heater.delay_s, board.step_s())) {
  published_senses_.set(senses_);
  set_thermal_facts(settings.heat);
}

void Heater::sample(hal::Time now) {
  const InputSettings& input = settings_.current;
  board::measure(devices_.current->latest(), input.scaling, now, input.max_age_s, current_);
  current_.value *= senses_.current_gain;
}

void Heater::observe(double supply_V, const board::Measured* air, std::int64_t periods) {
  if (air != nullptr) heat_.follow_air(*air);
  supply_V_ = supply_V * senses_.supply_gain;
  observe_power(periods);
  follow_probe();
  calculate_full_scale();
  // The temperature before boot is not known: nothing is armed until the muscle must have cooled.
  heat_known_ = heat_known_ || heat_.hottest_C() < derate_from_C_;
}

board::PowerBounds::Interval Heater::measured_power_W() const {
  const auto ratio = power_bounds_.true_over_measured();
  return {power_W_.min / ratio.min, power_W_.max / ratio.max};
}

/// The muscle's temperature from the set power and the measured one: only the current shows that a
/// switch conducts by itself.
void Heater::observe_power(std::int64_t periods) {
  const bool sensed = current_.present && supply_V_ > 0.0;
  if (sensed) resistance_.step(acting_.duty, supply_V_, current_.value);
  // A resistance that was calibrated with wrong senses must not narrow the bounds.
  const double as_configured = settings_.cold_resistance_Ohm / cold_Ohm_;
  const auto [min_Ohm, max_Ohm] = warm_Ohm(cold_Ohm_);
  power_W_ = power_bounds_.step(
      acting_.duty, supply_V_, current_,
      {min_Ohm * std::min(1.0, as_configured), max_Ohm * std::max(1.0, as_configured)});
  heat_.step(power_W_.min, power_W_.max, acting_.power_W, sensed);
  const double measured_W =
      current_.present ? supply_V_ * (current_.value - current_noise_A_) : limiter_.max_W();
  inputs_.measured_W = std::max(acting_.power_W, measured_W);
  // In skipped periods the power may have continued, or the charge pump may have cut it.
  for (std::int64_t i = 1; i < periods; ++i)
    heat_.step(0.0, power_W_.max, acting_.power_W, sensed);

  const double per_K = settings_.temperature_coefficient_per_K;
  indicates_temperature_ = per_K > 0.0 && resistance_.age_s() < 1.0;
  inputs_.from_resistance_K =
      indicates_temperature_ ? (resistance_.value_Ohm() / cold_Ohm_ - 1.0) / per_K : 0.0;
}

void Heater::follow_probe() {
  settling_ticks_ = probe_.running() ? sense_ticks_ : std::max(0, settling_ticks_ - 1);
  probed_ = probe_failed_ = false;
  const auto probed =
      probe_.step(resistance_.duty(), supply_V_, current_.present ? current_.value : 0.0);
  if (!probed.ended) return;
  const double max_Ohm = open_circuit_ratio * cold_Ohm_;
  probe_failed_ = !(probed.resistance_Ohm > 0.0 && probed.resistance_Ohm < max_Ohm);
  probed_ = !probe_failed_;
  if (probed_) resistance_.set(probed.resistance_Ohm);
}

const HeaterInputs& Heater::inputs(const ChannelState& state) {
  HeaterInputs& e = inputs_;
  e.current = current_;
  e.supply_V = supply_V_;
  e.hot = heat_.hottest_K() > hot_K;
  e.off = acting_.duty == 0.0 || !state.enable();
  e.duty = resistance_.duty();
  e.set_step = written_step_;
  e.read_back = devices_.pwm->read_back();
  e.devices_ok = writes_ok_;
  e.expected_m = heat_.expected_m();
  e.hottest_C = heat_known_ ? heat_.hottest_C() : heat_.air().warmest_C();
  e.applied_W = acting_.power_W;
  e.probed = probed_;
  e.probe_failed = probe_failed_;
  e.resistance_fresh = resistance_.age_s() == 0.0 && !probe_.running();
  e.resistance_Ohm = resistance_.value_Ohm();
  const auto [min_Ohm, max_Ohm] = warm_Ohm(cold_Ohm_);
  e.min_Ohm = min_Ohm;
  e.max_Ohm = max_Ohm;
  e.limited = acting_.limited;
  return e;
}

void Heater::publish(Snapshot& s) const {
  s.probing = probe_.running();
  s.applied_W = acting_.power_W;
  s.limited = acting_.limited;
  s.duty = set_.duty;
  s.supply_V = supply_V_;
  s.current_A = current_.present ? current_.value : std::nan("");
  s.resistance_Ohm = resistance_.value_Ohm();
  s.resistance_age_s = resistance_.age_s();
  s.coldest_C = heat_.coldest_C();
  s.hottest_C = heat_.hottest_C();
}

void Heater::limit(const ChannelState& state, double demanded_W, double proven_W,
                   LimitedBy lowered_by) {
  limiter_.set_cap(max_power_W());
  limiter_.set_unproven(proven_W);
  allowed_ = state.may_heat() ? limiter_.step(demanded_W, heat_.hottest_C()) : Limiter::Result{};
  cut_by_ = allowed_.by;
  if (cut_by_ == LimitedBy::nothing && state.may_heat()) allowed_.by = lowered_by;
}

void Heater::drive(const ChannelState& state, bool may_probe, double dither_W) {
  const HeaterSettings& h = settings_;
  board::PowerStage::Output out;
  if (state.may_heat()) {
    const bool old = resistance_.age_s() > h.probe_every_s && may_probe;
    if (old && !probe_.running()) probe_.start();
    out = power_stage_.step(allowed_.power_W, resistance_.value_Ohm(), supply_V_, limiter_.max_W());
  }
  if (state.enable() && probe_.running() && out.duty < h.probe_duty) {
    out.step = static_cast<int>(h.probe_duty * devices_.pwm->steps());
    out.duty = static_cast<double>(out.step) / devices_.pwm->steps();
    out.applied_W = out.duty * supply_V_ * supply_V_ / resistance_.value_Ohm();
    out.clipped = true;
  }
  write_enable(state.enable());
  write_duty(state.enable() ? out.step : 0);
  const bool cut = cut_by_ != LimitedBy::nothing || out.clipped;
  // A dither that was cut does not count.
  const board::AppliedPower set{out.applied_W, out.duty, cut || allowed_.by != LimitedBy::nothing,
                                state.may_heat() && !cut ? dither_W : 0.0};
  set_ = set;
  acting_ = delay_.step(set);
}

void Heater::cut() {
  probe_.stop();
  write_duty(0);
  write_enable(false);
}

void Heater::rest() {
  limiter_.reset();
  power_stage_.reset();
}

void Heater::test_drive(double duty, bool enable) {
  write_enable(enable);
  write_duty(static_cast<int>(duty * devices_.pwm->steps()));
  // On a healthy board no power of the self-test reaches the muscle.
  acting_ = delay_.step({});
}

void Heater::write_duty(int step) {
  if (step == written_step_ && writes_ok_) return;
  writes_ok_ = devices_.pwm->set(step) == hal::Status::ok;
  written_step_ = step;
}

void Heater::write_enable(bool high) {
  if (static_cast<int>(high) == written_enable_ && lines_ok_) return;
  lines_ok_ = devices_.enable->set(high) == hal::Status::ok;
  written_enable_ = static_cast<int>(high);
}

void Heater::apply_comparison(const board::SenseComparison& senses, double resistance_scale) {
  resistance_.set(resistance_.value_Ohm() * resistance_scale);
  calculate_full_scale();
  current_.value *= senses.current_gain / senses_.current_gain;
  senses_ = senses;
  published_senses_.set(senses_);
  power_bounds_.set(senses_);
}

void Heater::set_thermal_facts(const board::ThermalFacts& facts) {
  facts_ = facts;
  board::ThermalFacts used = facts;
  // The thermometer reading belongs to a power that compared senses measured.
  if (!senses_.compared()) used.clear_reading();
  heat_.set_thermal_facts(used, power_bounds_.true_over_measured());
}

}  // namespace supercoil
