// What an attack does to a board and its muscle, and what the board is doing meanwhile.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace supercoil::test {

/// Relative to the heat transfer that the board believes: about the min that it was configured
/// with, 0.045 / 0.089.
inline constexpr double worst_configured_cooling = 0.51;

/// Why an interval may miss the truth.
inline constexpr std::string_view worse_cooling =
    "the cooling is worse than `min_transfer_W_per_K` says";
inline constexpr std::string_view leak_as_noise = "10 mA of it pass for the sense's noise";
inline constexpr std::string_view warmer_air = "the air is warmer than `ambient.warmest_C` says";

/// The shortest text of a value.
std::string text_of(double value);
/// For a switch that conducts a part of what it should.
std::string leak_text(double percent);

struct Attack {
  std::string name;
  double current_gain = 1.0;  ///< what a sense reads, over the truth
  double supply_gain = 1.0;
  double cooling_ratio = worst_configured_cooling;
  bool blocked = false;            ///< heat does not move the sensor
  double switch_leak_ratio = 0.0;  ///< of full conduction, while the switch is off
  double air_C = 30.0;             ///< configured are 15 to 30 °C
  /// Error of the board's air sensor; empty: it has none.
  std::optional<double> air_sensor_offset_K;
  bool from_start = false;  ///< not only once the muscle is warm
  /// The board knows this muscle, its senses were compared with a meter, and a muscle that is hot
  /// and still must prove that it answers.
  bool identified = false;
  /// The part of the board that protects if the firmware does not; empty: the limit must be kept.
  std::string_view guard;
  /// Why the published interval may miss the truth; empty: the interval must contain it.
  std::string_view blindness;
};

std::vector<Attack> all_attacks();

/// What is commanded once the attack has begun, or from the start when it is there from the start.
enum class Activity { disarmed, hold, power, ramp, rearm, rests, identify, calibrate };
inline constexpr std::array<std::string_view, 8> activity_names{
    "disarmed", "hold", "power", "ramp", "re-arm", "rests", "identify", "calibrate"};

/// What protects in this activity; empty: the firmware must.
std::string_view guard_in(Activity activity, const Attack& attack);

struct Muscle {
  std::string_view name;
  double stiffness_N_per_m;
  double max_W;
  double min_supply_V;  ///< the range that the board accepts from its 12 V supply
  double max_supply_V;
};
/// The paper's muscle at a supply that may vary widely, which leaves its sense more room to lie;
/// and a stiff one that may be given more power than it can stand indefinitely.
inline constexpr std::array<Muscle, 2> muscles{
    {{"soft", 16.0, 4.5, 7.5, 16.5}, {"stiff", 64.0, 11.0, 10.8, 13.2}}};

}  // namespace supercoil::test
