// Which inputs cause which fault of a board, after which time, and that they cause no other.
#include "supervisor/board_supervisor.hpp"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <CppUTest/TestHarness.h>

#include "unit/firmware/core/support/tick.hpp"

using namespace supercoil;
using supercoil::test::tick_s;

namespace {

using BoardChange = std::function<void(BoardInputs&)>;

/// A healthy board, tick by tick.
class Board {
 public:
  BoardInputs inputs;
  BoardSupervisor supervisor{BoardSupervision{}, tick_s};

  Board() {
    inputs.supply = {12.0, 0.0, true, hal::Status::ok};
    inputs.stop_circuit = {true, hal::Status::ok};
  }
  Fault step() {
    if (telemetry_lives) ++inputs.telemetry_heartbeats;
    return supervisor.step(inputs);
  }
  bool telemetry_lives = true;
};

struct BoardCause {
  Fault fault;
  int ticks;  ///< until it is found
  BoardChange begins;
};

const std::vector<BoardCause> board_causes{
    {Fault::emergency_stop, 1, [](BoardInputs& e) { e.stop_circuit.high = false; }},
    {Fault::emergency_stop, 1,
     [](BoardInputs& e) { e.stop_circuit.status = hal::Status::io_error; }},
    {Fault::under_voltage, 20, [](BoardInputs& e) { e.supply.value = 10.7; }},
    {Fault::under_voltage, 20, [](BoardInputs& e) { e.supply.present = false; }},
    {Fault::over_voltage, 20, [](BoardInputs& e) { e.supply.value = 13.3; }},
    {Fault::overrun, 5, [](BoardInputs& e) { e.skipped = 1; }},
    {Fault::overrun, 1, [](BoardInputs& e) { e.skipped = 5; }},
    {Fault::tick_late, 5, [](BoardInputs& e) { e.late_s = 0.00051; }},
    {Fault::bus_off, 1, [](BoardInputs& e) { e.bus = hal::CanState::bus_off; }},
    {Fault::bus_off, 1, [](BoardInputs& e) { e.bus = hal::CanState::down; }},
    {Fault::bus_error_passive, 1000, [](BoardInputs& e) { e.bus = hal::CanState::error_passive; }},
    {Fault::node_conflict, 1, [](BoardInputs& e) { e.node_conflict = true; }},
    {Fault::line_failed, 1, [](BoardInputs& e) { e.lines_ok = false; }},
    {Fault::configuration_invalid, 1, [](BoardInputs& e) { e.configuration_changed = true; }},
    {Fault::self_test_failed, 1, [](BoardInputs& e) { e.self_test_failed = true; }},
};

void check_board_fault(Fault expected, Fault found) {
  STRCMP_EQUAL(std::string(name(expected)).c_str(), std::string(name(found)).c_str());
}

}  // namespace

TEST_GROUP(BoardSupervisor){};

TEST(BoardSupervisor, ReportsNoFaultInNormalOperation) {
  Board board;
  board.inputs.late_s = 0.00049;
  for (int i = 0; i < 3000; ++i)
    check_board_fault(Fault::none, board.step());
}

TEST(BoardSupervisor, DetectsEachFaultAtItsTimeAndNotEarlier) {
  for (const BoardCause& injected : board_causes) {
    Board board;
    for (int i = 0; i < 10; ++i)
      check_board_fault(Fault::none, board.step());
    injected.begins(board.inputs);
    for (int i = 1; i < injected.ticks; ++i)
      check_board_fault(Fault::none, board.step());
    check_board_fault(injected.fault, board.step());
    CHECK(board.supervisor.verdict().fault() == injected.fault);
    // The margin of the fault is used up.
    CHECK_COMPARE(board.supervisor.verdict().margin(injected.fault).used(), >=, 0.99);
  }
}

TEST(BoardSupervisor, AnUnreadSupplyCountsAsZeroVolts) {
  Board board;
  board.inputs.supply.present = false;
  board.step();
  DOUBLES_EQUAL(0.0, board.supervisor.verdict().margin(Fault::over_voltage).measured, 0.0);
}

TEST(BoardSupervisor, DetectsAStalledTelemetryThread) {
  Board board;
  for (int i = 0; i < 10; ++i)
    check_board_fault(Fault::none, board.step());
  board.telemetry_lives = false;
  for (int i = 1; i < 500; ++i)
    check_board_fault(Fault::none, board.step());
  check_board_fault(Fault::telemetry_dead, board.step());
  CHECK_COMPARE(board.supervisor.verdict().margin(Fault::telemetry_dead).used(), >=, 0.99);
}

TEST(BoardSupervisor, ClearsAFaultWhoseCauseIsGone) {
  for (const BoardCause& injected : board_causes) {
    Board board;
    const BoardInputs well = board.inputs;
    injected.begins(board.inputs);
    for (int i = 0; i < injected.ticks; ++i)
      board.step();
    board.inputs = well;
    board.inputs.telemetry_heartbeats = 1000;
    check_board_fault(Fault::none, board.step());
    check_board_fault(Fault::none, board.supervisor.verdict().board_fault());
  }
}

// A bus fault is no reason to doubt the switches: it does not set the board's latch.
TEST(BoardSupervisor, OnlyBoardFaultsStopTheHeartbeat) {
  for (const BoardCause& injected : board_causes) {
    Board board;
    injected.begins(board.inputs);
    for (int i = 0; i < injected.ticks; ++i)
      board.step();
    const bool stops = info(injected.fault)->scope == Scope::board;
    check_board_fault(stops ? injected.fault : Fault::none,
                      board.supervisor.verdict().board_fault());
  }
}

TEST(BoardSupervisor, TheFirstCauseOfATickDoesNotHideABoardFault) {
  Board board;
  board.inputs.bus = hal::CanState::bus_off;
  board.inputs.configuration_changed = true;
  check_board_fault(Fault::bus_off, board.step());
  check_board_fault(Fault::configuration_invalid, board.supervisor.verdict().board_fault());
}

TEST(BoardSupervisor, ReportsTheFirstOfTwoBoardFaults) {
  Board board;
  board.inputs.stop_circuit.high = false;
  board.inputs.configuration_changed = true;
  board.step();
  check_board_fault(Fault::emergency_stop, board.supervisor.verdict().board_fault());
}
