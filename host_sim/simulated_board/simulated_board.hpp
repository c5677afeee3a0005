// A whole board with its muscles, on any PC.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "board/devices.hpp"
#include "simulated_board/muscle_channel.hpp"
#include "simulated_board/simulated_bundle.hpp"
#include "simulated_board/simulated_joint.hpp"

namespace supercoil::host_sim {

struct SimulatedBoardSettings {
  double rate_Hz = 1000.0;  ///< of the firmware; the board itself takes `substeps` steps a tick
  int substeps = 1;
  double supply_V = 12.0;
  ConverterSettings supply{0.0, 30.0, 0, 0.0};
  std::optional<ConverterSettings> air;  ///< in °C; absent: no sensor
  double charge_pump_decay_s = 0.02;
  std::uint64_t seed = 1;
  std::vector<MuscleChannelSettings> channels{1};
  std::vector<SimulatedJointSettings> joints;
  std::vector<std::vector<std::size_t>> bundles;  ///< channels; none is in two of either
};

/// The board is its own clock: waiting lets the muscles move on, and nothing else takes time unless
/// a caller asks for it. The firmware may stop at any point; the board can go on without it.
class SimulatedBoard final : public hal::Clock {
 public:
  explicit SimulatedBoard(const SimulatedBoardSettings& settings);

  hal::Time now() const override { return now_ + lost_; }
  hal::Time wait_until(hal::Time wake) override;

  /// The devices for the firmware's loop. The board must outlive it.
  board::Devices devices();

  /// Lets time pass without the firmware.
  void advance_to(hal::Time time);

  /// The next wake-up comes this much late.
  void oversleep(double late_s) { late_ = hal::duration_from(late_s); }
  /// The next tick takes this much time, as now() shows it.
  void lose_in_tick(double time_s) { to_lose_ = hal::duration_from(time_s); }

  MuscleChannel& channel(std::size_t i) { return *channels_[i]; }
  const MuscleChannel& channel(std::size_t i) const { return *channels_[i]; }
  std::size_t joints() const { return joints_.size(); }
  SimulatedJoint& joint(std::size_t i) { return *joints_[i]; }
  const SimulatedJoint& joint(std::size_t i) const { return *joints_[i]; }
  SimulatedBundle& bundle(std::size_t i) { return *bundles_[i]; }
  void set_air_C(double air_C) { air_C_ = air_C; }
  void set_supply_V(double supply_V) { supply_V_ = supply_V; }
  bool supply_closed() const { return closed_; }
  hal::Time true_time() const { return now_; }

  SimulatedConverter supply;
  std::optional<SimulatedConverter> air;  ///< absent: no sensor
  SimulatedOutput heartbeat;
  SimulatedOutput light;
  SimulatedInput stop_circuit;
  SimulatedWatchdog watchdog;
  ChargePump pump;

 private:
  void step();

  hal::Duration step_;
  double supply_V_;
  double air_C_ = 25.0;
  hal::Time now_{};
  hal::Duration to_lose_{};
  hal::Duration lost_{};  ///< in this tick; the muscles see it pass before the next
  hal::Duration late_{};
  bool closed_ = false;
  std::vector<std::unique_ptr<MuscleChannel>> channels_;
  std::vector<std::unique_ptr<SimulatedJoint>> joints_;
  std::vector<std::unique_ptr<SimulatedBundle>> bundles_;
  std::vector<std::vector<std::size_t>> bundled_;  ///< channels of each bundle
};

}  // namespace supercoil::host_sim
