#include <array>
#include <cstdio>

#include "apps/supercoil/identify/findings.hpp"

namespace supercoil::operating {

namespace {

void add_line(std::string& text, const char* key, double value, const char* comment) {
  std::array<char, 200> line{};
  std::snprintf(line.data(), line.size(), "%s = %.6g%s%s\n", key, value, *comment ? "  # " : "",
                comment);
  text += line.data();
}

bool reported_of(const identification::Fit& fit, double identification::Muscle::*member) {
  for (std::size_t i = 0; i < fit.parameters.size(); ++i)
    if (fit.parameters[i].member == member) return is_determined(fit, i);
  return false;
}

}  // namespace

Result<std::string> muscle_table(const Findings& f) {
  using identification::Muscle;
  const auto p = identification::physical_from(f.linear.muscle, f.assumed);
  if (const auto wrong = control::check(p)) {
    std::array<char, 300> text{};
    std::snprintf(text.data(), text.size(),
                  "%s would be %.4g, which is not between %.4g and %.4g: this is not a thread "
                  "muscle, or --thermal-mass, --stiffness or --moving-mass must be changed",
                  wrong->quantity, wrong->value, wrong->min, wrong->max);
    return failure(std::string(text.data()));
  }
  const bool by_mass = f.assumed.moving_mass_kg.has_value();
  const bool frequency = reported_of(f.linear, &Muscle::natural_frequency_rad_per_s);
  const bool damping = reported_of(f.linear, &Muscle::damping_ratio);
  const char* unseen = "not determined by the recording: too fast, or too little motion";
  std::string text = "# " + f.file + ", " + name(f.linear.effects) + ", the whole recording\n";
  text += "[muscle]\n";
  add_line(text, "thermal_mass_J_per_K", p.thermal_mass_J_per_K,
           f.thermal_mass_assumed ? "assumed: weigh the muscle, and give --thermal-mass"
                                  : "from --thermal-mass");
  add_line(text, "heat_transfer_W_per_K", p.heat_transfer_W_per_K, "follows from it");
  const char* follows = frequency ? "" : unseen;
  add_line(text, "stiffness_N_per_m", p.stiffness_N_per_m,
           by_mass               ? follows
           : f.stiffness_assumed ? "assumed: give --stiffness or --moving-mass"
                                 : "from --stiffness");
  add_line(text, "damping_Ns_per_m", p.damping_Ns_per_m, damping ? "" : unseen);
  add_line(text, "moving_mass_kg", p.moving_mass_kg, by_mass ? "from --moving-mass" : follows);
  add_line(text, "force_per_kelvin_N_per_K", p.force_per_kelvin_N_per_K, "follows from both");
  return text;
}

}  // namespace supercoil::operating
