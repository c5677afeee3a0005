// The mode identify on muscles that are not as the board believes.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runner/simulation.hpp"

namespace supercoil::test {

/// A muscle on a board with 1 kHz, 16 bits of PWM, 10 µm of position noise and 16 bits over 40 mm.
struct MuscleKind {
  std::string_view name;
  std::string_view plant;  ///< keys of [plant]
  double max_W;
  double sine_rad_per_s;  ///< that it can follow, between these:
  double sine_bottom_m = 0.002;
  double sine_top_m = 0.020;
};

/// Those of docs/muscles.md, and such that differ from the paper's in one thing.
inline constexpr std::array<MuscleKind, 11> muscle_kinds{{
    {"paper", "preset = 'paper'", 4.5, 0.25},
    {"real", "preset = 'real'", 4.5, 0.25},
    {"real_hard", "preset = 'real_hard'", 4.5, 0.25},
    {"b", "preset = 'b'", 2.15, 0.25, 0.001, 0.0025},
    {"c", "preset = 'c'", 3.1, 0.03},
    {"slow, 20 s", "thermal_mass_J_per_K = 1.78", 4.5, 0.03},
    {"slow, 60 s", "thermal_mass_J_per_K = 5.34", 4.5, 0.01},
    {"stiff", "stiffness_N_per_m = 80.0", 4.5, 0.25, 0.001, 0.004},
    {"small", "thermal_mass_J_per_K = 0.015\nheat_transfer_W_per_K = 0.00824", 0.5, 0.25},
    {"strong",
     "thermal_mass_J_per_K = 1.2\nheat_transfer_W_per_K = 0.25\nstiffness_N_per_m = 60.0\n"
     "moving_mass_kg = 0.5\ndamping_Ns_per_m = 5.0\nforce_per_kelvin_N_per_K = 0.02",
     20.0, 0.1, 0.002, 0.010},
    {"lightly damped", "damping_Ns_per_m = 0.12", 4.5, 0.25},
}};

struct Identified {
  ModeResult result = ModeResult::none;
  std::uint8_t notes = 0;
  Fault fault = Fault::none;
  std::optional<board::Learned> learned;
  control::PhysicalParameters truth;  ///< of the cold muscle, without its effects
  double ended_s = 0.0;               ///< in the scenario,
  double took_s = 0.0;                ///< after it was asked for
  double hottest_C = 0.0;             ///< truly
  double hottest_told_C = 0.0;        ///< the hot end of the board's interval
  double max_m = 0.0;
  double min_m = 0.0;  ///< at most 0: how far below where it began, once it had moved
  /// What it did, 100 times a second.
  std::vector<double> position_m;
  std::vector<double> power_W;
};

/// The board's bounds of heat: about its belief, as wrong as that is, or about the truth.
enum class Heat { believed, known };

/// Every physical parameter of the belief is the muscle's times a random factor of 0.5 to 1.5, and
/// it is asked for at a random time.
Identified run_identify(const MuscleKind& kind, int seed, Heat heat = Heat::believed);

/// As run_identify() with known heat, which leaves the power for a full stroke; then learned_ff
/// follows a sine. The true tracking error in the fourth to sixth period, rms in m. NaN when the
/// muscle was not found.
double tracking_after(const MuscleKind& kind, int seed);

}  // namespace supercoil::test
