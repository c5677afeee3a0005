// The figures by which a run is judged.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "runner/infeasible_time.hpp"
#include "runner/limit_cycle.hpp"
#include "runner/run_meters.hpp"
#include "runner/scenario_forecast.hpp"
#include "runner/simulation.hpp"
#include "supervisor/detectors/margin.hpp"

namespace supercoil::host_sim {

/// From from_s to before to_s.
struct Window {
  double from_s = 0.0;
  double to_s = INFINITY;
};

/// At how many ticks each limit held for a muscle.
struct LimitCount {
  std::array<std::int64_t, limit_names.size()> ticks{};  ///< in the order of LimitedBy
};

/// "fault 20 heater_open; see faults/heater_open in `supercoil docs`"
std::string fault_text(Fault fault);

/// Collects a run's figures as it goes. Tracking is the true position against the controller's own
/// reference model, within the window.
class Summary {
 public:
  explicit Summary(const Window& window) : window_(window) {}

  void add(const TickRecord& record) {
    ++ticks_;
    note_fault(record);
    const auto& other = record.antagonist;
    const bool outside =
        is_outside(record.temperature_rise_K, record.coldest_K, record.hottest_K) ||
        (other && is_outside(other->temperature_rise_K, other->coldest_K, other->hottest_K)) ||
        (record.bundle && record.bundle->outside);
    outside_interval_ticks_ += outside ? 1 : 0;
    limited_ticks_ += record.limited ? 1 : 0;
    ++limits_.ticks[static_cast<std::size_t>(record.limited_by)];
    if (other) ++antagonist_limits_.ticks[static_cast<std::size_t>(other->limited_by)];
    state_ = record.state;
    armed_ = armed_ || state_ == State::armed || state_ == State::active;
    if (record.oscillation_period_s > 0.0 && std::isnan(oscillated_at_s_)) {
      oscillated_at_s_ = record.time_s;
      oscillation_period_s_ = record.oscillation_period_s;
    }
    if (record.open_loop) {
      infeasible_.interrupt();
      unasked_limit_.interrupt();
      limit_cycle_.interrupt();
      power_noise_.interrupt();
    } else {
      add_limit(record);
    }
    if (!std::isfinite(record.power_W) && not_finite_ticks_++ == 0) {
      first_not_finite_s_ = record.time_s;
    }
    if (record.open_loop || record.time_s < window_.from_s || record.time_s >= window_.to_s) return;
    tracking_.add(record.position_m - record.model_m);
    shown_.add(record.measured_m - record.model_m);
    off_reference_.add(record.position_m - record.reference);
    if (is_infeasible(record.reference_limited_by))
      infeasible_tracking_.add(record.position_m - record.model_m);
    motion_.add(record.model_m);
  }
  const ErrorMeter& tracking() const { return tracking_; }
  /// The tracking error as the board's sensor shows it.
  const ErrorMeter& shown() const { return shown_; }
  /// The reference model's motion, within the same window as tracking().
  const MotionMeter& motion() const { return motion_; }
  /// Rms swing of the controller's power within its range while the reference is feasible; NaN: a
  /// position was followed for too short a time, or the loop oscillated or diverged.
  double power_noise_W() const { return oscillated() || diverged() ? NAN : power_noise_.rms_W(); }
  /// Ticks at which the muscle, or another one of its joint or bundle, was outside the firmware's
  /// bounds of its temperature.
  std::int64_t outside_interval_ticks() const { return outside_interval_ticks_; }
  struct FaultEvent {
    Fault fault;
    double time_s;
    detectors::Margin margin;
    /// "fault 20 heater_open at 1.234 s: 0.1 measured, limit 0.27 A (see faults/...)"
    std::string text() const;
  };
  /// In the order in which they latched.
  const std::vector<FaultEvent>& faults() const { return faults_; }
  std::int64_t ticks() const { return ticks_; }
  const LimitCount& limits() const { return limits_; }
  /// Limits of a joint's other muscle; all 0 without one.
  const LimitCount& antagonist_limits() const { return antagonist_limits_; }
  /// Whether it was armed at any tick.
  bool armed() const { return armed_; }
  /// The fault that is latched at the end; none: the run did not end in a fault.
  Fault ended_in() const {
    if (state_ != State::fault) return Fault::none;
    return fault_ != Fault::none ? fault_ : board_fault_;
  }
  /// Ticks at which the controller's power was not finite, and the time of the first.
  std::int64_t not_finite_ticks() const { return not_finite_ticks_; }
  double first_not_finite_s() const { return first_not_finite_s_; }
  /// When a controller first detected that its loop oscillates; NaN: never.
  double oscillated_at_s() const { return oscillated_at_s_; }
  bool oscillated() const { return !std::isnan(oscillated_at_s_); }
  double oscillation_period_s() const { return oscillation_period_s_; }
  /// Ticks at a power limit, other than those of heat, that lasted long enough while the reference
  /// was feasible, over all ticks that followed a position; NaN: none did.
  double unasked_limit_ratio() const { return unasked_limit_.ratio(); }
  /// Of a limit cycle between the power limits while the reference moves; NaN: none was found.
  double limit_cycle_period_s(const Scenario& scenario) const;
  /// Too often for a start, or for the end of an infeasible reference.
  bool diverged() const {
    const double ratio = unasked_limit_.ratio();
    return ratio > diverged_ratio && ratio > infeasible_.ratio();
  }
  /// Whether power_noise_W() shows noise: not if much of the reference was infeasible, because
  /// adaptive laws have then learned wrong.
  bool has_power_noise() const { return !(infeasible_.ratio() > diverged_ratio); }
  /// When the reference asked for more than the muscle can do, and was shaped or cut. Null:
  /// unknown, because an oscillating loop asks for too much by itself.
  const InfeasibleTime* infeasible() const { return oscillated() ? nullptr : &infeasible_; }

  /// In words; empty: it was armed.
  std::string never_armed_because(const Scenario& scenario, const Simulation& simulation) const;

  /// In words, with the error; empty: it followed, or followed nothing (docs/simulation.md).
  std::string did_not_follow_because(const Scenario& scenario,
                                     const std::optional<ScenarioPromise>& promise) const;

  /// summary.json; wall_s: how long the run took.
  nlohmann::ordered_json to_json(const Scenario& scenario,
                                 const std::optional<ScenarioPromise>& promise,
                                 const Simulation& simulation, double wall_s) const;

 private:
  static constexpr double diverged_ratio = 0.05;

  void add_limit(const TickRecord& record) {
    const auto& other = record.antagonist;
    const bool by_antagonist = other && !is_infeasible(record.limited_by);
    const LimitedBy by = by_antagonist ? other->limited_by : record.limited_by;
    const bool excessive = is_infeasible(record.reference_limited_by);
    infeasible_.add(by, excessive, record.time_s);
    unasked_limit_.add(excessive || is_thermal(by) ? LimitedBy::nothing : by, record.time_s);
    if (!excessive) limit_cycle_.add(by, record.time_s);
    if (excessive) return power_noise_.interrupt();
    power_noise_.add(record.time_s, record.clipped_power_W);
  }
  /// Whether most of the error arose where the reference asked for too much.
  bool behind_by_reference() const;

  void note_fault(const TickRecord& record) {
    if (record.fault != fault_ && record.fault != Fault::none) {
      faults_.push_back({record.fault, record.time_s, record.fault_margin});
    }
    const bool is_board_fault =
        record.board_fault != board_fault_ && record.board_fault != Fault::none;
    if (is_board_fault && record.board_fault != record.fault) {
      faults_.push_back({record.board_fault, record.time_s, {.measured = NAN, .limit = NAN}});
    }
    fault_ = record.fault;
    board_fault_ = record.board_fault;
  }

  Window window_;
  Fault fault_ = Fault::none;
  Fault board_fault_ = Fault::none;
  std::vector<FaultEvent> faults_;
  std::int64_t outside_interval_ticks_ = 0;
  ErrorMeter tracking_;
  ErrorMeter shown_;
  ErrorMeter off_reference_;
  ErrorMeter infeasible_tracking_;  ///< of tracking, while the reference asks for too much
  MotionMeter motion_;
  PowerNoiseMeter power_noise_;
  std::int64_t ticks_ = 0;
  std::int64_t limited_ticks_ = 0;
  LimitCount limits_;
  LimitCount antagonist_limits_;
  State state_ = State::disarmed;
  bool armed_ = false;
  std::int64_t not_finite_ticks_ = 0;
  double first_not_finite_s_ = 0.0;
  double oscillated_at_s_ = NAN;
  double oscillation_period_s_ = NAN;
  InfeasibleTime infeasible_;
  InfeasibleTime unasked_limit_;
  LimitCycle limit_cycle_;
};

}  // namespace supercoil::host_sim
