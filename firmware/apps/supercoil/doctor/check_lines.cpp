#include "apps/supercoil/doctor/call_time.hpp"
#include "apps/supercoil/doctor/check_devices.hpp"
#include "config/describe.hpp"

namespace supercoil::doctor {

namespace {

using hal::Severity;

constexpr const char* rename_line =
    "correct chip and line in the board's file (gpiodetect, gpioinfo), or name the line in the "
    "device tree (gpio-line-names)";
constexpr const char* line_is_slow =
    "use a line of the processor itself, not of an expander behind a bus: lines are the timed cut";

const char* text(hal_linux::Bias bias) {
  switch (bias) {
    case hal_linux::Bias::none:
      return "the chip has no pull";
    case hal_linux::Bias::pull_up:
      return "the chip pulls it up";
    case hal_linux::Bias::pull_down:
      return "the chip pulls it down";
    case hal_linux::Bias::unknown:
      break;
  }
  return "its pull is unknown";
}

void check_output(const config::LineAddress& address, linux_board::OutputPart& part, int priority,
                  const hal::FindingSink& sink) {
  if (!part.device)
    return sink({part.what, Severity::problem, part.device.error().text(), rename_line});
  hal::Status status = hal::Status::ok;
  // The line is already low; only the call is timed.
  const CallTime time = time_calls([&] { status = (*part.device)->set(false); }, priority);
  if (status != hal::Status::ok) {
    return sink({part.what, Severity::problem,
                 config::shown(address) + " cannot be set: " + hal::text(status),
                 "check the kernel log (dmesg) for its chip"});
  }
  sink(assess(part.what, config::shown(address) + ", low", time, line_is_slow));
}

void check_stop(const config::LineAddress& address, linux_board::InputPart& part, int priority,
                const hal::FindingSink& sink) {
  if (!part.device)
    return sink({part.what, Severity::problem, part.device.error().text(), rename_line});
  hal::Level level;
  const CallTime time = time_calls([&] { level = (*part.device)->read(); }, priority);
  const std::string where = config::shown(address);
  if (level.status != hal::Status::ok) {
    sink({part.what, Severity::problem, where + " cannot be read: " + hal::text(level.status),
          "check the kernel log (dmesg) for its chip"});
  } else if (!level.high) {
    sink({part.what, Severity::warning, where + ": open (pressed, or one of its wires is off)",
          "close it: nothing can be armed until then"});
  } else {
    sink(assess(part.what, where + ": closed", time, line_is_slow));
  }
}

/// Duty 0 makes this safe on a board whose resistor is missing.
void check_released(const config::LineAddress& address, const hal_linux::Machine& machine,
                    linux_board::ChannelParts& channel, const hal::FindingSink& sink) {
  linux_board::OutputPart& enable = channel.enable;
  const std::string what = enable.what + " released";
  // A missing device has already been reported.
  if (!enable.device) return;
  if (!channel.pwm.device) {
    return sink({what, Severity::warning, "not checked: its duty may not be 0",
                 "fix " + channel.pwm.what + " first"});
  }
  const hal_linux::LineName name = linux_board::line_name(address);
  enable.device->reset();
  const auto at_rest = hal_linux::read_undriven(name, machine.dev);
  enable.device = hal_linux::GpioOutput::open(name, machine.dev);
  if (at_rest && enable.device) return sink(assess(what, *at_rest));
  const std::string& why = at_rest ? enable.device.error().text() : at_rest.error().text();
  sink({what, Severity::problem, "released for a moment: " + why,
        "stop the other program that uses this line"});
}

}  // namespace

hal::Finding assess(const std::string& what, const hal_linux::UndrivenLine& found) {
  using hal_linux::Bias;
  constexpr const char* fit_resistor =
      "make sure a resistor on the board pulls it down: without one the gate may open when the "
      "firmware dies, and while the board starts";
  const std::string bias_text = std::string("; ") + text(found.bias);
  if (found.level.status != hal::Status::ok) {
    return {
        what, Severity::warning,
        std::string("cannot be read while undriven: ") + hal::text(found.level.status) + bias_text,
        fit_resistor};
  }
  if (found.level.high) {
    return {what, Severity::problem, "high while undriven" + bias_text,
            "fit a resistor that pulls it down more strongly than it is pulled up: the gate opens "
            "when the firmware dies"};
  }
  const std::string low = "low while undriven" + bias_text;
  if (found.bias == Bias::pull_down) return {what, Severity::ok, low, ""};
  return {what, Severity::warning, low, fit_resistor};
}

void check_lines(const config::BoardWiring& wiring, const hal_linux::Machine& machine,
                 linux_board::Parts& parts, int priority, const hal::FindingSink& sink) {
  check_output(wiring.heartbeat, parts.heartbeat, priority, sink);
  check_stop(wiring.stop_circuit, parts.stop_circuit, priority, sink);
  if (parts.light) check_output(*wiring.light, *parts.light, priority, sink);
  for (std::size_t i = 0; i < parts.channels.size(); ++i) {
    check_output(wiring.channels[i].enable, parts.channels[i].enable, priority, sink);
    check_released(wiring.channels[i].enable, machine, parts.channels[i], sink);
  }
}

}  // namespace supercoil::doctor
