// Single values of a controller or an estimator, by name: as its configuration has them, and as
// they are changed on a running board.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "supercoil/control/estimation/estimator.hpp"
#include "supercoil/control/tracking/controller_settings.hpp"

namespace supercoil::control {

/// How to interpret the number of a Tunable.
enum class TunableType : std::uint8_t {
  number,
  flag,     ///< 0 or 1
  kind,     ///< a ControllerKind or an EstimatorKind
  model,    ///< 0: real poles; else an index in tunable_models, from 1
  pole,     ///< a number; configurations have all three in reference_model.poles_rad_per_s
  element,  ///< a number; configurations have a list of all that differ only in the last digit
};

/// The reference models that have names.
inline constexpr std::array<std::string_view, 3> tunable_models{"design", "eq8", "wm16"};

/// A value that a controller or an estimator may have.
struct Tunable {
  /// How to read and set a common setting; null: it belongs to a law or an estimator, or to none.
  template <class Settings>
  struct Access {
    double (*get)(const Settings& settings) = nullptr;
    void (*set)(Settings& settings, double value) = nullptr;
  };

  std::string_view name;  ///< as in configurations
  TunableType type;
  double min;  ///< allowed, ends included
  double max;
  Access<ControllerSettings> of_controller{};
  Access<EstimatorSettings> of_estimator{};

  /// NaN when a controller of this kind has no such value, or its reference model no real poles.
  double get(const ControllerSettings& settings) const;
  /// The same for an estimator.
  double get(const EstimatorSettings& settings) const;
  /// Only where get() is not NaN. to: in range.
  void set(ControllerSettings& settings, double to) const;
  /// The same for an estimator.
  void set(EstimatorSettings& settings, double to) const;
  /// False for NaN, and for a fraction of a flag, kind or model. Which kinds of estimators exist is
  /// not checked.
  bool in_range(double value) const;
  bool controllers_have() const;  ///< of some kind
  bool estimators_have() const;
  bool is_number() const {
    return type == TunableType::number || type == TunableType::pole || type == TunableType::element;
  }
};

/// The indices are those of the protocol (docs/can-protocol.md): new ones come last. They can be
/// set one after the other in this order: which of them exist depends on the kind and
/// reference_model.
inline constexpr std::size_t tunable_count = 49;
/// All of them, in that order.
const std::array<Tunable, tunable_count>& tunables();
/// tunable_count when there is none of this name.
std::size_t tunable_named(std::string_view name);

}  // namespace supercoil::control
