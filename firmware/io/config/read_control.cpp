#include "config/read_control.hpp"

#include "loop/settings.hpp"

namespace supercoil::config {

control::PhysicalParameters read_parameters(Section& section,
                                            const control::PhysicalParameters& fallback) {
  control::PhysicalParameters p;
  for (const control::PhysicalRange& range : control::physical_ranges) {
    p.*range.member = section.number(range.name, fallback.*range.member, {range.min, range.max});
  }
  return p;
}

std::optional<control::ReferenceModelSettings> read_reference_model(Section section) {
  const std::string_view fallback = section.has("poles_rad_per_s") ? "poles" : "";
  const std::string kind = section.one_of("kind", fallback, {"design", "eq8", "wm16", "poles"});
  if (kind != "poles") {
    section.finish();
    return control::reference_model_named(kind);
  }
  const auto poles = section.required_numbers("poles_rad_per_s", {1e-3, 1e3}, 3, 3);
  section.finish();
  if (poles.empty()) return std::nullopt;  // reported
  return control::poles_model({poles[0], poles[1], poles[2]});
}

void refuse_misfit(Section& section, const std::optional<control::Violation>& violation) {
  if (violation) section.wrong(violation->quantity, misfit_text(*violation));
}

}  // namespace supercoil::config
