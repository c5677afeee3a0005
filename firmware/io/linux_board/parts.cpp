#include "linux_board/parts.hpp"

#include "linux_board/captures.hpp"

namespace supercoil::linux_board {

namespace {

template <class Device>
void note(const Part<Device>& part, std::vector<std::string>& missing) {
  if (!part.device) missing.push_back(part.what + ": " + part.device.error().text());
}

/// Opens devices of one machine.
class Opening {
 public:
  Opening(const config::BoardWiring& wiring, const hal_linux::Machine& machine)
      : machine_(&machine), captures_(wiring, machine) {}

  OutputPart output(std::string what, const config::LineAddress& address) const {
    return {std::move(what), hal_linux::GpioOutput::open(line_name(address), machine_->dev)};
  }
  InputPart input(std::string what, const config::LineAddress& address) const {
    return {std::move(what), hal_linux::GpioInput::open(line_name(address), machine_->dev)};
  }
  PwmPart pwm(std::string what, const config::PwmAddress& a) const {
    return {std::move(what), hal_linux::SysfsPwm::open({a.device, a.number, a.period_ns, a.steps,
                                                        machine_->pwm_chips()})};
  }
  ConverterPart converter(std::string what, const config::ConverterAddress& address) {
    if (address.capture) return {std::move(what), captures_.open(address)};
    return {std::move(what), hal_linux::IioAdc::open(converter_place(address, *machine_))};
  }

 private:
  const hal_linux::Machine* machine_;
  Captures captures_;
};

}  // namespace

std::vector<std::string> Parts::missing() const {
  std::vector<std::string> all;
  note(heartbeat, all);
  for (const ChannelParts& channel : channels)
    note(channel.enable, all);
  for (const ChannelParts& channel : channels)
    note(channel.pwm, all);
  note(stop_circuit, all);
  if (light) note(*light, all);
  note(supply, all);
  if (air) note(*air, all);
  for (const ChannelParts& channel : channels) {
    if (channel.position) note(*channel.position, all);
    note(channel.current, all);
  }
  return all;
}

Parts open_parts(const config::BoardWiring& wiring, const hal_linux::Machine& machine) {
  Opening open(wiring, machine);
  OutputPart heartbeat = open.output("heartbeat", wiring.heartbeat);
  // Opens the enable lines of all channels before the first PWM, and PWMs before converters.
  std::vector<OutputPart> enables;
  std::vector<PwmPart> pwms;
  for (std::size_t i = 0; i < wiring.channels.size(); ++i)
    enables.push_back(open.output(part_name(i, "enable"), wiring.channels[i].enable));
  for (std::size_t i = 0; i < wiring.channels.size(); ++i)
    pwms.push_back(open.pwm(part_name(i, "pwm"), wiring.channels[i].pwm));
  Parts parts{std::move(heartbeat),
              {},
              open.input("stop_circuit", wiring.stop_circuit),
              {},
              open.converter("supply", wiring.supply),
              {}};
  if (wiring.air) parts.air = open.converter("air", *wiring.air);
  if (wiring.light) parts.light = open.output("light", *wiring.light);
  for (std::size_t i = 0; i < wiring.channels.size(); ++i) {
    const config::ChannelWiring& channel = wiring.channels[i];
    std::optional<ConverterPart> position;
    if (!channel.position_of) position = open.converter(part_name(i, "position"), channel.position);
    parts.channels.push_back({std::move(enables[i]), std::move(pwms[i]), std::move(position),
                              open.converter(part_name(i, "current"), channel.current)});
  }
  return parts;
}

std::string part_name(std::size_t index, const std::string& what) {
  return "channel " + std::to_string(index + 1) + ", " + what;
}

hal_linux::LineName line_name(const config::LineAddress& address) {
  return {address.chip, address.line};
}

hal_linux::ConverterLocation converter_place(const config::ConverterAddress& address,
                                             const hal_linux::Machine& machine) {
  return {address.device, address.input, machine.converters()};
}

}  // namespace supercoil::linux_board
