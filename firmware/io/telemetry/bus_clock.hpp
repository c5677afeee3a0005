// The clock of a bus's master, as its Sync messages give it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "supercoil/hal/clock.hpp"

namespace supercoil::telemetry {

/// Of the latest Sync messages: when they arrived, by the board's clock, and when they were sent,
/// by the master's.
class BusClock {
 public:
  /// A Sync message, with both clocks' times of it.
  struct Sync {
    std::uint8_t number;
    double master_s;
    hal::Time received;
  };

  /// Replaces the Sync whose number is 8 less.
  void add(const Sync& sync) { known_[sync.number % known_.size()] = sync; }
  /// The Sync of this number among the latest 8, if it came at `earliest` or later. An older one of
  /// the same number is another program's: numbers wrap around, and each program begins anywhere.
  std::optional<Sync> find(std::uint8_t number, hal::Time earliest) const {
    const std::optional<Sync>& found = known_[number % known_.size()];
    const bool wanted = found && found->number == number && found->received >= earliest;
    return wanted ? found : std::nullopt;
  }

 private:
  std::array<std::optional<Sync>, 8> known_{};
};

}  // namespace supercoil::telemetry
