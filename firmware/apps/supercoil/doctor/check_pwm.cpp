#include "apps/supercoil/doctor/call_time.hpp"
#include "apps/supercoil/doctor/check_devices.hpp"

namespace supercoil::doctor {

namespace {

using hal::Severity;

void check(const config::PwmAddress& address, linux_board::PwmPart& part, int priority,
           const hal::FindingSink& sink, std::vector<BusShare>& shares) {
  const config::Access& access = address.access;
  std::optional<hal::Duration> write;
  const auto share = [&] {
    if (access.buffered()) shares.push_back({access.bus, write});
  };
  if (!part.device) {
    sink({part.what, Severity::problem, part.device.error().text(),
          "load the chip's driver, or correct pwm.device, pwm.number and pwm.period_ns (ls "
          "/sys/class/pwm)"});
    return share();
  }
  hal::Status status = hal::Status::ok;
  CallTime time = time_calls([&] { status = (*part.device)->pulse_enable(); }, priority);
  // Each call is two writes.
  time.mean /= 2;
  time.p99 /= 2;
  time.worst /= 2;
  const std::string where = "output " + std::to_string(address.number) + " of " + address.device;
  if (status != hal::Status::ok) {
    sink({part.what, Severity::problem, where + " cannot be written: " + hal::text(status),
          "check the kernel log (dmesg) for its driver and bus"});
    return share();
  }
  write = time.mean;
  const std::string found = where + " took its period of " + std::to_string(address.period_ns) +
                            " ns, not inversed, duty 0";
  if (access.buffered()) {
    sink({part.what, Severity::ok, found + "; on " + access.bus + ", " + time_text(time), ""});
  } else {
    sink(assess(part.what, found, time, "make it buffered: bus = \"…\" in its table"));
  }
  share();
}

}  // namespace

void check_pwms(const config::BoardWiring& wiring, linux_board::Parts& parts, int priority,
                const hal::FindingSink& sink, std::vector<BusShare>& shares) {
  for (std::size_t i = 0; i < parts.channels.size(); ++i)
    check(wiring.channels[i].pwm, parts.channels[i].pwm, priority, sink, shares);
}

}  // namespace supercoil::doctor
