// Effects of a muscle beyond the linear model.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

namespace supercoil::identification {

enum class Effect : std::uint8_t {
  drift,           ///< the rest length moves with time and with heat
  force,           ///< force per kelvin rises with temperature
  heat_transfer,   ///< heat transfer rises with temperature
  heated_air,      ///< heat transfer differs while it is heated (a heat gun's draught)
  hysteresis,      ///< force lags behind temperature through plays
  creep,           ///< a part of the motion follows slowly
  lonely_stroke,   ///< the first heating moves the rest length permanently
  transformation,  ///< the whole stroke is within a range of temperature: no super-coiled polymer
};

inline constexpr std::size_t effect_count = 8;
/// As in tables, options and JSON.
inline constexpr std::array<std::string_view, effect_count> effect_names{
    "drift",      "force", "heat_transfer", "heated_air",
    "hysteresis", "creep", "lonely_stroke", "transformation"};

/// Which effects a model has.
class Effects {
 public:
  constexpr Effects() = default;
  constexpr Effects(std::initializer_list<Effect> effects) {
    for (const Effect effect : effects)
      *this = with(effect);
  }

  constexpr bool has(Effect effect) const { return (bits_ & bit(effect)) != 0; }
  constexpr bool none() const { return bits_ == 0; }
  constexpr Effects with(Effect effect) const {
    Effects result = *this;
    result.bits_ |= bit(effect);
    return result;
  }

  constexpr Effects without(Effect effect) const {
    Effects result = *this;
    result.bits_ &= ~bit(effect);
    return result;
  }

  friend constexpr bool operator==(const Effects&, const Effects&) = default;

 private:
  static constexpr unsigned bit(Effect effect) { return 1U << static_cast<unsigned>(effect); }

  unsigned bits_ = 0;
};

/// "linear", or "drift + creep".
inline std::string name(const Effects& effects) {
  std::string result;
  for (std::size_t i = 0; i < effect_count; ++i) {
    if (!effects.has(static_cast<Effect>(i))) continue;
    if (!result.empty()) result += " + ";
    result += effect_names[i];
  }
  return result.empty() ? "linear" : result;
}

}  // namespace supercoil::identification
