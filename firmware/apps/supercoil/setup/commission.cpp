#include "apps/supercoil/setup/commission.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <nlohmann/json.hpp>

#include "apps/common/progress.hpp"
#include "apps/supercoil/setup/channel_now.hpp"
#include "apps/supercoil/setup/channel_steps.hpp"
#include "apps/supercoil/setup/figures.hpp"
#include "apps/supercoil/setup/identified.hpp"
#include "apps/supercoil/setup/muscle_answers.hpp"
#include "apps/supercoil/setup/record.hpp"
#include "apps/supercoil/setup/running_file.hpp"
#include "apps/supercoil/setup/sense_comparison.hpp"
#include "apps/supercoil/value_range.hpp"
#include "config/describe.hpp"
#include "modes/calibrate.hpp"
#include "modes/identify.hpp"
#include "text/command_text.hpp"
#include "text/number_text.hpp"
#include "text/refusal_words.hpp"
#include "text/result_words.hpp"

namespace supercoil::operating {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::chrono::milliseconds renewal{50};
constexpr std::chrono::milliseconds reference_step{20};
/// A muscle that is cold by all bounds is armed at once; for others the file gives the time.
constexpr double arming_s = 5.0;
/// For each muscle. The steps after a find take a minute or two more.
constexpr double max_calibrate_s = modes::Calibrate::Settings{}.max_wait_s + 10.0;
constexpr double max_identify_s = modes::Identify::Settings{}.max_s + 200.0;
/// Rise above the air at and below which calibrate takes a zero.
constexpr double cold_K = modes::Calibrate::Settings{}.cold_K;
/// Min ratio of the first motion to the promised error: less is hardly more than the error.
constexpr double significant_ratio = 3.0;

/// Time until the muscle is cold, however hot it was at boot.
double cold_after(const ChannelSettings& channel) {
  return control::max_time_constant_s(channel.thermal.bounds) *
         std::log(std::max(1.0, channel.thermal.boot_rise_K / cold_K));
}

/// Half of the random muscles (tests/setup/setup_study.cpp) are identified within this time.
double typical_identify_s(const ChannelSettings& channel) {
  const double tau_s = -1.0 / channel.muscle.thermal_pole_rad_per_s();
  return 20.0 + std::min(23.0 * tau_s, 100.0 + 6.0 * tau_s);
}

/// A calibration never finds exactly the file's values.
bool is_calibrated(const board::Calibration& now, const board::Calibration& configured) {
  const auto same = [](double a, double b) {
    return std::abs(a - b) <= float_rounding_ratio * std::abs(b);
  };
  return !same(now.position_offset_m, configured.position_offset_m) ||
         !same(now.cold_resistance_Ohm, configured.cold_resistance_Ohm);
}

}  // namespace

Commission::Commission(BoardLink& board, std::string channel, const BoardSettings& settings,
                       std::size_t index, Operator& user)
    : board_(board),
      channel_(std::move(channel)),
      settings_(settings),
      index_(index),
      configured_(settings.channels[index]),
      user_(user) {}

StepResult Commission::run(const std::string& step) {
  if (step == "senses") return compare_senses();
  if (step == "calibrate") return calibrate();
  if (step == "scale") return scale();
  if (step == "limits") return limits();
  if (step == "identify") return identify();
  return step == "gains" ? gains() : move();
}

Commission::Done Commission::ask(const std::string& command) {
  const auto answer = board_.ask(channel_ + " " + command);
  if (!answer) return tl::unexpected(answer.error());
  if (*answer == "ok") return {};
  return failure(with_present_fault(command + ": " + *answer, board_, channel_));
}

Commission::Done Commission::require_found(const std::string& mode, const ResultText& result) {
  if (!result) return tl::unexpected(result.error());
  if (*result == "found") return {};
  const std::string fault = present_fault(board_, channel_);
  return failure(mode + " ended: " + result_text(*result, "", fault) +
                 (fault.empty() ? result_remedy() : ""));
}

Commission::Done Commission::reset_faults() {
  for (const std::size_t one : heated_together(settings_, index_)) {
    const std::string channel = std::to_string(std::stoul(channel_) + one - index_);
    const std::string fault = present_fault(board_, channel);
    if (fault.empty()) continue;
    std::string line = "channel ";
    line += channel;
    line += ": ";
    line += fault;
    user_.show(line);
    const auto answer = user_.ask(reset_fault, [] { return Done(); });
    if (user_.interrupted()) return failure("interrupted");
    if (!answer || *answer == 0.0) return failure("cannot be armed: " + fault);
    const auto done = board_.ask(channel + " reset");
    if (!done) return tl::unexpected(done.error());
    if (*done != "ok") return failure("reset: " + *done + ", " + fault);
  }
  return {};
}

/// After a start the board waits until its muscle must be cool.
Commission::Done Commission::arm() {
  if (auto reset = reset_faults(); !reset) return reset;
  const double max_s = arming_s + max_time_s([&](const ChannelSettings& channel) {
                         return feasibility(channel, settings_).armable_s;
                       });
  const double begin_s = board_.time_s();
  for (;;) {
    const double elapsed_s = board_.time_s() - begin_s;
    const auto answer = operating::arm(board_, channel_);
    if (!answer) return tl::unexpected(answer.error());
    if (*answer == "ok") return {};
    if (!refuses(*answer, Refusal::not_ready) || elapsed_s >= max_s) {
      const std::string fault = present_fault(board_, channel_);
      if (!fault.empty()) return failure("cannot be armed: " + fault);
      // Refused without a fault: it is armed already.
      if (refuses(*answer, Refusal::wrong_state)) return {};
      return failure("arm: " + *answer);
    }
    user_.show_progress("waiting until the muscle is certainly cool", elapsed_s / max_s);
    if (user_.interrupted()) return failure("interrupted");
    board_.wait(std::chrono::seconds(1));
  }
}

Commission::ResultText Commission::run_mode(const std::string& mode, double max_s) {
  const auto done = [&] { return board_.progress(channel_).value_or(NAN); };
  // The first call takes a moment, in which a command to heat would expire.
  if (user_.sees_progress()) done();
  if (auto begun = ask(mode); !begun) return tl::unexpected(begun.error());
  if (antagonist()) max_s *= 2.0;
  const double begin_s = board_.time_s();
  for (;;) {
    board_.wait(renewal);
    const double elapsed_s = board_.time_s() - begin_s;
    if (elapsed_s >= max_s) break;
    if (user_.sees_progress()) user_.show_progress(mode, done());
    if (user_.interrupted()) {
      static_cast<void>(ask("rest"));
      return failure(mode + ": interrupted");
    }
    const auto answer = board_.ask(channel_ + " renew");
    if (!answer) return tl::unexpected(answer.error());
    if (*answer != "ok") break;
  }
  const auto all = endings(board_, channel_);
  if (!all) return tl::unexpected(all.error());
  for (const auto& [channel, ending] : *all) {
    std::string label = mode;
    if (all->size() > 1) label += " of channel " + channel;
    if (all->size() > 1) user_.show(label + ": " + ending.result);
    if (!ending.notes.empty() && ending.notes != ending.result)
      user_.show(label + " notes: " + ending.notes);
  }
  return all->back().ending.result;
}

Commission::ResultText Commission::calibrate_when_cold() {
  const double cold_after_s = max_time_s(cold_after);
  const double begin_s = board_.time_s();
  for (;;) {
    // One muscle after the other.
    auto result =
        run_mode("calibrate",
                 max_calibrate_s * static_cast<double>(heated_together(settings_, index_).size()));
    const double left_s = cold_after_s - (board_.time_s() - begin_s);
    if (!result || *result != "not_cold" || left_s < 0.0) return result;
    user_.show("may not be cold yet, by its temperature bounds; cold in " + in_digits(left_s) +
               " s at the latest");
  }
}

std::optional<Commission::MeasuredMuscle> Commission::antagonist() const {
  const JointSettings* joint = settings_.joint_of(index_);
  if (joint == nullptr || joint->agonist != index_) return std::nullopt;
  const std::size_t apart = joint->antagonist - joint->agonist;
  return MeasuredMuscle{std::to_string(std::stoul(channel_) + apart),
                        settings_.channels[joint->antagonist]};
}

double Commission::max_time_s(const std::function<double(const ChannelSettings&)>& time_of) const {
  double max_s = 0.0;
  for (const std::size_t channel : heated_together(settings_, index_))
    max_s = std::max(max_s, time_of(settings_.channels[channel]));
  return max_s;
}

StepResult Commission::report_each(Report report) {
  const auto other = antagonist();
  if (!other) return (this->*report)({channel_, configured_});
  user_.show("the agonist, channel " + channel_ + ":");
  auto own = (this->*report)({channel_, configured_});
  if (!own) return own;
  user_.show("the antagonist, channel " + other->channel + ":");
  auto other_result = (this->*report)(*other);
  if (!other_result) return other_result;
  (*other_result)["channel"] = settings_.joint_of(index_)->antagonist + 1;
  (*own)[SetupRecord::antagonist_key] = std::move(*other_result);
  return own;
}

StepResult Commission::calibrate() {
  if (auto armed = arm(); !armed) return tl::unexpected(armed.error());
  if (auto done = require_found("calibrate", calibrate_when_cold()); !done)
    return tl::unexpected(done.error());
  return report_each(&Commission::report_calibration);
}

namespace {

/// Max contraction that may remain when calibrate considers a muscle cold.
double zero_uncertainty_m(const control::PhysicalParameters& muscle) {
  return cold_K * muscle.force_per_kelvin_N_per_K / muscle.stiffness_N_per_m;
}

}  // namespace

StepResult Commission::report_calibration(const MeasuredMuscle& muscle) {
  const auto known = board_.muscle(muscle.channel);
  if (!known) return tl::unexpected(known.error());
  const double cold_Ohm = (*known)[known_cold_resistance];
  const double offset_m = (*known)[known_position_offset];
  const double uncertainty_m = zero_uncertainty_m(muscle.configured.muscle);
  user_.show("zero: the sensor reads " + in_digits(1e3 * offset_m) + " mm there, at most " +
             in_digits(1e3 * uncertainty_m) + " mm from where the cold muscle rests");
  user_.show("cold resistance: " +
             beside(cold_Ohm, muscle.configured.heater.cold_resistance_Ohm, "Ohm"));
  return Json{{"position_offset_m", json_number(offset_m)},
              {"position_offset_uncertainty_m", json_number(uncertainty_m)},
              {"cold_resistance_Ohm", json_number(cold_Ohm)}};
}

StepResult Commission::compare_senses() {
  ComparisonPlan plan = plan_comparison(channel_, configured_, settings_);
  // A meter's amperes mean nothing without the power at which they were read.
  const auto power_W = user_.scripted(
      {"power_W", "the greater of the two powers, in W", {1e-3 * plan.power_W, plan.power_W}, NAN});
  if (power_W && !*power_W) return tl::unexpected(power_W->error());
  if (power_W) plan.power_W = **power_W;
  user_.show(describe_plan(plan));
  if (auto reset = reset_faults(); !reset) return tl::unexpected(reset.error());
  const auto senses = operating::compare_senses(board_, plan, user_);
  if (!senses) return tl::unexpected(senses.error());
  user_.show(describe_comparison(*senses));
  user_.show(power_bounds_text(configured_, settings_, *senses));
  return Json{{"power_W", plan.power_W},
              {"supply_gain", senses->supply_gain},
              {"current_gain", senses->current_gain},
              {"error_ratio", senses->error_ratio}};
}

StepResult Commission::scale() {
  const double max_mm = 1e3 * configured_.supervision.max_travel_m;
  const auto place_mm =
      user_.ask({"place_mm",
                 "Hold the muscle's end at a place measured with a ruler. How far "
                 "is it from rest, in the direction of contraction, in mm",
                 {0.001 * max_mm, max_mm},
                 NAN},
                [] { return Done(); });
  if (!place_mm) return tl::unexpected(place_mm.error());
  const std::string line = channel_ + " scale " + number_text(1e-3 * *place_mm, 9);
  const auto taken = board_.ask(line);
  if (!taken) return tl::unexpected(taken.error());
  if (*taken != "ok") {
    const std::string range = refuses(*taken, Refusal::out_of_range)
                                  ? accepted_range_text(board_, channel_, Verb::scale)
                                  : "";
    return failure(with_present_fault(
        line.substr(channel_.size() + 1) + ": " + answer_with_reason(line, *taken + range), board_,
        channel_));
  }
  const auto known = board_.muscle(channel_);
  if (!known) return tl::unexpected(known.error());
  const double scale = (*known)[known_position_scale];
  user_.show("scale of the position: " + beside(scale, configured_.calibration.position_scale, ""));
  return Json{{"position_scale", json_number(scale)}};
}

StepResult Commission::limits() {
  const auto now = channel_now(board_, channel_, configured_);
  if (!now) return tl::unexpected(now.error());
  if (!is_calibrated(now->settings.calibration, configured_.calibration)) {
    user_.show(
        "warning: this board was never calibrated: its zero is unknown, and so is a limit that is "
        "counted from it; the step calibrate takes the zero");
  }
  if (auto armed = arm(); !armed) return tl::unexpected(armed.error());
  auto found = find_travel_limit(board_, channel_, *now, settings_, user_);
  if (!found) return failure(with_present_fault(found.error().text(), board_, channel_));
  return found;
}

StepResult Commission::identify() {
  const double takes_s = max_time_s(typical_identify_s) * (antagonist() ? 2.0 : 1.0);
  user_.show(
      "takes about " + duration_text(takes_s) +
      " if the file's time constant is right, and up to three times that if the muscle is far "
      "from linear");
  if (auto armed = arm(); !armed) return tl::unexpected(armed.error());
  if (auto done = require_found("identify", run_mode("identify", max_identify_s)); !done)
    return tl::unexpected(done.error());
  return report_each(&Commission::report_muscle);
}

StepResult Commission::report_muscle(const MeasuredMuscle& muscle) {
  const auto known = board_.muscle(muscle.channel);
  if (!known) return tl::unexpected(known.error());
  return report_identified(*known, muscle.configured, user_);
}

StepResult Commission::gains() {
  const auto now = channel_now(board_, channel_, configured_);
  if (!now) return tl::unexpected(now.error());
  return choose_gains(board_, channel_, *now, settings_, user_);
}

StepResult Commission::move() {
  const auto now = channel_now(board_, channel_, configured_);
  if (!now) return tl::unexpected(now.error());
  const FirstMotion motion =
      plan_first_motion(feasibility(now->settings, settings_), now->settings.unexplained_ratio);
  const auto promise = now->promise(now->settings.controllers.front(), settings_, motion);
  const char* unpromised = now->in_joint() ? "no error is promised for a joint"
                                           : "no error is promised: controller 0 is not learned_ff";
  user_.show("moves for " + duration_text(motion.end_s()) + ": three periods of " +
             number_text(motion.period_s, 3) + " s, between " +
             number_text(1e3 * (motion.middle_m - motion.amplitude_m), 3) + " and " +
             number_text(1e3 * (motion.middle_m + motion.amplitude_m), 3) + " mm");
  user_.show(promise ? "promised: " + config::describe_promise(*promise, motion) : unpromised);
  const double standing_still_m = motion.amplitude_m / std::numbers::sqrt2;
  if (promise && standing_still_m < significant_ratio * promise->error_m()) {
    user_.show(
        "so small a motion shows little: a muscle that did not move at all would be off by " +
        in_digits(1e6 * standing_still_m) +
        " um rms; supercoild --check says what limits the travel that it can hold");
  }
  if (auto armed = arm(); !armed) return tl::unexpected(armed.error());
  double square_sum = 0.0;
  int samples = 0;
  const double begin_s = board_.time_s();
  for (;;) {
    const double time_s = board_.time_s() - begin_s;
    if (time_s >= motion.end_s()) break;
    if (auto obeyed = ask("position " + number_text(motion.at(time_s), 9)); !obeyed)
      return tl::unexpected(obeyed.error());
    board_.wait(reference_step);
    const auto error_m = board_.error_m(channel_);
    if (!error_m) return tl::unexpected(error_m.error());
    user_.show_progress("moving", time_s / motion.end_s());
    if (user_.interrupted()) break;
    if (time_s < motion.settled_s() || std::isnan(*error_m)) continue;
    square_sum += *error_m * *error_m;
    ++samples;
  }
  if (auto rests = ask("rest"); !rests) return tl::unexpected(rests.error());
  if (user_.interrupted()) return failure("interrupted");
  if (samples == 0) return failure("the board reported no tracking error");
  const double error_m = std::sqrt(square_sum / samples);
  Json found{{"error_m", error_m},
             {"middle_m", motion.middle_m},
             {"amplitude_m", motion.amplitude_m},
             {"standing_still_m", standing_still_m},
             {"period_s", motion.period_s}};
  std::string text = "followed within " + in_digits(1e6 * error_m) + " um rms";
  if (promise) {
    const bool kept = error_m <= promise->error_m();
    text += kept ? ": the promise is kept" : ": the promise is not kept";
    found.update(promise_json(*promise));
    found["kept"] = kept;
  }
  user_.show(text);
  return found;
}

bool Commission::kept(const Json& result) {
  return result.value("kept", true);
}

}  // namespace supercoil::operating
