// What a muscle's supplier says of it, in place of what a bench would show.
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
    {"rated_W", "Rated power, which it bears for good, in W", {1e-3, 1e3}, NAN},
    {"rated_Ohm", "Rated resistance, in Ohm", {0.1, 1e4}, NAN},
    {"length_mm", "Length to which its stroke refers, in mm", {1.0, 1e4}, NAN},
    {"stroke_percent", "Stroke with the rated power, in % of that length", {0.1, 60.0}, NAN},
    {"stroke_load_g", "Load at which it has that stroke, in g", {0.1, 1e6}, NAN},
    {"max_C", "The hottest that it may become, in °C; 0: not told", {0.0, 180.0}, 0.0},
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

  /// What it says of a question of describe; NaN: nothing. The rated power is believed to heat the
  /// muscle to the hottest that it may become: whoever believes it hotter than it is heats it less.
  double suggested(Asked what) const;
  /// The limits of its temperature, where they are lower than trip_C, which it is now.
  std::vector<Entry> limits(double trip_C) const;

 private:
  std::array<double, nameplate_questions.size()> values_{};
};

/// The least that a temperature may be limited to: below, no muscle moves.
inline constexpr double min_rated_C = 50.0;

/// At which a channel, from 1, trips by its file; 0: near skin, far below any that is rated.
double trip_in_file_C(const std::string& text, int channel);

}  // namespace supercoil::operating
