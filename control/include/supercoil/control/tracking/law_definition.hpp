// What each law declares besides its equations: how it is named, set, made and checked.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <optional>
#include <string_view>

#include "supercoil/control/estimation/parametric_model.hpp"
#include "supercoil/control/scalar/fixed_point_fit.hpp"
#include "supercoil/control/scalar/setting_value.hpp"
#include "supercoil/control/tracking/fixed_law.hpp"
#include "supercoil/control/tracking/law.hpp"

namespace supercoil::control {

/// A problem of a law's own settings.
struct LawProblem {
  const char* key;  ///< the setting, by its name in configurations
  const char* message;
  bool premise = false;  ///< of the law's proof: the law may run if that is accepted
};

/// Up to 8 problems, without heap; further ones are dropped.
class LawProblems {
 public:
  /// Without effect when there are 8 already.
  void add(const LawProblem& problem) {
    if (count_ < all_.size()) all_[count_++] = problem;
  }
  const LawProblem* begin() const { return all_.data(); }
  const LawProblem* end() const { return all_.data() + count_; }

 private:
  std::array<LawProblem, 8> all_{};  // MRAC has six premises
  std::size_t count_ = 0;
};

/// What a controller gives its law besides the law's own settings.
struct LawContext {
  const ReferenceModelSettings& model;
  double dc_gain_m_per_W;  ///< metres per watt at rest, the law's unit
};

/// What most laws declare; a law's definition hides the members that differ.
struct LawDefaults {
  static constexpr bool fixed_point = true;  ///< runs in q8.24, and has check_fit()
  static constexpr bool adapts = false;      ///< its feedback changes while it runs
  static constexpr std::string_view when_unstable = "lower its gains";

  /// scale: of the channel's muscle. max_W: its maximum power, NaN while unknown.
  template <class Settings>
  static void set_nominal(Settings&, const RegressionScale& /*scale*/, double /*max_W*/) {}

  /// Settings that exclude each other, and premises that fail.
  template <class Settings>
  static void add_contradictions(LawProblems&, const Settings&, const LawContext&) {}
};

/// check_fit(): what q8.24 cannot hold, for a step in seconds and signals up to a peak in watts.
template <class Definition>
concept ChecksItsFit = requires(const typename Definition::Settings& settings,
                                const LawContext& context, FixedPointFit& fit, double value) {
  Definition::check_fit(fit, settings, context, value, value);
};

template <class Definition>
concept ChecksFixedPoint = !Definition::fixed_point || ChecksItsFit<Definition>;

/// In<Scalar>: the law. make(): makes it, for step_s > 0. fixed_law(): its action on small errors,
/// with the gains that follow from a muscle or with the parameters that match it; empty when none
/// match. values: a range of SettingValue.
template <class Definition, class Law = typename Definition::template In<double>,
          class Value = SettingValue<typename Definition::Settings>>
concept LawDefinition = TrackingLaw<Law, double> && ChecksFixedPoint<Definition> &&
    requires(typename Definition::Settings settings, const LawContext& context,
             const RegressionScale& scale, const PhysicalParameters& muscle, LawProblems problems,
             double value) {
  { Definition::name } -> std::convertible_to<std::string_view>;
  { Definition::adapts } -> std::convertible_to<bool>;
  { Definition::when_unstable } -> std::convertible_to<std::string_view>;
  { *Definition::values.begin() } -> std::convertible_to<Value>;
  { Definition::template make<double>(settings, context, value) } -> std::same_as<Law>;
  { Definition::fixed_law(settings, context, muscle) } -> std::same_as<std::optional<FixedLaw>>;
  Definition::add_contradictions(problems, settings, context);
  Definition::set_nominal(settings, scale, value);
};

}  // namespace supercoil::control
