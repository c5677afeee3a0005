// The tables of a scenario that describe control: reference, model, controller, estimator.
#pragma once

#include "config/section.hpp"
#include "scenario/scenario.hpp"

namespace supercoil::host_sim {

Reference read_reference(config::Section& section);
/// Empty when the table is absent: the controller's own default is then taken.
std::optional<control::ReferenceModelSettings> read_reference_model(config::Section section);
control::ControllerSettings read_controller(
    config::Section& section, const control::PhysicalParameters& muscle,
    const std::optional<control::ReferenceModelSettings>& model);
control::EstimatorSettings read_estimator(config::Section& section,
                                          const control::PhysicalParameters& muscle);

}  // namespace supercoil::host_sim
