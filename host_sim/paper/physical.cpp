#include <array>
#include <cmath>
#include <cstdint>

#include "paper/reproduction.hpp"
#include "runner/simulation.hpp"
#include "runner/summary.hpp"
#include "scenario/read_scenario.hpp"

namespace supercoil::host_sim::paper {

namespace {

struct Contender {
  const char* id;
  const char* label;
  control::ControllerKind kind;
  const char* preset;
  double scale;
};

constexpr std::array<Contender, 4> contenders{{
    {"pi", "PI", control::ControllerKind::pi, "", 1.0},
    {"pdff", "PDff", control::ControllerKind::pd_ff, "", 1.0},
    {"mrac_printed_x10", "MRAC, printed x 10", control::ControllerKind::mrac, "printed", 10.0},
    {"mrac_a", "MRAC, preset a", control::ControllerKind::mrac, "a", 1.0},
}};

struct Named {
  const char* id;
  const char* quantity;
  Window window;
};

constexpr std::array<Named, 3> windows{{
    {"before", "tracking error, rms, 60-100 s", {60.0, 100.0}},
    {"first_10s", "tracking error, rms, 100-110 s", {100.0, 110.0}},
    {"after", "tracking error, rms, 160-200 s", {160.0, 200.0}},
}};

void use(control::ControllerSettings& settings, const Contender& contender) {
  settings.kind = contender.kind;
  settings.model = contender.kind == control::ControllerKind::mrac ? control::wm16_model()
                                                                   : control::design_model();
  if (contender.kind == control::ControllerKind::mrac) {
    settings.mrac = control::mrac_preset(contender.preset)->scaled(contender.scale);
  }
}

/// The true error in the three windows, and curves for the figure.
std::array<ErrorMeter, 3> track(Scenario scenario, const Contender& contender, Panel& position,
                                Panel& error, int colour) {
  use(scenario.start.controller, contender);
  for (Event& event : scenario.events)
    use(event.conditions.controller, contender);
  Simulation simulation(scenario);
  std::array<ErrorMeter, 3> meters;
  Curve at{contender.label, {}, {}, false, colour};
  Curve off = at;
  while (!simulation.done()) {
    const std::int64_t tick = simulation.tick();
    const TickRecord& r = simulation.step();
    for (std::size_t i = 0; i < windows.size(); ++i) {
      const Window& w = windows[i].window;
      if (r.time_s >= w.from_s && r.time_s < w.to_s) meters[i].add(r.position_m - r.model_m);
    }
    if (tick % 100 == 0 && r.time_s >= 60.0) {
      at.x.push_back(r.time_s);
      at.y.push_back(r.position_m * 1e3);
      off.x.push_back(r.time_s);
      off.y.push_back((r.position_m - r.model_m) * 1e6);
    }
  }
  position.curves.push_back(at);
  error.curves.push_back(off);
  return meters;
}

void add_reference(Panel& panel, const Scenario& scenario) {
  Curve curve{"reference", {}, {}, true, 6};
  const std::int64_t last = std::llround(scenario.duration_s * 10.0);
  for (std::int64_t tenth = 600; tenth < last; ++tenth) {
    const double t = static_cast<double>(tenth) * 0.1;
    curve.x.push_back(t);
    curve.y.push_back(scenario.start.reference.at(t) * 1e3);
  }
  panel.curves.push_back(curve);
}

void add_scenario(Part& part, Figure& figure, const char* name, double error_limit_um) {
  const Scenario scenario = read_scenario(name).value();
  Panel position{std::string(name) + ": position", "time (s)", "mm", {}};
  Panel error{std::string(name) + ": error against each controller's own reference model",
              "time (s)",
              "µm",
              {},
              -error_limit_um,
              error_limit_um};
  add_reference(position, scenario);
  int colour = 1;
  for (const Contender& contender : contenders) {
    const auto meters = track(scenario, contender, position, error, colour++ % 4);
    for (std::size_t i = 0; i < windows.size(); ++i) {
      part.rows.push_back({std::string("physical.") + name + "." + contender.id, windows[i].id,
                           windows[i].quantity, "µm", "", shown(meters[i].rms() * 1e6), ""});
    }
  }
  figure.panels.push_back(position);
  figure.panels.push_back(error);
}

}  // namespace

Part run_physical() {
  Part part;
  part.title = "The same on a muscle of true size";
  part.introduction =
      "0 to 27 mm, 0 to 4.5 W, 1 kHz, 10 µm of sensor noise, 16 bits over 40 mm. The stiffness "
      "falls "
      "from 16 to 12 N/m at 100 s. Errors are of the true position against each controller's own "
      "reference model.";
  Figure figure;
  figure.width_px = 1000;
  figure.panel_height_px = 280;
  add_scenario(part, figure, "sine", 1000.0);
  add_scenario(part, figure, "steps", 2000.0);
  part.figures.push_back({"physical", "PI, PDff and MRAC on the physical muscle",
                          "From 60 s on, when all have settled; the change is at 100 s.", figure});
  return part;
}

Part compare_arithmetic() {
  Part part;
  part.title = "Fixed point";
  part.introduction =
      "The sine scenario with controller and estimator in q8.24 against the same in double: the "
      "difference of the true positions over the 200 s, and of the estimator's predictions.";
  Scenario in_double = read_scenario("fixed-point").value();
  const Scenario in_fixed = in_double;
  in_double.start.controller.arithmetic = control::Arithmetic::float64;
  in_double.start.estimator.arithmetic = control::Arithmetic::float64;
  Simulation first(in_double);
  Simulation second(in_fixed);
  ErrorMeter position;
  ErrorMeter prediction;
  // ε is in watts through 1/Λ, whose gain at rest is 1/10.
  const double metres_per_error = 10.0 * in_double.start.controller.dc_gain_m_per_W;
  while (!first.done()) {
    position.add(first.step().position_m - second.step().position_m);
    prediction.add((first.estimate()->prediction_error_W - second.estimate()->prediction_error_W) *
                   metres_per_error);
  }
  part.rows.push_back({"arithmetic.q8_24.mrac", "preset a", "position against double, rms", "µm",
                       "", shown(position.rms() * 1e6), ""});
  part.rows.push_back({"arithmetic.q8_24.gradient", "printed", "prediction against double, rms",
                       "µm", "", shown(prediction.rms() * 1e6), "as position at rest"});
  return part;
}

}  // namespace supercoil::host_sim::paper
