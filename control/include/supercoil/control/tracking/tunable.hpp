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

/// How the number of a Tunable is to be read.
enum class TunableType : std::uint8_t {
  number,
  flag,     ///< 0 or 1
  kind,     ///< a ControllerKind or an EstimatorKind
  model,    ///< 0: real poles; else a place in tunable_models, from 1
  pole,     ///< a number; configurations have all three in reference_model.poles_rad_per_s
  element,  ///< a number; configurations have a list of all that differ in the last digit only
};

/// The reference models that have names.
inline constexpr std::array<std::string_view, 3> tunable_models{"design", "eq8", "wm16"};

/// One of a list that a controller or an estimator may have.
struct Tunable {
  /// How to read and set what is common; null: a law or an estimator has it, or none has.
  template <class Settings>
  struct Access {
    double (*get)(const Settings& settings) = nullptr;
    void (*set)(Settings& settings, double value) = nullptr;
  };

  std::string_view name;  ///< as in configurations
  TunableType type;
  double lowest;  ///< allowed, ends included
  double highest;
  Access<ControllerSettings> of_controller{};
  Access<EstimatorSettings> of_estimator{};

  /// NaN: one of this kind has no such value, or its reference model no real poles.
  double get(const ControllerSettings& settings) const;
  /// The same for an estimator.
  double get(const EstimatorSettings& settings) const;
  /// Where get() is not NaN. to: in range.
  void set(ControllerSettings& settings, double to) const;
  /// The same for an estimator.
  void set(EstimatorSettings& settings, double to) const;
  /// A NaN is not, nor half a flag. Which kinds of estimators there are is not looked at.
  bool in_range(double value) const;
  bool controllers_have() const;  ///< those of some kind
  bool estimators_have() const;
  bool is_number() const {
    return type == TunableType::number || type == TunableType::pole || type == TunableType::element;
  }
};

/// The places are those of the protocol (docs/can-protocol.md): new ones come last. In this order
/// they can be set one after the other: what there is depends on the kind and reference_model.
inline constexpr std::size_t tunable_count = 49;
/// All of them, in that order.
const std::array<Tunable, tunable_count>& tunables();
/// tunable_count: there is none of this name.
std::size_t tunable_named(std::string_view name);

}  // namespace supercoil::control
