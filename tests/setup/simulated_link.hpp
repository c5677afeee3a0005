// A simulated board, in lockstep, as setup commands it.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "apps/supercoil/board_link.hpp"
#include "runner/simulation.hpp"
#include "text/command_text.hpp"

namespace supercoil::test {

/// Its time advances while it is asked or waited for, and at no other moment.
class SimulatedLink : public operating::BoardLink {
 public:
  SimulatedLink(host_sim::Simulation& simulation, double rate_Hz)
      : simulation_(simulation), rate_Hz_(rate_Hz) {}

  Answer ask(const std::string& line) override {
    const auto command = parse_command(line, simulation_.loop().channels());
    if (!command) return "wrong: " + command.error().text();
    const supercoil::Answer answer =
        simulation_.command(command->verb, command->value, command->channel);
    watch();
    return answer_text(answer.refusal, answer.nearest);
  }
  Answer state() override { return std::string(); }
  Answer state_json() override { return std::string(); }
  Result<Status> status(const std::string& channel) override {
    const Snapshot& s = at(channel).snapshot();
    return Status{std::string(name(s.state)),
                  std::string(s.fault == Fault::none ? "none" : name(s.fault)), s.probing};
  }
  Result<Ending> ending(const std::string& channel) override {
    const Snapshot& s = at(channel).snapshot();
    return Ending{std::string(mode_result_names.at(static_cast<std::size_t>(s.result))),
                  describe_notes(s.identify_notes, ",")};
  }
  Result<board::SenseComparison> senses(const std::string& channel) override {
    return at(channel).senses();
  }
  Result<KnownMuscle> muscle(const std::string& channel) override {
    KnownMuscle known;
    for (std::size_t i = 0; i < known.size(); ++i)
      known[i] = at(channel).known(i);
    return known;
  }
  Result<double> tuning(const std::string& channel, int place, std::size_t tunable,
                        TuningSet set) override {
    return at(channel).tuner().value(set, static_cast<std::size_t>(place), tunable);
  }
  Answer prepare(const std::string& channel, int place, const std::string& name,
                 const std::string& value) override {
    Tuner& tuner = at(channel).tuner();
    const auto at = static_cast<std::size_t>(place);
    if (name == "all") {
      const auto set = std::ranges::find(tuning_set_names, value) - tuning_set_names.begin();
      return tuner.prepare_from(static_cast<TuningSet>(set), at) ? "ok" : "refused: out_of_range";
    }
    const Reply reply = tuner.prepare(at, control::tunable_named(name), std::stod(value));
    return answer_text(reply.refusal, reply.nearest);
  }
  Result<double> progress(const std::string& channel) override {
    return static_cast<double>(at(channel).snapshot().progress);
  }
  Result<double> position_m(const std::string& channel) override {
    return static_cast<double>(at(channel).snapshot().position_m);
  }
  Result<double> error_m(const std::string& channel) override {
    const Snapshot& s = at(channel).snapshot();
    return s.mode == Mode::position ? s.position_m - s.model_m : NAN;
  }
  void wait(std::chrono::milliseconds time) override {
    const double until_s = time_s() + 1e-3 * static_cast<double>(time.count());
    while (time_s() < until_s) {
      const host_sim::TickRecord now = simulation_.step();
      above_hot_end_K_ = std::max(above_hot_end_K_, now.temperature_rise_K - now.hottest_K);
      metered_W_ += (now.applied_power_W - metered_W_) / (meter_s * rate_Hz_);
      watch();
    }
  }
  double time_s() const override { return static_cast<double>(simulation_.tick()) / rate_Hz_; }

  double hottest_rise_K() const { return hottest_rise_K_; }
  /// How far the muscle was above the board's hot end while it was waited for.
  double above_hot_end_K() const { return above_hot_end_K_; }
  /// What the muscle truly gets, as a meter shows it.
  double metered_W() const { return metered_W_; }
  Fault fault() const { return simulation_.loop().channel(0).snapshot().fault; }

 private:
  static constexpr double meter_s = 0.1;  ///< over which a meter averages

  /// channel: its number, as in a line.
  Channel& at(const std::string& channel) {
    return simulation_.loop().channel(std::stoul(channel) - 1);
  }
  void watch() {
    hottest_rise_K_ = std::max(hottest_rise_K_, simulation_.plant().temperature_rise_K());
  }

  host_sim::Simulation& simulation_;
  double rate_Hz_;
  double hottest_rise_K_ = 0.0;
  double above_hot_end_K_ = 0.0;
  double metered_W_ = 0.0;
};

}  // namespace supercoil::test
