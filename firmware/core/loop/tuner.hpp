// How the controllers of a channel are tuned while the board runs.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "supercoil/control/tracking/tunable.hpp"

#include "loop/command.hpp"
#include "loop/settings.hpp"

namespace supercoil {

/// Which values of a controller: the numbers are those of the protocol.
enum class TuningSet : std::uint8_t {
  prepared = 0,    ///< changed one by one; used from the next `tune` on
  in_use = 1,      ///< by the loop
  configured = 2,  ///< by the board's file
  stored = 3,      ///< used from the next start on
};
inline constexpr std::array<std::string_view, 4> tuning_set_names{"prepared", "in_use",
                                                                  "configured", "stored"};

/// Of the thread that sends commands, which builds what the loop's thread then exchanges: a tick
/// allocates nothing. No step of it waits.
class Tuner {
 public:
  Tuner(const ChannelSettings& channel, double step_s);

  /// NaN: no such place, parameter (of control::tunables()) or set, or a law without this value.
  double value(TuningSet set, std::size_t place, std::size_t parameter) const;
  /// Changes one value of the prepared set.
  Reply prepare(std::size_t place, std::size_t parameter, double value);
  /// The prepared set becomes another. False: there is no such place or set.
  bool prepare_from(TuningSet set, std::size_t place);

  /// Gives `tune` and `store` what the loop needs for them. muscle: as known now.
  void add_to(Command& command, const control::PhysicalParameters& muscle);
  /// The loop has answered: what it took is in use or stored.
  void conclude(const Answer& answer);
  /// Why the set that `tune` wanted last cannot be used; empty: it can.
  const std::string& problem() const { return problem_; }

 private:
  struct Built {
    std::size_t place;
    control::ControllerSettings settings;
    control::Controller controller;
  };
  struct Place {
    control::ControllerSettings configured;
    control::ControllerSettings in_use;
    control::ControllerSettings prepared;
  };
  const control::ControllerSettings* settings_of(TuningSet set, std::size_t place) const;
  control::ControllerSettings stored(std::size_t place) const;
  board::StoredTuning tuning_in_use() const;

  ChannelSettings channel_;
  double step_s_;
  std::vector<Place> places_;
  std::vector<std::unique_ptr<Built>> built_;  ///< that the loop has not answered yet
  board::StoredTuning stored_;
  board::StoredTuning to_store_;
  bool storing_ = false;  ///< the loop may be reading to_store_
  std::string problem_;
};

}  // namespace supercoil
