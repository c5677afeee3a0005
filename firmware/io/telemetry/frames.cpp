#include "telemetry/frames.hpp"

#include <algorithm>
#include <charconv>

#include "can/codec.hpp"
#include "can/generated/messages.hpp"
#include "modes/result.hpp"
#include "recorder/quantities.hpp"
#include "telemetry/opcodes.hpp"

namespace supercoil::telemetry {

namespace {

namespace message = can::message;

/// The first parameter of Estimate that is multiplexed in rows: the bias.
constexpr std::uint8_t first_aside = 8;
static_assert(can::names_of_parameter[first_aside].name == "bias");

/// Sets every signal that is always present and has the name of one of the row's quantities.
template <const can::MessageInfo& info>
can::Encoder<info> encoder(can::Node node, const Row& row) {
  can::Encoder<info> encoder(node);
  for (const can::SignalInfo& signal : info.signals) {
    if (signal.selected_by != can::always) continue;
    if (const auto* quantity = recorder::find_quantity(signal.name))
      can::put(encoder.frame(), signal, quantity->of(row));
  }
  return encoder;
}

}  // namespace

const std::array<PeriodicMessage, messages>& periodic_messages() {
  static constexpr std::array<PeriodicMessage, messages> all{{
      {"measurement", &message::measurement},
      {"tracking", &message::tracking},
      {"power", &message::power},
      {"heater", &message::heater},
      {"temperature", &message::temperature},
      {"estimate", &message::estimate},
      {"margin", &message::margin},
      {"limit", &message::limit},
      {"timing", &message::timing, true},
      {"status", &message::status},
      {"gain", &message::gain},
      {"joint", &message::joint},
  }};
  return all;
}

hal::CanFrame emergency(can::Node node, const Row& row) {
  return encoder<message::emergency>(node, row)
      .set("board_time_s", 1e-9 * static_cast<double>(row.time_ns))
      .frame();
}

hal::CanFrame first_cause(can::Node node, const Row& row) {
  return can::Encoder<message::first_cause>(node)
      .set("measured", row.margin_measured)
      .set("limit", row.margin_limit)
      .frame();
}

hal::CanFrame refused_value(can::Node node, double value, double nearest) {
  return can::Encoder<message::refused_value>(node)
      .set("value", value)
      .set("nearest", nearest)
      .frame();
}

hal::CanFrame measurement(can::Node node, const Row& row) {
  return encoder<message::measurement>(node, row).frame();
}

hal::CanFrame tracking(can::Node node, const Row& row) {
  const bool tracks = row.mode == static_cast<std::uint8_t>(Mode::position);
  const double model_m = tracks ? row.model_m : NAN;
  return can::Encoder<message::tracking>(node)
      .set("reference_m", tracks ? row.reference : NAN)
      .set("model_m", model_m)
      .set("error_m", row.position_m - model_m)
      .frame();
}

hal::CanFrame power(can::Node node, const Row& row) {
  return encoder<message::power>(node, row).frame();
}

hal::CanFrame heater(can::Node node, const Row& row) {
  return encoder<message::heater>(node, row).frame();
}

hal::CanFrame temperature(can::Node node, const Row& row) {
  return encoder<message::temperature>(node, row).frame();
}

hal::CanFrame margin(can::Node node, const Row& row) {
  return can::Encoder<message::margin>(node)
      .set("fault", row.margin_selector)
      .set("used", row.margin_used)
      .set("measured", row.margin_measured)
      .frame();
}

hal::CanFrame limit(can::Node node, const Row& row) {
  return can::Encoder<message::limit>(node)
      .set("fault", row.margin_selector)
      .set("limit", row.margin_limit)
      .frame();
}

hal::CanFrame gain(can::Node node, const Row& row) {
  return can::Encoder<message::gain>(node)
      .set("gain", row.gain_selector)
      .set("value", row.gain)
      .frame();
}

hal::CanFrame timing(can::Node node, const BoardTiming& timing) {
  constexpr std::uint32_t modulo = 1U << 12;
  return can::Encoder<message::timing>(node)
      .set("late_s", timing.late_s)
      .set("execution_s", timing.execution_s)
      .set("overruns", timing.overruns % modulo)
      .set("dropped_frames", timing.dropped_frames % modulo)
      .frame();
}

hal::CanFrame status(can::Node node, const Row& row, bool leased, std::uint8_t counter) {
  return encoder<message::status>(node, row)
      .set("leased", leased)
      .set("friction", (row.identify_notes & note_friction) != 0)
      .set("counter", counter)
      .set("protocol_version", protocol_version)
      .frame();
}

hal::CanFrame boot(can::Node node, std::string_view version) {
  // 0.2.0+git20261122.150233.2780ebf, or 0.2.0 for a release.
  constexpr std::size_t commit_digits = 7;
  std::array<std::uint32_t, 3> numbers{};
  const char* at = version.data();
  const char* const end = version.data() + version.size();
  for (std::uint32_t& number : numbers) {
    at = std::from_chars(at, end, number).ptr;
    if (at != end) ++at;  // the dot
  }
  const bool released = version.find('+') == std::string_view::npos;
  const std::string_view hash = version.substr(released ? version.size() : version.rfind('.') + 1);
  const std::string_view digits = hash.substr(0, commit_digits);
  std::uint32_t commit = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), commit, 16);
  return can::Encoder<message::boot>(node)
      .set("version_major", numbers[0])
      .set("version_minor", numbers[1])
      .set("version_patch", numbers[2])
      .set("commit", commit)
      .frame();
}

void MultiplexedValues::take(const Row& row) {
  if (row.multiplexed_selector == 0) {
    *this = {};
  } else if (row.multiplexed_selector <= newest_.size()) {
    newest_.at(row.multiplexed_selector - 1U) = row.multiplexed_value;
  }
}

std::uint8_t MultiplexedValues::parameters() const {
  const bool incomplete =
      std::ranges::any_of(newest_, [](float value) { return std::isnan(value); });
  return incomplete ? first_aside : static_cast<std::uint8_t>(first_aside + newest_.size());
}

hal::CanFrame estimate(can::Node node, const Row& row, std::uint8_t parameter,
                       const control::KnownParameters& known,
                       const MultiplexedValues& multiplexed) {
  const control::Theta theta(row.theta[0], row.theta[1], row.theta[2], row.theta[3]);
  const auto muscle = control::physical_from(theta, known);
  const auto of_muscle = [&](double control::PhysicalParameters::*member) {
    return muscle ? (*muscle).*member : NAN;
  };
  // In the order of Estimate.parameter.
  const std::array<double, 14> values{
      row.theta[0],
      row.theta[1],
      row.theta[2],
      row.theta[3],
      of_muscle(&control::PhysicalParameters::thermal_mass_J_per_K),
      of_muscle(&control::PhysicalParameters::heat_transfer_W_per_K),
      of_muscle(&control::PhysicalParameters::stiffness_N_per_m),
      of_muscle(&control::PhysicalParameters::damping_Ns_per_m),
      multiplexed.of(1),
      multiplexed.of(2),
      multiplexed.of(3),
      multiplexed.of(4),
      multiplexed.of(5),
      multiplexed.of(6)};
  auto frame = encoder<message::estimate>(node, row);
  for (const can::SignalInfo& signal : message::estimate.signals) {
    if (signal.selected_by == parameter) can::put(frame.frame(), signal, values.at(parameter));
  }
  // The last note has no bit here; it is in Status.
  return frame.set("parameter", parameter)
      .set("identify_notes", row.identify_notes & static_cast<std::uint8_t>(~note_friction))
      .frame();
}

}  // namespace supercoil::telemetry
