// A supplier's data on a muscle, instead of measurements on a bench.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "apps/supercoil/setup/describe_muscle.hpp"
#include "apps/supercoil/setup/muscle_answers.hpp"

namespace supercoil::operating {

enum class Rated : std::size_t { power_W, Ohm, length_mm, stroke_percent, stroke_load_g, max_C };

inline constexpr std::array<Question, 6> nameplate_questions{{
    {"rated_W", "Rated continuous power, in W", {1e-3, 1e3}, NAN},
    {"rated_Ohm", "Rated resistance, in Ohm", {0.1, 1e4}, NAN},
    {"length_mm", "Length to which its stroke refers, in mm", {1.0, 1e4}, NAN},
    {"stroke_percent", "Stroke at the rated power, in % of that length", {0.1, 60.0}, NAN},
    {"stroke_load_g", "Load at which it has that stroke, in g", {0.1, 1e6}, NAN},
    {"max_C", "Maximum temperature, in °C; 0: not given", {0.0, 180.0}, 0.0},
}};
/// Whether there is one; asked first.
inline constexpr Question has_nameplate{
    "nameplate", "1: you have its supplier's data, 0: you measure it yourself", {0.0, 1.0}, 0.0};

class Nameplate {
 public:
  Nameplate() { values_.fill(NAN); }

  double of(Rated what) const { return values_[static_cast<std::size_t>(what)]; }
  void set(std::size_t question, double value) { values_.at(question) = value; }
  bool present() const { return !std::isnan(values_.front()); }
  /// "max_C = 40: must be …"; empty: its values are possible.
  std::string objection() const;

  /// Its answer to a question of describe; NaN: none. The rated power is assumed to heat the muscle
  /// to its max temperature: a muscle that is believed hotter than it is gets less heat.
  double suggested(QuestionId question) const;
  /// Limits of the muscle's temperature, if they are below trip_C, the present limit.
  std::vector<Entry> limits(double trip_C) const;

 private:
  std::array<double, nameplate_questions.size()> values_{};
};

/// Min temperature limit: below it no muscle moves.
inline constexpr double min_rated_C = 50.0;

/// The trip temperature of a channel, from 1, in its file; 0: near skin, far below any rated one.
double trip_in_file_C(const std::string& text, int channel);

}  // namespace supercoil::operating
