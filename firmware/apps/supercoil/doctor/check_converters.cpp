#include "supercoil/hal_linux/monotonic_clock.hpp"

#include "apps/supercoil/doctor/call_time.hpp"
#include "apps/supercoil/doctor/check_devices.hpp"
#include "apps/supercoil/doctor/readings.hpp"
#include "config/describe.hpp"

namespace supercoil::doctor {

namespace {

using hal::Severity;
using linux_board::ConverterPart;

constexpr int rounds = 50;

/// One converter, and its expected readings.
struct Candidate {
  ConverterPart* part;
  const config::ConverterAddress* address;
  Expected expected;
  Readings readings;
};

Expected supply_of(const BoardSettings& settings) {
  const BoardSupervision& s = settings.supervision;
  return {.quantity = "the supply",
          .scaling = settings.supply.scaling,
          .min = s.min_supply_V,
          .max = s.max_supply_V,
          .unit = "V",
          .shown_per_unit = 1.0,
          .must_move = false,
          .remedy = "switch it on; if it is on, correct the divider, V_per_count and offset_V"};
}

Expected air_of(const BoardSettings& settings) {
  const board::AirSettings& air = settings.channels.front().thermal.air;
  return {.quantity = "the air's sensor",
          .scaling = settings.air.scaling,
          .min = air.coldest_C - air.error_K,
          .max = air.warmest_C + air.error_K,
          .unit = "°C",
          .shown_per_unit = 1.0,
          .must_move = false,
          .remedy =
              "compare it with a thermometer, and correct C_per_count and offset_C; or the "
              "bounds in [ambient]"};
}

Expected position_of(const ChannelSettings& settings) {
  const ChannelSupervision& s = settings.supervision;
  return {.quantity = "the position's sensor",
          .scaling = settings.position.scaling,
          .min = s.min_position_m,
          .max = s.max_position_m,
          .unit = "mm",
          .shown_per_unit = 1e3,
          .must_move = s.position_noise_rms_m > 0.0,
          .remedy = "check its wires; if they are in order, correct m_per_count and offset_m"};
}

Expected current_of(const ChannelSettings& settings) {
  const double off_A = settings.supervision.off_current_A;
  return {.quantity = "the current's sense",
          .scaling = settings.heater.current.scaling,
          .min = -off_A,
          .max = off_A,
          .unit = "mA",
          .shown_per_unit = 1e3,
          .must_move = false,
          .remedy =
              "nothing is driven: check for a power switch that is stuck on; if there is none, "
              "correct A_per_count and offset_A"};
}

std::vector<Candidate> candidates(const config::BoardConfig& config, linux_board::Parts& parts) {
  std::vector<Candidate> all;
  all.push_back({&parts.supply, &config.wiring.supply, supply_of(config.settings), {}});
  if (parts.air) all.push_back({&*parts.air, &*config.wiring.air, air_of(config.settings), {}});
  for (std::size_t i = 0; i < parts.channels.size(); ++i) {
    const config::ChannelWiring& wiring = config.wiring.channels[i];
    const ChannelSettings& settings = config.settings.channels[i];
    linux_board::ChannelParts& channel = parts.channels[i];
    if (channel.position)
      all.push_back({&*channel.position, &wiring.position, position_of(settings), {}});
    all.push_back({&channel.current, &wiring.current, current_of(settings), {}});
  }
  return all;
}

/// Reads in the order and at the pace of a loop's ticks, so that a slow converter has a new value.
void read(std::vector<Candidate>& all, double tick_s) {
  hal_linux::MonotonicClock clock;
  const hal::Duration tick = hal::duration_from(tick_s);
  hal::Time next = clock.now();
  for (int round = 0; round < rounds; ++round) {
    next = std::max(clock.now(), next + tick);
    clock.wait_until(next);
    for (Candidate& candidate : all) {
      if (!candidate.part->device) continue;
      const hal::Time before = clock.now();
      const hal::Sample sample = (*candidate.part->device)->latest();
      candidate.readings.add(sample, clock.now() - before);
    }
  }
}

void judge(Candidate& candidate, const hal_linux::Machine& machine, int priority,
           const hal::FindingSink& sink) {
  ConverterPart& part = *candidate.part;
  if (!part.device) {
    return sink({part.what, Severity::problem, part.device.error().text(),
                 "load the converter's driver, or correct device and input (ls "
                 "/sys/bus/iio/devices)"});
  }
  const hal::Finding finding =
      assess(part.what, config::shown(*candidate.address), candidate.readings, candidate.expected,
             hal_linux::count_range(linux_board::converter_place(*candidate.address, machine)));
  if (candidate.address->access.buffered() || finding.severity == Severity::problem) {
    return sink(finding);
  }
  const CallTime time = time_calls([&] { static_cast<void>((*part.device)->latest()); }, priority);
  const hal::Finding direct =
      assess(part.what, finding.found, time, "make it buffered: bus = \"…\" in its table");
  sink(direct.severity == Severity::ok
           ? hal::Finding{part.what, finding.severity, direct.found, finding.remedy}
           : direct);
}

}  // namespace

void check_converters(const config::BoardConfig& config, const hal_linux::Machine& machine,
                      linux_board::Parts& parts, int priority, const hal::FindingSink& sink,
                      std::vector<BusShare>& shares) {
  std::vector<Candidate> all = candidates(config, parts);
  read(all, config.settings.step_s());
  for (Candidate& candidate : all) {
    judge(candidate, machine, priority, sink);
    const config::Access& access = candidate.address->access;
    if (!access.buffered()) continue;
    const bool known = candidate.part->device.has_value() && candidate.readings.good() > 0;
    shares.push_back(
        {access.bus, known ? std::optional(candidate.readings.mean_time()) : std::nullopt});
  }
}

}  // namespace supercoil::doctor
