#include "unit/control/support/reference.hpp"

#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace supercoil::test {

nlohmann::json reference(const std::string& topic, const std::string& entry) {
  const char* folder = std::getenv("SUPERCOIL_REFERENCE");
  if (folder == nullptr) throw std::runtime_error("SUPERCOIL_REFERENCE is not set: run with ctest");
  std::ifstream file(std::string(folder) + "/" + topic + ".json");
  if (!file) throw std::runtime_error("no " + topic + ".json in " + folder);
  return nlohmann::json::parse(file).at(entry);
}

control::PhysicalParameters parameters_from(const nlohmann::json& json) {
  return {json.at("thermal_mass_J_per_K"), json.at("heat_transfer_W_per_K"),
          json.at("stiffness_N_per_m"),    json.at("damping_Ns_per_m"),
          json.at("moving_mass_kg"),       json.at("force_per_kelvin_N_per_K")};
}

}  // namespace supercoil::test
