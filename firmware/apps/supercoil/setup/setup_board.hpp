// The running board that setup leads to, by the file that it was started with.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "apps/supercoil/board_link.hpp"
#include "apps/supercoil/setup/commission.hpp"
#include "apps/supercoil/setup/operator.hpp"
#include "apps/supercoil/setup/options.hpp"
#include "apps/supercoil/setup/record.hpp"
#include "config/board_config.hpp"

namespace supercoil::operating {

class SetupBoard {
 public:
  /// Both outlive it.
  SetupBoard(const SetupOptions& options, Operator& who) : options_(options), who_(who) {}
  SetupBoard(const SetupBoard&) = delete;
  SetupBoard& operator=(const SetupBoard&) = delete;
  /// However it ends, the muscle gets no power.
  ~SetupBoard();

  /// A step of setup_steps, all but the first. The board is looked for when it is first needed.
  StepResult run(const std::string& step);
  /// Compares what calibrate and identify found with what the board goes by now; the record
  /// discounts what is another muscle's, and somebody is told. Without any of both the board is
  /// not looked for.
  Result<void> compare_with(SetupRecord& record);
  /// Why a step of setup_steps is not done with this channel; empty: it is.
  std::string left_out(const std::string& step);

 private:
  Result<void> read();
  /// What was read before stays where the file is in no order now.
  Result<void> read_again();
  /// Refuses a board that runs with another file.
  Result<void> open();
  /// The board with the file, as commands to copy.
  std::string how_to_start() const;
  std::size_t index() const { return static_cast<std::size_t>(options_.channel) - 1; }
  /// Of the file's first channel: on a bus channels are nodes.
  int first_address() const;
  std::string address() const;

  const SetupOptions& options_;
  Operator& who_;
  std::optional<config::BoardConfig> config_;
  std::unique_ptr<BoardLink> link_;
};

}  // namespace supercoil::operating
