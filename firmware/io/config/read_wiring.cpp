#include "config/read_wiring.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace supercoil::config {

namespace {

/// Driving 4 output registers of a PCA9685 one by one and reading its prescaler.
constexpr int pwm_transactions = 5;
constexpr int pwm_bytes = 3;
/// An ADS1115: its address, the register, the address again, two bytes.
constexpr int converter_transactions = 1;
constexpr int converter_bytes = 5;
/// A converter is read once per tick, and its value may be missing twice.
constexpr double age_ticks = 3.0;
constexpr double min_max_age_s = 0.01;
/// Suffix of the owner's name of a channel's position.
constexpr std::string_view position_of = "'s position";

}  // namespace

void WiringReader::claim(Section& section, const char* key, const std::string& address,
                         const std::string& owner) {
  const auto same = [&](const auto& given) { return given.first == address; };
  const auto first = std::find_if(claims_.begin(), claims_.end(), same);
  if (first == claims_.end()) {
    claims_.emplace_back(address, owner);
  } else {
    const bool one_sensor = first->second.ends_with(position_of) && owner.ends_with(position_of);
    section.wrong(key, "is already " + first->second + ": " + address +
                           (one_sensor ? "; two muscles that turn one joint need a [[joint]], "
                                         "those that pull together a [[bundle]]"
                                       : ""));
  }
}

LineAddress WiringReader::line(Section section, const std::string& owner) {
  LineAddress address;
  address.chip = chip_.empty() || section.has("chip") ? section.required_text("chip")
                                                      : section.text("chip", chip_);
  address.line = section.required_text("line");
  if (section.flag("buffered", false)) {
    section.wrong("buffered",
                  "must be false: lines are direct (20 us or less), because they, not the duty, "
                  "are the timed cut");
  }
  section.finish();
  if (!address.chip.empty() && !address.line.empty()) {
    claim(section, "line", "line " + address.line + " of " + address.chip, owner);
  }
  return address;
}

Access WiringReader::access(Section& section, int transactions, int bytes) {
  Access access;
  access.bus = section.text("bus", "");
  const bool buffered = section.flag("buffered", access.buffered());
  if (access.buffered() && !buffered) {
    section.wrong("buffered", "must be true: devices on a bus are served by its thread");
  }
  if (buffered && !access.buffered()) section.wrong("buffered", "needs bus = \"…\"");
  if (access.buffered()) {
    const auto same = [&](const BusAddress& bus) { return bus.name == access.bus; };
    if (std::none_of(buses_.begin(), buses_.end(), same)) {
      section.wrong("bus", "is not the name of a [[bus]]");
    }
    access.transactions = static_cast<int>(section.integer("transactions", transactions, 1, 1000));
    access.bytes = static_cast<int>(section.integer("bytes", bytes, 1, 4096));
    access.wait_s = 1e-3 * section.number("wait_ms", 0.0, {0.0, 1000.0});
  } else {
    for (const char* key : {"transactions", "bytes", "wait_ms"}) {
      if (section.has(key)) section.wrong(key, "is for buffered devices: needs bus = \"…\"");
    }
    section.allow({"transactions", "bytes", "wait_ms"});
  }
  return access;
}

PwmAddress WiringReader::pwm(Section section, const std::string& owner) {
  PwmAddress address;
  address.device = section.required_text("device");
  address.number = static_cast<int>(section.required_integer("number", 0, 255));
  address.period_ns = section.integer("period_ns", 1000000, 1000, 100000000);
  if (section.has("bits") && section.has("steps")) {
    section.wrong("bits", "and steps set the same value: give only one of them");
  }
  const auto bits = section.optional_integer("bits", 4, 24);
  if (bits) address.steps = (1 << *bits) - 1;
  address.steps = static_cast<int>(section.integer("steps", address.steps, 15, 1 << 24));
  address.access = access(section, pwm_transactions, pwm_bytes);
  section.finish();
  if (!address.device.empty() && section.has("number")) {
    claim(section, "number", "output " + std::to_string(address.number) + " of " + address.device,
          owner);
  }
  return address;
}

std::optional<Capture> WiringReader::capture(Section& section, const ConverterAddress& converter) {
  std::optional<Capture> capture;
  if (section.has("capture")) {
    Section inner = section.section("capture");
    capture.emplace();
    capture->trigger = inner.required_text("trigger");
    capture->length = static_cast<int>(inner.integer("length", capture->length, 2, 65536));
    inner.finish();
    if (converter.access.buffered()) {
      section.wrong("bus", "and capture exclude each other: the kernel reads, not a bus's thread");
    }
  }
  section.allow({"capture"});
  const auto same = [&](const auto& given) { return given.first == converter.device; };
  const auto first = std::find_if(captures_.begin(), captures_.end(), same);
  if (first == captures_.end()) {
    captures_.emplace_back(converter.device, capture);
  } else if (first->second != capture) {
    section.wrong("device",
                  "has another input with another capture: all its inputs are converted together, "
                  "and none can be read separately");
  }
  return capture;
}

ConverterAddress WiringReader::converter(Section& section, const std::string& owner) {
  ConverterAddress address;
  address.device = section.required_text("device");
  address.input = section.required_text("input");
  address.access = access(section, converter_transactions, converter_bytes);
  address.capture = capture(section, address);
  if (!address.device.empty() && !address.input.empty()) {
    claim(section, "input", "input " + address.input + " of " + address.device, owner);
  }
  return address;
}

double WiringReader::max_age_s(Section& section, const ConverterAddress& converter) const {
  const double fallback_s = std::max(min_max_age_s, age_ticks * step_s_);
  const double age_s = 1e-3 * section.number("max_age_ms", 1e3 * fallback_s, {0.1, 1000.0});
  if (converter.access.buffered() && age_s < step_s_) {
    section.wrong("max_age_ms",
                  "must be at least one tick: a buffered value becomes older than that before the "
                  "next one arrives");
  }
  return age_s;
}

}  // namespace supercoil::config
