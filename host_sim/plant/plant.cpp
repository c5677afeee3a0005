#include "plant/plant.hpp"

namespace supercoil::host_sim {

namespace {

using EitherPlant = std::variant<LinearPlant, NonlinearPlant>;

EitherPlant make(const control::PhysicalParameters& parameters, const PlantEffects& effects,
                 double step_s) {
  if (effects.any()) return NonlinearPlant(parameters, effects, step_s);
  return LinearPlant(parameters, step_s);
}

}  // namespace

Plant::Plant(const control::PhysicalParameters& parameters, const PlantEffects& effects,
             double step_s)
    : step_s_(step_s), plant_(make(parameters, effects, step_s)) {}

void Plant::set(const control::PhysicalParameters& parameters, const PlantEffects& effects) {
  if (auto* nonlinear = std::get_if<NonlinearPlant>(&plant_)) {
    nonlinear->set(parameters, effects);
  } else if (!effects.any()) {
    std::get_if<LinearPlant>(&plant_)->set_parameters(parameters);
  } else {
    const NonlinearPlant::State state{
        temperature_rise_K(), peak_temperature_rise_K(), {position_m(), velocity_m_per_s()}};
    NonlinearPlant next(parameters, effects, step_s_);
    next.start_from(state);
    plant_ = next;
  }
}

const control::PhysicalParameters& Plant::parameters() const {
  return std::visit(
      [](const auto& plant) -> const auto& { return plant.parameters(); }, plant_);
}
double Plant::temperature_rise_K() const {
  return std::visit([](const auto& plant) { return plant.temperature_rise_K(); }, plant_);
}
double Plant::position_m() const {
  return std::visit([](const auto& plant) { return plant.position_m(); }, plant_);
}
double Plant::velocity_m_per_s() const {
  return std::visit([](const auto& plant) { return plant.velocity_m_per_s(); }, plant_);
}
double Plant::peak_temperature_rise_K() const {
  return std::visit([](const auto& plant) { return plant.peak_temperature_rise_K(); }, plant_);
}

}  // namespace supercoil::host_sim
