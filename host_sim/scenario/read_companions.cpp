// [bundle]: muscles that pull in parallel, each with its own heater.
#include <array>

#include "scenario/read_tables.hpp"

namespace supercoil::host_sim {

namespace {

using config::Diagnostics;
using config::Section;

/// Keys of [plant] for what all of them carry together.
constexpr std::array of_the_bundle{"moving_mass_kg", "hanging_mass_kg", "load_N",
                                   "friction_ratio", "end_stop_m",      "ceiling_m"};

std::string path_of(std::size_t number) {
  return "bundle." + std::to_string(number);
}

std::size_t read_number(Section& section) {
  return static_cast<std::size_t>(
      section.integer("muscles", 2, 2, static_cast<std::int64_t>(max_muscles)));
}

}  // namespace

std::vector<PlantSettings> read_companions(const toml::table& document, Diagnostics& diagnostics) {
  std::vector<PlantSettings> companions;
  if (!document.contains("bundle")) return companions;
  Section root(&document, "", diagnostics);
  Section section = root.section("bundle");
  if (document.contains("joint"))
    section.wrong("muscles", "cannot be used with a [joint]: a bundle cannot be part of a joint");
  const std::size_t muscles = read_number(section);
  for (std::size_t number = 2; number <= muscles; ++number) {
    Section own = section.section(std::to_string(number));
    for (const char* key : of_the_bundle) {
      if (own.has(key)) own.wrong(key, "applies to the whole bundle: set it in [plant]");
    }
    Diagnostics found(diagnostics.file(), diagnostics.keys());
    companions.push_back(read_plant(overlaid(document, path_of(number), "plant", found)));
    add_new(found, diagnostics);
  }
  section.finish();
  return companions;
}

control::PhysicalParameters bundle_parameters(const toml::table& document,
                                              control::PhysicalParameters first) {
  Diagnostics elsewhere("");  // reported when it is read again, elsewhere
  Section section(document["bundle"].as_table(), "bundle", elsewhere);
  if (section.table() == nullptr) return first;
  const std::size_t muscles = read_number(section);
  for (std::size_t number = 2; number <= muscles; ++number) {
    Section own = overlaid(document, path_of(number), "plant", elsewhere);
    const control::PhysicalParameters other = read_plant_parameters(own);
    first.stiffness_N_per_m += other.stiffness_N_per_m;
    first.damping_Ns_per_m += other.damping_Ns_per_m;
    first.force_per_kelvin_N_per_K += other.force_per_kelvin_N_per_K;
  }
  return first;
}

}  // namespace supercoil::host_sim
