// Setup of one muscle, from its description to its first motion.
#pragma once

#include <string>

#include "apps/supercoil/setup/commission.hpp"
#include "config/board_config.hpp"
#include "scenario/scenario.hpp"
#include "setup/held_out.hpp"
#include "setup/simulated_link.hpp"
#include "supervisor/fault.hpp"

namespace supercoil::test {

/// Nobody watches, and nothing is asked.
class Nobody final : public operating::Operator {
 public:
  void show(const std::string&) override {}
  void show_progress(const std::string&, double) override {}
  bool sees_progress() const override { return false; }
  bool interrupted() const override { return false; }
  Answer ask(const operating::Question& question, const std::function<Done()>&) override {
    return failure("asked: " + std::string(question.key));
  }
};

/// A board in lockstep whose file comes from the description.
class HeldOutBoard {
 public:
  /// controller: its kind, which has learned_ff's keys. sense_error_ratio: of an earlier comparison
  /// with a meter; 0: there was none. Throws the problem of a wrong test setting.
  HeldOutBoard(const HeldOut& muscle, const std::string& controller, double sense_error_ratio);

  SimulatedLink& link() { return link_; }
  host_sim::Simulation& simulation() { return simulation_; }
  const BoardSettings& settings() const { return *scenario_.board; }
  const ChannelSettings& channel() const { return settings().channels[0]; }
  operating::Commission steps(operating::Operator& user) {
    return {link_, "1", settings(), 0, user};
  }

 private:
  config::BoardConfig config_;
  host_sim::Scenario scenario_;
  host_sim::Simulation simulation_;
  SimulatedLink link_;
};

struct Commissioned {
  std::string refused;         ///< what setup said; empty: it completed
  double promised_m = 0.0;     ///< NaN: nothing was promised
  double probe_m = 0.0;        ///< part of that
  double pwm_m = 0.0;          ///< likewise
  double unexplained_m = 0.0;  ///< likewise
  double error_m = 0.0;
  double standing_still_m = 0.0;  ///< the error of a muscle that stands still
  double calibrated_s = 0.0;      ///< the muscle's time at that moment
  double identified_s = 0.0;      ///< likewise
  double took_s = 0.0;            ///< likewise, at the end
  double hottest_rise_K = 0.0;    ///< the true one
  double above_hot_end_K = 0.0;   ///< how far the muscle was above the board's hot end
  double travel_m = 0.0;          ///< which setup promised it can hold
  Fault fault = Fault::none;
};

/// As HeldOutBoard. Its senses were compared with a meter before, and nobody answers.
Commissioned commission(const HeldOut& muscle, const std::string& controller = "learned_ff");

/// All steps that heat, and gains, on a board that was just started; a script answers.
Commissioned commission_by_script(const HeldOut& muscle);

}  // namespace supercoil::test
