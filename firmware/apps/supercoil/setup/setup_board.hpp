// The running board that setup works on, with the file that it was started with.
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
  SetupBoard(const SetupOptions& options, Operator& user) : options_(options), user_(user) {}
  SetupBoard(const SetupBoard&) = delete;
  SetupBoard& operator=(const SetupBoard&) = delete;
  /// The muscle gets no power, however this ends.
  ~SetupBoard();

  /// Runs a step of setup_steps, all but the first. Connects to the board when it is first needed.
  StepResult run(const std::string& step);
  /// Compares what calibrate and identify found with what the board uses now. The record discounts
  /// what belongs to another muscle, and the operator is told. If neither step is recorded, the
  /// board is not contacted.
  Result<void> compare_with(SetupRecord& record);
  /// Why a step of setup_steps is not done with this channel; empty: it may be done.
  std::string left_out(const std::string& step);

 private:
  Result<void> read();
  /// Keeps what was read before if the file is not valid now.
  Result<void> read_again();
  /// Refuses a board that runs with another file.
  Result<void> open();
  /// How to start the board with the file, as commands to copy.
  std::string how_to_start() const;
  std::size_t index() const { return static_cast<std::size_t>(options_.channel) - 1; }
  /// Address of the file's first channel: on a bus channels are nodes.
  int first_address() const;
  std::string address() const;

  const SetupOptions& options_;
  Operator& user_;
  std::optional<config::BoardConfig> config_;
  std::unique_ptr<BoardLink> link_;
};

}  // namespace supercoil::operating
