// Tuning of a channel's controllers and estimators while the board runs.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "supercoil/control/tracking/tunable.hpp"

#include "loop/command.hpp"
#include "loop/settings.hpp"

namespace supercoil {

/// A set of values of a controller or estimator; the numbers are those of the protocol.
enum class TuningSet : std::uint8_t {
  prepared = 0,    ///< changed one by one; used from the next `tune` on
  in_use = 1,      ///< by the loop
  configured = 2,  ///< in the board's file
  stored = 3,      ///< used from the next start on
};
inline constexpr std::array<std::string_view, 4> tuning_set_names{"prepared", "in_use",
                                                                  "configured", "stored"};

/// For the thread that sends commands. Builds what the loop's thread then exchanges, so that a tick
/// allocates nothing. Never waits.
class Tuner {
 public:
  Tuner(const ChannelSettings& channel, double step_s);

  /// NaN: no such place, parameter (of control::tunables()) or set, or a kind without this value.
  double value(TuningSet set, std::size_t place, std::size_t parameter) const;
  /// Changes one value of the prepared set.
  Reply prepare(std::size_t place, std::size_t parameter, double value);
  /// Replaces the prepared set by another. False: no such place or set.
  bool prepare_from(TuningSet set, std::size_t place);

  /// Adds to `tune` and `store` what the loop needs. muscle: as known now.
  void add_to(Command& command, const control::PhysicalParameters& muscle);
  /// Takes the loop's answer: what it accepted is now in use or stored.
  void conclude(const Answer& answer);
  /// Why the set of the last `tune` cannot be used; empty: it can.
  const std::string& problem() const { return problem_; }

 private:
  template <class Settings>
  struct Place {
    Settings configured;
    Settings in_use;
    Settings prepared;

    static std::vector<Place> all_of(const std::vector<Settings>& in_use,
                                     const std::vector<Settings>& configured, std::size_t at_most);
    Settings of(TuningSet set, const board::StoredValues& stored) const;
  };
  template <class Settings, class Running>
  struct Built {
    std::size_t place;
    Settings settings;
    Running running;
  };
  template <class Settings, class Running>
  using AllBuilt = std::vector<std::unique_ptr<Built<Settings, Running>>>;

  /// Calls function(Place, its StoredValues); false: no such place.
  template <class Self, class Function>
  static bool at(Self& self, std::size_t place, Function function);
  void build(std::size_t place, Command& command);
  template <class Settings>
  bool passes_check(const Settings& wanted);
  template <class Settings, class Running>
  static void conclude(AllBuilt<Settings, Running>& built, std::vector<Place<Settings>>& places,
                       const Running* tuned, bool taken);
  board::StoredTuning tuning_in_use() const;

  ChannelSettings channel_;
  double step_s_;
  board::StoredTuning stored_;
  std::vector<Place<control::ControllerSettings>> controllers_;
  std::vector<Place<control::EstimatorSettings>> estimators_;
  // Not yet answered by the loop.
  AllBuilt<control::ControllerSettings, control::Controller> built_controllers_;
  AllBuilt<control::EstimatorSettings, control::Estimator> built_estimators_;
  board::StoredTuning to_store_;
  bool storing_ = false;  ///< the loop may be reading to_store_
  std::string problem_;
};

}  // namespace supercoil
