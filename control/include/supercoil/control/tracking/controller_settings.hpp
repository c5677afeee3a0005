// The settings of a controller, and the list of the laws that it can be.
#pragma once

#include <optional>
#include <tuple>

#include "supercoil/control/actuator/parameters.hpp"
#include "supercoil/control/scalar/kinds.hpp"
#include "supercoil/control/tracking/adaptive_feedforward.hpp"
#include "supercoil/control/tracking/learned_feedforward.hpp"
#include "supercoil/control/tracking/mrac.hpp"
#include "supercoil/control/tracking/mrac_least_squares.hpp"
#include "supercoil/control/tracking/pd_feedforward.hpp"
#include "supercoil/control/tracking/pi.hpp"

namespace supercoil::control {

/// The numbers are sent over CAN: a new one comes last.
enum class ControllerKind { power, pi, pd_ff, mrac, mrac_ls, adaptive_ff, learned_ff };

/// What a Controller is made of. Of the laws' own settings only those of `kind` are used. Nothing
/// is checked here: see supported(), contradictions_of_law() and check_fit().
struct ControllerSettings {
  ControllerKind kind = ControllerKind::mrac;
  Arithmetic arithmetic = Arithmetic::float64;
  ReferenceModelSettings model = wm16_model();
  double dc_gain_m_per_W = PhysicalParameters{}.dc_gain_m_per_W();  ///< of the channel's muscle
  PiSettings pi;
  PdFeedforwardSettings pd_ff;
  MracSettings mrac;
  MracLeastSquaresSettings mrac_ls;
  AdaptiveFeedforwardSettings adaptive_ff;
  LearnedFeedforwardSettings learned_ff;
  /// Slows down the feedback of a loop that is found to oscillate, if its law can be slowed down.
  bool slow_when_oscillating = true;
  /// References are made feasible for the muscle; otherwise they are taken as they are.
  bool shape_reference = false;
  RegressionScale shaped_for;  ///< the assumed muscle, until it is identified

  /// Sets the muscle from which every law begins. max_W: of its channel; NaN while unknown.
  void set_nominal(const PhysicalParameters& muscle, double max_W);
};

template <ControllerKind Kind, LawDefinition Definition, auto Member>
using ListedLaw = Listed<ControllerKind, Kind, Definition, Member>;

/// Every law; open loop has none.
using Laws = std::tuple<
    ListedLaw<ControllerKind::pi, PiLaw, &ControllerSettings::pi>,
    ListedLaw<ControllerKind::pd_ff, PdFeedforwardLaw, &ControllerSettings::pd_ff>,
    ListedLaw<ControllerKind::mrac, MracLaw, &ControllerSettings::mrac>,
    ListedLaw<ControllerKind::mrac_ls, MracLeastSquaresLaw, &ControllerSettings::mrac_ls>,
    ListedLaw<ControllerKind::adaptive_ff, AdaptiveFeedforwardLaw,
              &ControllerSettings::adaptive_ff>,
    ListedLaw<ControllerKind::learned_ff, LearnedFeedforwardLaw, &ControllerSettings::learned_ff>>;

inline constexpr auto controller_names =
    names_of<Laws, ControllerKind>("power", ControllerKind::power);

/// Least squares needs float or double: its covariance spans more than q8.24 does.
constexpr bool supported(ControllerKind kind, Arithmetic arithmetic) {
  return runs_in<Laws>(kind, arithmetic);
}

/// True for laws whose feedback changes while they run.
constexpr bool adapts(ControllerKind kind) {
  bool adaptive = false;
  with_listed<Laws>(kind, [&](auto listed) { adaptive = decltype(listed)::Definition::adapts; });
  return adaptive;
}

/// The law with the gains that follow from a muscle; for a law that adapts, with the θ* that
/// matches it (mrac_matching.hpp). Empty in open loop, and when no θ matches.
std::optional<FixedLaw> fixed_law(const ControllerSettings& settings,
                                  const PhysicalParameters& muscle);

/// Values that exclude each other, and premises of the law that fail.
LawProblems contradictions_of_law(const ControllerSettings& settings);

/// The first setting that q8.24 cannot hold; empty when all fit, and for other arithmetics. Fixed
/// point saturates silently, so call this before running it. quantity is the setting's name in
/// configurations, value what fixed point would have to hold for it. max_reference_m: of the
/// channel; max_W: its maximum power.
std::optional<Violation> check_fit(const ControllerSettings& settings, double step_s,
                                   double max_reference_m, double max_W);

}  // namespace supercoil::control
