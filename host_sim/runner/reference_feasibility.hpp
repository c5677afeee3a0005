// Whether a muscle can follow a scenario's reference, determined before the run.
#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "runner/infeasible_time.hpp"
#include "scenario/scenario.hpp"
#include "supervisor/limiter.hpp"

namespace supercoil::host_sim {

/// By the linear model that the board believes in, through the controller's reference model,
/// starting at rest.
struct ReferenceFeasibility {
  /// When it first asks for more than the muscle can do for infeasible_lasts_s or longer without a
  /// break; NaN: never. The muscle has caught up when its heat is what the motion needs.
  double first_s = NAN;
  double first_duration_s = NAN;  ///< from then until it has caught up
  bool first_ends = true;         ///< the muscle catches up within the time examined
  /// The limit that it exceeds for most of the infeasible time, and the largest excess.
  LimitedBy limited_by = LimitedBy::nothing;
  double excess_W = 0.0;
  /// When it, like its controller, has lacked power for saturated_s on end; NaN: not in this time.
  double invalid_s = NAN;
  double behind_m = 0.0;          ///< how far the muscle falls behind at most
  double infeasible_ratio = 0.0;  ///< of the time; says nothing about a single step
  double max_m = 0.0;             ///< how far it leads
  double held_m = 0.0;            ///< how far the muscle can be held for good
  LimitedBy held_by = LimitedBy::maximum;
  bool once_identified = false;  ///< until then nothing imposes that bound
  /// For settled sines: how much of their motion about the middle is feasible, up to 1; 0: not even
  /// the middle is.
  double feasible_motion_ratio = 1.0;
  /// Factor by which they must be slower to be feasible, 1 or more; infinite: not even at 100.
  double feasible_slowing = 1.0;

  /// Ratio of the sines' amplitude that passes the reference model, and the rms distance of the
  /// model, with its lag, from the reference.
  double passed_ratio = 1.0;
  double passed_by_recommended_ratio = 1.0;  ///< with the recommended reference model
  double off_reference_rms_m = 0.0;
  /// So little passes that following the model does not mean following the reference.
  bool attenuates() const { return passed_ratio < 0.9; }

  bool feasible() const { return std::isnan(first_s); }
  /// The muscle cannot be held as far as the reference leads.
  bool leads_too_far() const { return max_m > (1.0 + 1e-6) * held_m; }
};

/// At the start, for a muscle alone or against a spring.
bool follows_position(const Conditions& c);

/// At the start, for a muscle alone or against a spring. Empty: it follows no position.
std::optional<ReferenceFeasibility> reference_feasibility(const Scenario& scenario);

/// The same in words; empty if there is no position to follow.
std::string describe_reference(const std::optional<ReferenceFeasibility>& f,
                               const Scenario& scenario);

/// Warns that the reference model passes little of the reference; empty: it passes most.
std::string describe_passed(const std::optional<ReferenceFeasibility>& f);

/// Warns that the reference goes, at the start or after an event, where the board refuses to go;
/// empty: it does not, or a joint's other muscle takes it there.
std::string describe_out_of_range(const Scenario& scenario);

/// Warns that the reference goes, at the start or after an event, higher than the load can rise;
/// empty: it does not.
std::string describe_ceiling(const Scenario& scenario);

/// After a run: how much was infeasible, since when, and what to do; empty: nothing was.
std::string describe_infeasible(const InfeasibleTime& found, const Scenario& scenario);

/// Where the load holds the cold muscle.
double rest_m(const Scenario& scenario);
std::string describe_rest(const Scenario& scenario);
/// Warns that the sensor does not see the rest position; empty: it does.
std::string describe_unseen_rest(const Scenario& scenario);

}  // namespace supercoil::host_sim
