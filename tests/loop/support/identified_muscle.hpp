// The mode identify on muscles that differ from what the board believes.
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
  double sine_rad_per_s;  ///< a sine that it can follow, between these:
  double sine_bottom_m = 0.002;
  double sine_top_m = 0.020;
};

/// Those of docs/muscles.md, and some that differ from the paper's in one thing.
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
  double ended_s = 0.0;               ///< time in the scenario
  double took_s = 0.0;                ///< since the command
  double hottest_C = 0.0;             ///< the true temperature
  double hottest_published_C = 0.0;   ///< the hot end of the board's interval
  double max_m = 0.0;
  double min_m = 0.0;  ///< at most 0: how far below its start it came, once it had moved
  /// What it did, sampled at 100 Hz.
  std::vector<double> position_m;
  std::vector<double> power_W;
};

/// Whether the board's bounds of heat are around its belief, wrong as that is, or around the truth.
enum class Heat { believed, known };

/// Every physical parameter of the belief is the muscle's times a random factor of 0.5 to 1.5, and
/// identify begins at a random time.
Identified run_identify(const MuscleKind& kind, int seed, Heat heat = Heat::believed);

/// Like run_identify() with Heat::known, which leaves enough power for a full stroke; learned_ff
/// then follows a sine. Returns the true tracking error in the fourth to sixth period, rms in m;
/// NaN when the muscle was not found.
double tracking_after(const MuscleKind& kind, int seed);

}  // namespace supercoil::test
