// A person's knowledge of a muscle, in the units of a bench.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "apps/supercoil/setup/operator.hpp"

namespace supercoil::operating {

enum class QuestionId : std::size_t {
  cold_resistance_Ohm,
  load_g,
  stretch_weight_g,
  stretch_mm,
  heated_W,
  heated_mm,
  half_cooling_s,
  thread_g,
  heated_K,
  max_W,
  max_travel_mm,
  uncertainty_percent,
};

inline constexpr std::array<Question, 12> questions{{
    {"cold_resistance_Ohm",
     "Resistance of the cold muscle, by an ohmmeter, in Ohm",
     {0.1, 1e4},
     NAN},
    {"load_g", "Weight that it lifts, including the hook, in g", {0.1, 1e6}, NAN},
    {"stretch_weight_g",
     "Hang a weight on it in addition to the load. How heavy, in g",
     {0.1, 1e6},
     NAN},
    {"stretch_mm", "By how much does that make it longer, in mm", {0.01, 1e4}, NAN},
    {"heated_W", "Heat it with a steady power. How much, in W", {1e-3, 1e3}, NAN},
    {"heated_mm", "By how much does it contract in the end, in mm", {0.01, 1e4}, NAN},
    {"half_cooling_s",
     "Let it cool. After how long is it half way back, in s",
     {0.01, 3600.0},
     NAN},
    {"thread_g", "Weight of the heated thread alone, in g; 0: not known", {0.0, 1e4}, 0.0},
    {"heated_K",
     "How much warmer than the air was it with that power, by a thermometer, in K; 0: not known",
     {0.0, 200.0},
     0.0},
    {"max_W",
     "Maximum power that it may get, in W; no more than the supply can give it",
     {1e-3, 1e3},
     NAN},
    {"max_travel_mm",
     "How far may it contract, in mm; no more than its sensor can read",
     {0.01, 1e4},
     NAN},
    {"uncertainty_percent", "By how much may these answers be wrong, in %", {1.0, 60.0}, 50.0},
}};

/// NaN: not known.
class MuscleAnswers {
 public:
  MuscleAnswers() { values_.fill(NAN); }

  double of(QuestionId question) const { return values_[static_cast<std::size_t>(question)]; }
  void set(std::size_t question, double value) { values_.at(question) = value; }
  bool has(std::size_t question) const { return !std::isnan(values_.at(question)); }

 private:
  std::array<double, questions.size()> values_{};
};

/// Asked by each step that arms a muscle with an earlier fault.
inline constexpr Question reset_fault{
    "reset_fault", "1: its cause is gone, reset the fault; 0: leave it", {0.0, 1.0}, NAN};

/// Asked by the step gains, after the muscle was found.
inline constexpr Question take_gains{
    "take_gains",
    "1: take over the recommended controller, 0: keep the one in use",
    {0.0, 1.0},
    1.0};

}  // namespace supercoil::operating
