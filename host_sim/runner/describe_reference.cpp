#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "loop/feasibility.hpp"
#include "runner/board_of.hpp"
#include "runner/reference_feasibility.hpp"
#include "text/documentation.hpp"
#include "text/number_text.hpp"

namespace supercoil::host_sim {

namespace {

constexpr int digits = 3;  ///< these are predictions

std::string in_digits(double value) {
  return number_text(value, digits);
}

std::string in_mm(double metres) {
  return in_digits(1e3 * metres) + " mm";
}

/// "holds 12.1 mm indefinitely (limited_by temperature)"
std::string held_text(const ReferenceFeasibility& f) {
  return "holds " + in_mm(f.held_m) + " indefinitely (limited_by " + std::string(name(f.held_by)) +
         ")";
}

std::string feasible_text(const ReferenceFeasibility& f) {
  std::string line = "asks for no more than the muscle can do";
  if (!f.leads_too_far()) return line;
  if (f.once_identified) {
    return line + " until it is identified; from then on it " + held_text(f) + ", not the " +
           in_mm(f.max_m) + " that the reference leads to";
  }
  return line + ", because it does not stay at its maximum, " + in_mm(f.max_m) + ": the muscle " +
         held_text(f);
}

std::string cause_text(const ReferenceFeasibility& f, const Conditions& c) {
  const std::string excess = "up to " + in_digits(f.excess_W) + " W";
  switch (f.limited_by) {
    case LimitedBy::cooling:
      return "it would have to be cooled with " + excess;
    case LimitedBy::temperature:
      return "it may be so hot that it gets " + excess +
             " less power than it needs (limited_by temperature)";
    case LimitedBy::unproven:
      return "it would need " + excess +
             " more power than its proof of response allows (limited_by unproven)";
    default:
      return "it would have to be heated with " + excess + " more than " +
             in_digits(c.power.max_W) + " W";
  }
}

/// When it is infeasible, by how much, and what follows.
std::string infeasible_text(const ReferenceFeasibility& f, const Conditions& c) {
  const std::string lasts =
      f.first_ends ? " for " + in_digits(f.first_duration_s) + " s until the muscle has caught up"
                   : ", and the muscle does not catch up";
  return "asks for more than the muscle can do, first at " + in_digits(f.first_s) + " s" + lasts +
         ", when " + cause_text(f, c) + "; it falls behind by up to " + in_mm(f.behind_m) +
         "; the reference is infeasible for " + in_digits(100.0 * f.infeasible_ratio) +
         " % of the time";
}

/// "; it ends in controller_invalid at about 125 s (see faults/controller_invalid in ...)"
std::string end_text(const ReferenceFeasibility& f) {
  if (std::isnan(f.invalid_s)) return "";
  return "; it ends in controller_invalid at about " + in_digits(f.invalid_s) +
         " s, because the muscle lacks power for too long (see " +
         documentation_page("faults/controller_invalid") + ")";
}

/// Shaping does not know of a load that pulls at the muscle, which then gets no more power.
bool shaping_would_do(const Conditions& c, LimitedBy limited_by) {
  if (c.controller.shape_reference) return false;
  return !is_thermal(limited_by) || c.plant.load_N <= 0.0;
}

/// Which motion would be feasible instead of the sines.
std::string motion_text(const ReferenceFeasibility& f) {
  if (f.feasible_motion_ratio == 1.0) return "";
  std::string text =
      "; " + in_digits(f.feasible_motion_ratio) + " of its motion about the middle is feasible";
  if (std::isfinite(f.feasible_slowing))
    text += ", or all of it " + in_digits(f.feasible_slowing) + " times as slow";
  return text;
}

}  // namespace

std::string describe_reference(const std::optional<ReferenceFeasibility>& f,
                               const Scenario& scenario) {
  if (!f) return {};
  if (f->feasible()) return feasible_text(*f);
  std::string line = infeasible_text(*f, scenario.start);
  if (f->leads_too_far()) {
    line += "; the muscle " + held_text(*f);
    if (f->once_identified) line += " once it is identified";
  }
  line += end_text(*f);
  if (f->feasible_motion_ratio == 0.0) return line + "; not even its middle can be held";
  line += motion_text(*f);
  if (shaping_would_do(scenario.start, f->limited_by))
    return line + "; with shape_reference = true the muscle follows it as far as it can";
  if (!scenario.start.controller.shape_reference) return line;
  return line + (std::isnan(f->invalid_s)
                     ? "; it is shaped, so that the muscle follows it as far as it can"
                     : "; shaping does not account for plant.load_N");
}

std::string describe_passed(const std::optional<ReferenceFeasibility>& f) {
  if (!f || !f->attenuates()) return {};
  std::string text = "the reference model passes " + in_digits(f->passed_ratio);
  text += " of its amplitude: a muscle that follows the model is " + in_mm(f->off_reference_rms_m);
  text += " rms from the reference itself";
  if (f->passed_by_recommended_ratio > 1.1 * f->passed_ratio) {
    text += "; the recommended reference_model passes " + in_digits(f->passed_by_recommended_ratio);
  }
  return text + "; a slower reference keeps more of it";
}

std::string describe_infeasible(const InfeasibleTime& found, const Scenario& scenario) {
  if (!found.found()) return {};
  const Event* before = nullptr;
  for (const Event& event : scenario.events) {
    if (event.at_s <= found.first_s()) before = &event;
  }
  std::array<char, 160> text{};
  std::snprintf(
      text.data(), text.size(),
      "the reference asked for more than the muscle can do, first at %.1f s for %.3g s and "
      "in %.1f %% of all ticks that followed it",
      found.first_s(), found.first_duration_s(), 100.0 * found.ratio());
  std::string line = text.data();
  if (before != nullptr && !before->changes.empty())
    line += ", after the event at " + number_text(before->at_s, 6) + " s (" + before->changes + ")";
  line += ", mostly limited_by " + std::string(name(found.main_limit()));
  const Conditions& then = before != nullptr ? before->conditions : scenario.start;
  return line +
         (is_thermal(found.main_limit()) ? ": use a smaller reference"
                                         : ": use a slower or smaller reference") +
         (shaping_would_do(then, found.main_limit()) ? ", or shape_reference = true" : "");
}

std::string describe_out_of_range(const Scenario& scenario) {
  const double max_m = firmware_of(scenario).channels[0].supervision.max_travel_m;
  const auto refused = [&](const Conditions& c) {
    return follows_position(c) && (c.reference.min() < 0.0 || c.reference.max() > max_m);
  };
  const auto text = [&](const Conditions& c) {
    return "goes from " + in_mm(c.reference.min()) + " to " + in_mm(c.reference.max()) +
           ", but the board takes only 0 to " + in_mm(max_m) +
           " (limits.max_travel_m) and refuses all else, which ends in command_timeout";
  };
  if (refused(scenario.start)) return text(scenario.start);
  for (const Event& event : scenario.events) {
    if (refused(event.conditions)) {
      return "from the event at " + number_text(event.at_s, 6) + " s on it " +
             text(event.conditions);
    }
  }
  return {};
}

std::string describe_ceiling(const Scenario& scenario) {
  const auto too_high = [](const Conditions& c) {
    return follows_position(c) && c.reference.max() > c.plant.effects.ceiling_m;
  };
  const auto text = [](const Conditions& c) {
    return "goes up to " + in_mm(c.reference.max()) +
           ", but the load cannot rise above plant.ceiling_m, " + in_mm(c.plant.effects.ceiling_m);
  };
  if (too_high(scenario.start)) return text(scenario.start);
  for (const Event& event : scenario.events) {
    if (too_high(event.conditions)) {
      return "from the event at " + number_text(event.at_s, 6) + " s on it " +
             text(event.conditions);
    }
  }
  return {};
}

double rest_m(const Scenario& scenario) {
  const PlantSettings& plant = scenario.start.plant;
  return 0.0 - plant.load_N / plant.parameters.stiffness_N_per_m;
}

std::string describe_rest(const Scenario& scenario) {
  if (scenario.start.joint) return {};
  return "rests at " + in_mm(rest_m(scenario)) + " while it is cold; the sensor reads " +
         in_mm(scenario.start.position_sensor.min_m) + " to " +
         in_mm(scenario.start.position_sensor.range_m);
}

std::string describe_unseen_rest(const Scenario& scenario) {
  const Conditions& c = scenario.start;
  const double min_m = c.position_sensor.min_m;
  if (c.joint || rest_m(scenario) >= min_m) return {};
  return "plant.load_N holds the muscle at " + in_mm(rest_m(scenario)) +
         " while it is cold, and the sensor reads no less than " +
         number_text(1e3 * min_m, digits) +
         " mm: its reading stands still there and looks frozen (see " +
         documentation_page("faults/sensor_frozen") +
         "); "
         "lower sensor.position.min_m";
}

}  // namespace supercoil::host_sim
