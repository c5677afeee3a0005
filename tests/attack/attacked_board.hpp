// The whole firmware over a simulated board that is attacked.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>

#include "attack/group_attack.hpp"
#include "loop/executive.hpp"
#include "simulated_board/simulated_board.hpp"

namespace supercoil::test {

inline constexpr double hold_ratio = 0.8;   ///< of what max_W would hold
inline constexpr double press_ratio = 1.5;  ///< likewise: more than it can
inline constexpr double rearm_every_s = 12.0;
inline constexpr double rest_every_s = 1.0;

/// Of the worst muscle, by the muscles' true temperatures.
struct Damage {
  double hottest_C = 0.0;
  double outside_K = 0.0;  ///< how far the truth was outside of the published interval
  Fault fault = Fault::none;
  double fault_s = 0.0;  ///< after the attack; when it is there from the start, after arming
};

/// How a run goes, whatever the attack.
struct Course {
  std::string name;
  double duration_s = 60.0;  ///< from the attack on
  bool from_start = false;   ///< the attack is there at boot
  double air_C = 30.0;
  double air_sensor_offset_K = 0.0;
};

/// A derived class says what the attack is and what is commanded meanwhile.
class AttackedBoard {
 public:
  AttackedBoard(const AttackedBoard&) = delete;
  AttackedBoard& operator=(const AttackedBoard&) = delete;
  virtual ~AttackedBoard() = default;

  /// Boots, warms the muscles, attacks, and goes on until the time is over or the board has cut the
  /// heat for good. To be called once.
  Damage run();

 protected:
  using Wiring = std::function<void(board::Devices&)>;

  /// miswire: solders something otherwise than the firmware believes.
  AttackedBoard(
      const Course& course, const BoardSettings& firmware,
      const host_sim::SimulatedBoardSettings& simulated,
      const Wiring& miswire = [](board::Devices&) {});

  virtual void begin_attack() = 0;
  /// Ten times a second: commands expire after 0.25 s.
  virtual void command() = 0;

  /// Changes one muscle, from now on.
  void harm(std::size_t i, const MuscleHarm& harm);
  /// Channel 0 identifies or calibrates, once, and is given a power after that.
  void measure(Verb mode, double then_W);
  bool measure_asked() const { return measure_asked_; }
  /// Disarmed for a moment now and then.
  bool is_rearmed() const { return std::fmod(elapsed_s(), rearm_every_s) >= rearm_every_s - 0.3; }
  /// At rest for a moment, a tenth of a second, now and then.
  bool rests() const { return std::fmod(elapsed_s(), rest_every_s) >= rest_every_s - 0.1; }

  void send(Verb verb, double value = 0.0, std::uint8_t channel = 0) {
    loop_.send({channel, verb, value});
  }
  const Channel& channel(std::size_t i = 0) const { return loop_.channel(i); }
  State state() const { return channel().state().state(); }
  bool attacked() const { return attacked_; }
  /// Since the attack began, or the warming before it.
  double elapsed_s() const { return time_s() - since_s_; }

  const host_sim::SimulatedBoardSettings simulated_;  ///< as it was before the attack
  host_sim::SimulatedBoard board_;

 private:
  double time_s() const { return hal::seconds(board_.true_time()); }
  void tick();
  void run_for(double duration_s);
  void watch();
  bool over() const;

  Course course_;
  bool measure_asked_ = false;
  std::size_t channels_;
  std::uint32_t command_every_;  ///< ticks
  Loop loop_;
  Executive executive_;
  bool attacked_ = false;
  double since_s_ = 0.0;  ///< when the present stretch began
  Damage damage_;
  double faulty_since_s_ = 0.0;
  std::uint32_t ticks_ = 0;
};

inline board::Scaling scaling_of(const host_sim::ConverterSettings& converter) {
  return {converter.per_count(), converter.low};
}

/// Settings from the text of a configuration file; an invalid one ends the program.
BoardSettings settings_of(const std::string& text);

}  // namespace supercoil::test
