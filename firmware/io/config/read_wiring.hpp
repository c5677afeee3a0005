// Reads addresses, each from its own table, and refuses duplicates.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "config/section.hpp"
#include "config/wiring.hpp"

namespace supercoil::config {

/// Reads addresses and remembers the owner of each.
class WiringReader {
 public:
  WiringReader(std::vector<BusAddress> buses, std::string chip, double step_s)
      : buses_(std::move(buses)), chip_(std::move(chip)), step_s_(step_s) {}

  /// {line, chip}. owner: its name in messages. Finishes the section.
  LineAddress line(Section section, const std::string& owner);
  /// {device, number, period_ns, steps or bits, …}. Finishes the section.
  PwmAddress pwm(Section section, const std::string& owner);
  /// {device, input, …} of a table with more keys: the caller finishes it.
  ConverterAddress converter(Section& section, const std::string& owner);
  /// max_age_ms of a converter, in s.
  double max_age_s(Section& section, const ConverterAddress& converter) const;

 private:
  Access access(Section& section, int transactions, int bytes);
  /// Converters that the kernel reads; notes inputs of one device that are read in different ways.
  std::optional<Capture> capture(Section& section, const ConverterAddress& converter);
  /// Notes at the key that the address already has an owner.
  void claim(Section& section, const char* key, const std::string& address,
             const std::string& owner);

  std::vector<BusAddress> buses_;
  std::string chip_;
  double step_s_;
  std::vector<std::pair<std::string, std::string>> claims_;
  std::vector<std::pair<std::string, std::optional<Capture>>> captures_;  ///< by device
};

/// Reads [[bus]]; notes duplicate names.
std::vector<BusAddress> read_buses(std::vector<Section> sections);

/// Notes each bus that would be busy for more than max_bus_load of a tick.
void refuse_slow_buses(std::vector<Section> sections, const BoardWiring& wiring, double step_s);

}  // namespace supercoil::config
