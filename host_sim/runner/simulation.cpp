#include "runner/simulation.hpp"

namespace supercoil::host_sim {

Simulation::Simulation(const Scenario& scenario)
    : scenario_(&scenario),
      conditions_(&scenario.start),
      ticks_(scenario.ticks()),
      step_s_(scenario.step_s()),
      plant_(conditions_->plant.parameters, step_s_, scenario.substeps),
      sensor_(conditions_->position_sensor, scenario.seed),
      output_(conditions_->power, step_s_),
      controller_(conditions_->controller, step_s_),
      estimator_(conditions_->estimator, step_s_) {}

void Simulation::happen(const Event& event) {
  conditions_ = &event.conditions;
  plant_.set_parameters(conditions_->plant.parameters);
  sensor_.set(conditions_->position_sensor);
  output_.set(conditions_->power);
  if (event.new_controller) controller_ = control::Controller(conditions_->controller, step_s_);
  if (event.new_estimator) estimator_ = control::Estimator(conditions_->estimator, step_s_);
}

TickRecord Simulation::step() {
  TickRecord record;
  record.time_s = static_cast<double>(tick_) * step_s_;
  while (next_event_ < scenario_->events.size() &&
         scenario_->events[next_event_].at_s <= record.time_s) {
    happen(scenario_->events[next_event_++]);
  }
  record.position_m = plant_.position_m();
  record.temperature_rise_K = plant_.temperature_rise_K();
  record.measured_m = sensor_.measure(record.position_m);
  estimator_.step(record.measured_m, output_.applied_W());

  record.reference = conditions_->reference.at(record.time_s);
  control::ControllerInput input;
  input.reference_m = record.reference;
  input.reference_power_W = record.reference;
  input.position_m = record.measured_m;
  input.applied_power_W = output_.applied_W();
  input.limited = output_.limited();
  const control::ControllerOutput wanted = controller_.step(input);
  record.model_m = wanted.model_m;
  record.open_loop = conditions_->controller.kind == control::ControllerKind::power;
  record.power_W = wanted.wanted_power_W;

  output_.want(wanted.wanted_power_W);
  record.applied_power_W = output_.applied_W();
  record.limited = output_.limited();
  plant_.step(output_.true_W(), conditions_->plant.load_N);
  ++tick_;
  return record;
}

}  // namespace supercoil::host_sim
