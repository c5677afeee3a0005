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
  enum class Kind { design, eq8, wm16, poles };
  static constexpr control::Names<Kind, 4> names{
      {{"design", Kind::design}, {"eq8", Kind::eq8}, {"wm16", Kind::wm16}, {"poles", Kind::poles}}};
  if (!section.has("kind") && !section.has("poles_rad_per_s")) {
    section.text("kind", "");
    section.finish();
    return std::nullopt;
  }
  const Kind kind = section.choice("kind", Kind::poles, names);
  if (kind == Kind::poles) {
    if (!section.has("poles_rad_per_s")) section.wrong("kind", "needs poles_rad_per_s = [a, b, c]");
    const auto poles = section.numbers("poles_rad_per_s", {4.0, 5.0, 0.8}, {1e-3, 1e3}, 3, 3);
    section.finish();
    return control::poles_model({poles[0], poles[1], poles[2]});
  }
  section.finish();
  return control::reference_model_named(control::name_of(names, kind));
}

void refuse_misfit(Section& section, const std::optional<control::Violation>& violation) {
  if (violation) section.wrong(violation->quantity, misfit_text(*violation));
}

}  // namespace supercoil::config
