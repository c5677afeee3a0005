#include "apps/supercoil/setup/setup_board.hpp"

#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

#include "apps/supercoil/setup/board_file.hpp"
#include "apps/supercoil/setup/channel_steps.hpp"
#include "apps/supercoil/setup/file_joint.hpp"
#include "apps/supercoil/setup/file_steps.hpp"
#include "apps/supercoil/setup/other_muscle.hpp"
#include "apps/supercoil/setup/running_file.hpp"
#include "apps/supercoil/setup/steps.hpp"

namespace supercoil::operating {

SetupBoard::~SetupBoard() {
  if (link_) static_cast<void>(link_->ask(address() + " disarm"));
}

StepResult SetupBoard::run(const std::string& step) {
  // An earlier step may have changed the file.
  if (auto again = read_again(); !again) return tl::unexpected(again.error());
  if (const std::string why = left_out(step); !why.empty()) return failure(why);
  if (step == "doctor") {
    if (auto done = read(); !done) return tl::unexpected(done.error());
    return doctor_step(options_, *config_, user_);
  }
  if (auto ready = open(); !ready) return tl::unexpected(ready.error());
  Commission commission(*link_, address(), config_->settings, index(), user_);
  auto found = commission.run(step);
  if (!found || !found->contains(travel_key)) return found;
  const auto text = read_board_text(options_.config);
  if (!text) return tl::unexpected(text.error());
  const auto literal = (*found)[travel_key].get<std::string>();
  found->erase(travel_key);
  const auto entry = travel_entry(*text, options_.channel, std::stod(literal), literal, step);
  if (!entry) {
    user_.show("the joint's range_deg already allows it no more than that: the file stays");
    return found;
  }
  const auto written = write_entries(options_, step, *text, {*entry});
  if (!written) return tl::unexpected(written.error());
  if (entry->joint) user_.show(entry->key() + " = " + entry->literal);
  (*found)[entry->key()] = entry->literal;
  return found;
}

Result<void> SetupBoard::compare_with(SetupRecord& record) {
  if (!has_muscle_findings(record)) return {};
  if (auto ready = open(); !ready) return ready;
  const auto known = link_->muscle(address());
  if (!known) return tl::unexpected(known.error());
  if (const auto other = other_muscle(record, *known)) {
    user_.show(other->reason);
    record.discount_from(other->step);
  }
  return {};
}

std::string SetupBoard::left_out(const std::string& step) {
  const auto found = std::ranges::find(setup_steps, step, &SetupStep::name);
  return read() ? operating::left_out(*found, config_->settings, index()) : "";
}

Result<void> SetupBoard::read() {
  return config_ ? Result<void>() : read_again();
}

Result<void> SetupBoard::read_again() {
  auto config = config::read_board_config(options_.config);
  if (!config) return failure(config::to_text(config.error()));
  if (const std::string why = missing_channel(options_.config, options_.channel); !why.empty())
    return failure(why);
  config_ = std::move(*config);
  return {};
}

Result<void> SetupBoard::open() {
  if (auto done = read(); !done) return done;
  std::unique_ptr<BoardLink> opened;
  if (!link_) {
    auto link = open_link(options_.can, options_.socket);
    if (!link) return failure(link.error().text() + "; " + how_to_start());
    opened = std::move(*link);
  }
  BoardLink& board = opened ? *opened : *link_;
  // Both a step's heating and the board's own limits rely on the file.
  const auto others = differences_of_board(board, first_address(), config_->settings, index());
  if (!others) return failure(others.error().text() + "; " + how_to_start());
  if (!others->empty()) {
    return failure(options_.config + ": the board is not running with this file: " + *others +
                   "; " + how_to_start());
  }
  // Only this board is disarmed in the end.
  if (opened) link_ = std::move(opened);
  return {};
}

std::string SetupBoard::how_to_start() const {
  const std::string by_hand = "supercoild --config " + options_.config;
  if (!options_.can.starts_with("socketcand:"))
    return "start the board with it: " + by_hand + ", or systemctl restart supercoild";
  const BoardSettings& board = config_->settings;
  const std::string scenario = board.joint_of(index()) != nullptr    ? "joint-bench"
                               : board.bundle_of(index()) != nullptr ? "bundle-bench"
                                                                     : "bench";
  return "start the board with it: " + by_hand +
         ", or simulated: mkdir -p learned; supercoil-sim run " + scenario + " --board " +
         options_.config + " --real-time --learned learned --can " + options_.can;
}

int SetupBoard::first_address() const {
  return options_.can.empty() || !config_->can ? 1 : config_->can->first_node;
}

std::string SetupBoard::address() const {
  return std::to_string(first_address() + options_.channel - 1);
}

}  // namespace supercoil::operating
