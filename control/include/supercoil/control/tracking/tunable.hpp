// Single values of a controller, by name: as its configuration has them, and as they are changed on
// a running board.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "supercoil/control/tracking/controller_settings.hpp"

namespace supercoil::control {

enum class TunableType : std::uint8_t {
  number,
  flag,   ///< 0 or 1
  kind,   ///< a ControllerKind
  model,  ///< 0: real poles; else a place in tunable_models, from 1
  pole,   ///< a number; configurations have all three in reference_model.poles_rad_per_s
};

/// The reference models that have names.
inline constexpr std::array<std::string_view, 3> tunable_models{"design", "eq8", "wm16"};

struct Tunable {
  std::string_view name;  ///< as in configurations
  TunableType type;
  double lowest;  ///< allowed, ends included
  double highest;
  /// Of a value that is the controller's; null: its law has it, or has not.
  double (*of_controller)(const ControllerSettings& settings) = nullptr;
  void (*set_controller)(ControllerSettings& settings, double value) = nullptr;

  /// NaN: a law of this kind has no such value, or its reference model no real poles.
  double get(const ControllerSettings& settings) const;
  /// Where get() is not NaN. to: in range.
  void set(ControllerSettings& settings, double to) const;
  bool in_range(double value) const;  ///< a NaN is not, nor half a flag
};

/// The places are those of the protocol (docs/can-protocol.md): new ones come last. In this order
/// they can be set one after the other: what there is depends on kind and reference_model.
inline constexpr std::size_t tunable_count = 23;
const std::array<Tunable, tunable_count>& tunables();
/// tunable_count: there is none of this name.
std::size_t tunable_named(std::string_view name);

}  // namespace supercoil::control
