// Whether a muscle can follow a scenario's reference, told before it is run.
#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "runner/infeasible_time.hpp"
#include "scenario/scenario.hpp"
#include "supervisor/limiter.hpp"

namespace supercoil::host_sim {

/// By the linear model of the muscle that the board believes in, through the controller's reference
/// model from rest on.
struct ReferenceFeasibility {
  /// When it first asks for more than the muscle can do for infeasible_lasts_s or longer on end;
  /// NaN: never. The muscle has caught up when its heat is what the motion needs.
  double first_s = NAN;
  double first_lasts_s = NAN;  ///< from then until it has caught up
  bool first_ends = true;      ///< it does so while this is looked at
  /// What it asks too much of for most of all that time, and by how much at most.
  LimitedBy limited_by = LimitedBy::nothing;
  double excess_W = 0.0;
  /// It lacks power for saturated_s on end by then, as its controller will; NaN: not in this time.
  double invalid_s = NAN;
  double behind_m = 0.0;          ///< how far the muscle falls behind at most
  double infeasible_ratio = 0.0;  ///< of the time, which says nothing of a single step
  double max_m = 0.0;             ///< how far it leads
  double held_m = 0.0;            ///< how far the muscle can be held for good
  LimitedBy held_by = LimitedBy::maximum;
  bool once_identified = false;  ///< nothing bounds it so before
  /// Of a sine or several, once it has come up to them: how much of their motion about the middle
  /// is feasible, up to 1; 0: not even the middle is.
  double feasible_motion_ratio = 1.0;
  /// How many times as slow they are feasible, 1 or more; infinite: not at 100 times.
  double feasible_slowing = 1.0;

  /// How much of its amplitude a sine, or several, have left behind the reference model, and how
  /// far the model then is from the reference itself, rms, late as it is.
  double passed_ratio = 1.0;
  double passed_by_recommended_ratio = 1.0;  ///< the reference model that suits the muscle
  double off_reference_rms_m = 0.0;
  /// So little that following the model is not following the reference.
  bool passes_little() const { return passed_ratio < 0.9; }

  bool feasible() const { return std::isnan(first_s); }
  /// The muscle cannot stay as far as it leads.
  bool leads_too_far() const { return max_m > (1.0 + 1e-6) * held_m; }
};

/// At the start, of a muscle alone or against a spring.
bool follows_position(const Conditions& c);

/// At the start, of a muscle alone or against a spring. Empty: it follows no position.
std::optional<ReferenceFeasibility> reference_feasibility(const Scenario& scenario);

/// What to tell of that; empty where there is no position to follow.
std::string describe_reference(const Scenario& scenario);

/// That the reference model passes little of it; empty: it passes most.
std::string describe_passed(const Scenario& scenario);

/// That it goes, now or after an event, where the board refuses to; empty: it does not, or a
/// joint's other muscle takes it there.
std::string describe_out_of_range(const Scenario& scenario);

/// The same after a run: how much of it, since when, and what to do; empty: it was feasible.
std::string describe_infeasible(const InfeasibleTime& found, const Scenario& scenario);

/// Where the load holds the cold muscle.
double rest_m(const Scenario& scenario);
std::string describe_rest(const Scenario& scenario);
/// That it is where its sensor does not see it; empty: it sees it.
std::string describe_unseen_rest(const Scenario& scenario);

}  // namespace supercoil::host_sim
