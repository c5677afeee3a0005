#include "apps/supercoil/setup/describe_muscle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string_view>

#include "text/number_text.hpp"

namespace supercoil::operating {

namespace {

using control::PhysicalParameters;

constexpr double gravity_m_per_s2 = 9.81;
/// Nylon 6,6 between 25 and 100 °C, plated with silver, which has less: 1.4 to 1.9.
constexpr double specific_heat_J_per_gK = 1.65;
/// A swing that decays within one period, as with most muscles with a hanging load.
constexpr double typical_damping_ratio = 0.7;

/// Free convection, up to 0.7 of a muscle's cooling, falls with the fourth root of its rise: below
/// an eighth of the rise at which half_cooling_s was taken, it cools slower by this ratio.
constexpr double nearly_cold_ratio = 1.25;

/// Values derived from answers have no more digits than the answers; an answer keeps its own.
constexpr int derived_digits = 4;
constexpr int answer_digits = 9;

/// How far the answers may be wrong, as ratios of the true value to the derived one.
struct Spread {
  double low = 1.0;
  double high = 1.0;

  /// Adds an answer that the value is proportional to.
  void times(double error) {
    low /= 1.0 + error;
    high /= 1.0 - error;
  }
  /// Adds an answer that the value is inversely proportional to.
  void over(double error) {
    low *= 1.0 - error;
    high *= 1.0 + error;
  }
};

struct Heat {
  double mass_J_per_K = 0.0;
  double transfer_W_per_K = 0.0;
  Spread mass;
  Spread transfer;
  double max_time_constant_s = 0.0;
};

Heat heat_of(const MuscleAnswers& a, double error) {
  const double tau_s = a.of(QuestionId::half_cooling_s) / std::numbers::ln2;
  Heat heat;
  heat.max_time_constant_s = nearly_cold_ratio * tau_s / (1.0 - error);
  if (a.of(QuestionId::thread_g) > 0.0) {
    heat.mass_J_per_K = a.of(QuestionId::thread_g) * specific_heat_J_per_gK;
    heat.transfer_W_per_K = heat.mass_J_per_K / tau_s;
    heat.mass.times(error);
    heat.transfer = heat.mass;
    heat.transfer.over(error);
  } else {
    heat.transfer_W_per_K = a.of(QuestionId::heated_W) / a.of(QuestionId::heated_K);
    heat.mass_J_per_K = heat.transfer_W_per_K * tau_s;
    heat.transfer.times(error);
    heat.transfer.over(error);
    heat.mass = heat.transfer;
    heat.mass.times(error);
  }
  return heat;
}

std::string in_K(double rise_K) {
  return number_text(rise_K, 3) + " K";
}

/// Two answers that cannot both be true, even if all are wrong by this error; empty: there are
/// none.
std::string contradiction(const MuscleAnswers& a, const Heat& heat, double error) {
  if (!(a.of(QuestionId::thread_g) > 0.0)) return {};
  const double weighed_K = a.of(QuestionId::heated_W) / heat.transfer_W_per_K;
  const double min_K = weighed_K / (1.0 + error) / heat.transfer.high;
  const double max_K = weighed_K / (1.0 - error) / heat.transfer.low;
  const std::string rise = "by its weight and half_cooling_s the thread is " + in_K(min_K) +
                           " to " + in_K(max_K) + " warmer than the air at heated_W";
  const double read_K = a.of(QuestionId::heated_K);
  const bool agrees = read_K / (1.0 - error) >= min_K && read_K / (1.0 + error) <= max_K;
  if (read_K > 0.0 && !agrees)
    return "thread_g and heated_K contradict each other: " + rise + ", not " + in_K(read_K);
  const double endured_K = questions.at(static_cast<std::size_t>(QuestionId::heated_K)).allowed.max;
  if (min_K > endured_K)
    return "heated_W and thread_g contradict each other: " + rise + ", which no nylon endures";
  return {};
}

/// What this quantity of the muscle follows from.
std::string_view answers_for(std::string_view quantity, bool weighed) {
  if (quantity == "stiffness_N_per_m") return "stretch_weight_g and stretch_mm";
  if (quantity == "moving_mass_kg") return "load_g";
  if (quantity == "damping_Ns_per_m") return "stretch_weight_g, stretch_mm and load_g";
  if (quantity == "force_per_kelvin_N_per_K")
    return "heated_mm, heated_W, stretch_weight_g and stretch_mm";
  return weighed ? "thread_g and half_cooling_s" : "heated_W, heated_K and half_cooling_s";
}

PhysicalParameters muscle_of(const MuscleAnswers& a, const Heat& heat) {
  PhysicalParameters m;
  m.thermal_mass_J_per_K = heat.mass_J_per_K;
  m.heat_transfer_W_per_K = heat.transfer_W_per_K;
  m.stiffness_N_per_m =
      a.of(QuestionId::stretch_weight_g) * gravity_m_per_s2 / a.of(QuestionId::stretch_mm);
  m.moving_mass_kg = 1e-3 * a.of(QuestionId::load_g);
  m.damping_Ns_per_m =
      2.0 * typical_damping_ratio * std::sqrt(m.stiffness_N_per_m * m.moving_mass_kg);
  const double rise_K = a.of(QuestionId::heated_W) / m.heat_transfer_W_per_K;
  m.force_per_kelvin_N_per_K = m.stiffness_N_per_m * 1e-3 * a.of(QuestionId::heated_mm) / rise_K;
  return m;
}

void add_heat(std::vector<Entry>& entries, const MuscleAnswers& a, const Heat& h, double error) {
  const auto add = [&](const char* key, double value, const char* reason) {
    entries.push_back({std::string("thermal.") + key, number_text(value, derived_digits), reason});
  };
  const char* all = "all answers wrong in the same direction";
  add("min_mass_J_per_K", h.mass_J_per_K * h.mass.low, all);
  add("max_mass_J_per_K", h.mass_J_per_K * h.mass.high, all);
  add("min_transfer_W_per_K", h.transfer_W_per_K * h.transfer.low, all);
  add("max_transfer_W_per_K", h.transfer_W_per_K * h.transfer.high, all);
  add("max_time_constant_s", h.max_time_constant_s,
      "half_cooling_s, and a quarter more for a muscle that is nearly cold");
  if (!(a.of(QuestionId::thread_g) > 0.0)) return;
  add("weighed_mass_J_per_K", h.mass_J_per_K, "the thread's weight");
  add("weighed_mass_error_ratio", std::min(0.5, std::max(0.2, error)),
      "of the weight and of nylon's specific heat");
}

}  // namespace

Result<MuscleDescription> describe_muscle(const MuscleAnswers& a, const config::LoopTime& time) {
  if (!(a.of(QuestionId::thread_g) > 0.0) && !(a.of(QuestionId::heated_K) > 0.0)) {
    return failure(
        "thread_g or heated_K must be known: without either, nothing says how hot the muscle gets");
  }
  const double error = 1e-2 * a.of(QuestionId::uncertainty_percent);
  const Heat heat = heat_of(a, error);
  if (std::string text = contradiction(a, heat, error); !text.empty()) return failure(text);
  MuscleDescription d{muscle_of(a, heat), {}};
  if (const auto wrong = control::check(d.muscle)) {
    std::ostringstream message;
    message << answers_for(wrong->quantity, a.of(QuestionId::thread_g) > 0.0)
            << " give a muscle with " << wrong->quantity << " = " << wrong->value << "; it must be "
            << wrong->min << " to " << wrong->max;
    return failure(message.str());
  }
  const auto add = [&](const char* path, double value, const char* reason) {
    d.entries.push_back({path, number_text(value, derived_digits), reason});
  };
  const char* by_heat = a.of(QuestionId::thread_g) > 0.0 ? "thread_g and half_cooling_s"
                                                         : "heated_W, heated_K, half_cooling_s";
  add("muscle.thermal_mass_J_per_K", d.muscle.thermal_mass_J_per_K, by_heat);
  add("muscle.heat_transfer_W_per_K", d.muscle.heat_transfer_W_per_K, by_heat);
  add("muscle.stiffness_N_per_m", d.muscle.stiffness_N_per_m, "stretch_weight_g and stretch_mm");
  add("muscle.damping_Ns_per_m", d.muscle.damping_Ns_per_m, "assumed: a damping ratio of 0.7");
  add("muscle.moving_mass_kg", d.muscle.moving_mass_kg, "load_g");
  add("muscle.force_per_kelvin_N_per_K", d.muscle.force_per_kelvin_N_per_K,
      "heated_mm at heated_W, and the stiffness");
  add_heat(d.entries, a, heat, error);
  const auto keep = [&](const char* path, double value) {
    d.entries.push_back({path, number_text(value, answer_digits), "as answered"});
  };
  keep("heater.cold_resistance_Ohm", a.of(QuestionId::cold_resistance_Ohm));
  keep("limits.max_W", a.of(QuestionId::max_W));
  keep("limits.max_travel_m", 1e-3 * a.of(QuestionId::max_travel_mm));
  const config::RecommendedController controller = config::recommended_controller(d.muscle, time);
  d.entries.push_back({"controller", controller.literal(), controller.reason});
  d.entries.push_back({"reference_model", controller.model_literal(), controller.model_reason});
  return d;
}

}  // namespace supercoil::operating
