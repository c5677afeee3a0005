// The steps by which a muscle on a running board comes to follow.
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

/// What a step found, for people as lines and for programs; the error says what to do.
using StepResult = Result<nlohmann::ordered_json>;

class Commission {
 public:
  /// channel: as in a line of a command. settings: as the board's file has them; index: of this
  /// channel there. All outlive it.
  Commission(BoardLink& board, std::string channel, const BoardSettings& settings,
             std::size_t index, Operator& who);

  /// One of setup_steps that needs a running board, by its name.
  StepResult run(const std::string& step);

  /// The senses of voltage and current, by a meter.
  StepResult compare_senses();
  /// Zero and resistance of the cold muscle; as identify(), of an agonist also the antagonist's, as
  /// "antagonist".
  StepResult calibrate();
  /// The position sensor's scale, by a second known place.
  StepResult scale();
  /// How far it may move, by who watches a slow pull.
  StepResult limits();
  /// The muscle's parameters, beside those that are configured.
  StepResult identify();
  /// The controller in use beside the recommended one, which is taken over if that is wanted.
  StepResult gains();
  /// A sine that the muscle can follow; its error beside the promised one, where one is promised.
  StepResult move();

  /// False where a promise was made and not kept.
  static bool kept(const nlohmann::ordered_json& result);

 private:
  using Done = Operator::Done;
  using OrWhy = Result<std::string>;

  Done ask(const std::string& command);
  /// A fault from before this step is told, and reset where that is wanted.
  Done reset_faults();
  /// Of a mode that ended with this.
  Done only_found(const std::string& mode, const OrWhy& result);
  Done arm();
  /// identify or calibrate, until it ends; how it did.
  OrWhy run_mode(const std::string& mode, double max_s);
  struct Measured {
    std::string channel;  ///< as in a line of a command
    const ChannelSettings& configured;
  };
  using Tell = StepResult (Commission::*)(const Measured& whose);

  /// Which identify and calibrate go on with; empty: this channel is no agonist.
  std::optional<Measured> antagonist() const;
  /// The longest of those that are heated together: all have to be cold.
  double longest_s(const std::function<double(const ChannelSettings&)>& time_s_of) const;
  /// What was found, of an agonist also the antagonist's.
  StepResult tell(Tell found);
  StepResult tell_calibration(const Measured& whose);
  StepResult tell_muscle(const Measured& whose);
  /// calibrate again and again, until the muscle must be cold.
  OrWhy calibrate_when_cold();

  BoardLink& board_;
  std::string channel_;
  const BoardSettings& settings_;
  std::size_t index_;
  const ChannelSettings& configured_;
  Operator& who_;
};

}  // namespace supercoil::operating
