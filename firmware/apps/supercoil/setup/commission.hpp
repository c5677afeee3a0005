// The steps that commission a muscle on a running board.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "supercoil/hal/error.hpp"

#include "apps/supercoil/board_link.hpp"
#include "apps/supercoil/setup/operator.hpp"
#include "loop/settings.hpp"

namespace supercoil::operating {

/// What a step found, for programs; people get it as lines of the Operator. The error says why the
/// step failed.
using StepResult = Result<nlohmann::ordered_json>;

class Commission {
 public:
  /// channel: as in a line of a command. settings: from the board's file; index: of this channel
  /// there. All outlive it.
  Commission(BoardLink& board, std::string channel, const BoardSettings& settings,
             std::size_t index, Operator& user);

  /// One of setup_steps that needs a running board, by its name.
  StepResult run(const std::string& step);

  /// The senses of voltage and current, compared with a meter.
  StepResult compare_senses();
  /// Zero and resistance of the cold muscle. For an agonist, as in identify(), also the
  /// antagonist's, as "antagonist".
  StepResult calibrate();
  /// The position sensor's scale, from a second known position.
  StepResult scale();
  /// The travel limit, by a person who watches a slow pull.
  StepResult limits();
  /// The muscle's parameters, compared with the configured ones.
  StepResult identify();
  /// The controller in use compared with the recommended one, which is taken over if wanted.
  StepResult gains();
  /// Tracks a sine that the muscle can follow; compares its error with the promised one, if any.
  StepResult move();

  /// False if a promise was made and not kept.
  static bool kept(const nlohmann::ordered_json& result);

 private:
  using Done = Operator::Done;
  using ResultText = Result<std::string>;

  Done ask(const std::string& command);
  /// Reports a fault from before this step, and resets it if wanted.
  Done reset_faults();
  /// Succeeds only if the mode ended with "found".
  Done require_found(const std::string& mode, const ResultText& result);
  Done arm();
  /// Runs identify or calibrate until it ends; returns how it ended.
  ResultText run_mode(const std::string& mode, double max_s);
  struct MeasuredMuscle {
    std::string channel;  ///< as in a line of a command
    const ChannelSettings& configured;
  };
  using Report = StepResult (Commission::*)(const MeasuredMuscle& muscle);

  /// The muscle that identify and calibrate continue with; empty: this channel is not an agonist.
  std::optional<MeasuredMuscle> antagonist() const;
  /// The longest time of the muscles that are heated together: all have to be cold.
  double max_time_s(const std::function<double(const ChannelSettings&)>& time_of) const;
  /// Reports what was found; for an agonist also for the antagonist.
  StepResult report_each(Report report);
  StepResult report_calibration(const MeasuredMuscle& muscle);
  StepResult report_muscle(const MeasuredMuscle& muscle);
  /// Repeats calibrate until the muscle must be cold.
  ResultText calibrate_when_cold();

  BoardLink& board_;
  std::string channel_;
  const BoardSettings& settings_;
  std::size_t index_;
  const ChannelSettings& configured_;
  Operator& user_;
};

}  // namespace supercoil::operating
