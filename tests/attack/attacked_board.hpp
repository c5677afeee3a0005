// The whole firmware, as a configuration's file starts it, over a board that is attacked.
#pragma once

#include <algorithm>

#include "attack/attack.hpp"
#include "loop/executive.hpp"
#include "simulated_board/simulated_board.hpp"

namespace supercoil::test {

/// Judged by the plant's own temperature.
struct Damage {
  double hottest_C = 0.0;
  double outside_K = 0.0;  ///< how far the truth was outside of the published interval
  Fault fault = Fault::none;
  double fault_s = 0.0;  ///< after the attack; of one that is there from the start, after arming
};

class AttackedBoard {
 public:
  AttackedBoard(Attack attack, const Muscle& muscle, Activity activity);
  AttackedBoard(const AttackedBoard&) = delete;
  AttackedBoard& operator=(const AttackedBoard&) = delete;

  Damage run();

 private:
  double time_s() const { return hal::seconds(board_.true_time()); }
  State state() const { return loop_.channel(0).state().state(); }
  void begin_attack();
  void tick();
  /// Until the time is over, or the board has cut the heat for good.
  void run_for(double duration_s);
  void command();
  void command_active();
  void send(Verb verb, double value = 0.0) { loop_.send({0, verb, value}); }
  void watch();
  bool over() const;

  Attack attack_;
  Muscle muscle_;
  Activity activity_;
  bool attacked_ = false;
  double since_s_ = 0.0;  ///< when the present stretch began
  bool mode_asked_ = false;
  BoardSettings firmware_;
  host_sim::SimulatedBoardSettings simulated_;
  host_sim::SimulatedBoard board_;
  Loop loop_;
  Executive executive_;
  Damage damage_;
  double faulty_since_s_ = 0.0;
  std::uint32_t ticks_ = 0;
};

}  // namespace supercoil::test
