// How `supercoil` understands the answers that supercoild gives on the board's socket.
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <thread>

#include <sys/socket.h>
#include <sys/un.h>

#include <CppUTest/TestHarness.h>
#include <nlohmann/json.hpp>

#include "apps/supercoil/board_link.hpp"
#include "apps/supercoild/local_commands.hpp"
#include "loop/support/rig.hpp"
#include "unit/hal_linux/support/temporary_folder.hpp"

using namespace supercoil;
using namespace supercoil::daemon;
using operating::BoardSocket;
using operating::LocalBoardLink;

namespace {

Row row_of_mode(Mode mode, ModeResult result, std::uint8_t notes) {
  Row row{};
  row.state = static_cast<std::uint8_t>(State::active);
  row.mode = static_cast<std::uint8_t>(mode);
  row.model_m = 0.010F;
  row.position_m = 0.0125F;
  row.hottest_C = NAN;
  row.progress = 0.25F;
  row.result = static_cast<std::uint8_t>(result);
  row.identify_notes = notes;
  return row;
}

/// Answers as the daemon's thread does, until destroyed.
class Served {
 public:
  explicit Served(const Row& row) : rows_(rig_.loop.channels()) {
    rows_.put(row);
    auto commands = LocalCommands::open(path_);
    if (!commands) FAIL(commands.error().text().c_str());
    thread_ = std::thread([this, mine = std::move(*commands)]() mutable {
      while (!ends_)
        mine.serve(rig_.loop, rows_, 10);
    });
  }
  Served(const Served&) = delete;
  Served& operator=(const Served&) = delete;
  ~Served() {
    ends_ = true;
    thread_.join();
  }

  LocalBoardLink link() const {
    auto socket = BoardSocket::open(path_);
    if (!socket) FAIL(socket.error().text().c_str());
    return LocalBoardLink(std::move(*socket));
  }

 private:
  test::TemporaryFolder folder_;
  std::string path_ = folder_ / "commands";
  test::Rig rig_{test::rough_board()};
  NewestRows rows_;
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

}  // namespace

TEST_GROUP(LocalBoardLink){};

TEST(LocalBoardLink, ReportsProgressAndResultOfIdentify) {
  const Served board(row_of_mode(Mode::identify, ModeResult::found, 1));
  LocalBoardLink link = board.link();
  DOUBLES_EQUAL(0.25, link.progress("1").value(), 1e-9);
  const auto ending = link.ending("1").value();
  STRCMP_EQUAL("found", ending.result.c_str());
  STRCMP_EQUAL(describe_notes(1, ",").c_str(), ending.notes.c_str());
  CHECK(std::isnan(link.error_m("1").value()));
  DOUBLES_EQUAL(0.0125, link.position_m("1").value(), 1e-8);
  CHECK_FALSE(link.progress("7").has_value());
}

TEST(LocalBoardLink, ReportsTheTrackingErrorInModePosition) {
  const Served board(row_of_mode(Mode::position, ModeResult::none, 0));
  LocalBoardLink link = board.link();
  DOUBLES_EQUAL(0.0025, link.error_m("1").value(), 1e-8);
  STRCMP_EQUAL("", link.ending("1").value().notes.c_str());
}

TEST(LocalBoardLink, ReportsTheWholeStateAsJson) {
  const Served board(row_of_mode(Mode::position, ModeResult::none, 0));
  LocalBoardLink link = board.link();
  const auto channel = nlohmann::json::parse(link.state_json().value())["channels"][0];
  LONGS_EQUAL(16, channel.size());
  CHECK_FALSE(channel["slack"].get<bool>());
  LONGS_EQUAL(0, channel["controller"].get<int>());
  STRCMP_EQUAL("pi", channel["controller_kind"].get<std::string>().c_str());
  LONGS_EQUAL(1, channel["channel"].get<int>());
  STRCMP_EQUAL("active", channel["state"].get<std::string>().c_str());
  STRCMP_EQUAL("position", channel["mode"].get<std::string>().c_str());
  STRCMP_EQUAL("none", channel["fault"].get<std::string>().c_str());
  DOUBLES_EQUAL(0.0125, channel["position_m"].get<double>(), 1e-9);
  CHECK(channel["hottest_C"].is_null());
  DOUBLES_EQUAL(0.25, channel["progress"].get<double>(), 1e-9);
  STRCMP_EQUAL("none", channel["result"].get<std::string>().c_str());
  STRCMP_EQUAL("", channel["notes"].get<std::string>().c_str());
}

TEST(LocalBoardLink, TellsWhatIsWrongWithALine) {
  const Served board(row_of_mode(Mode::position, ModeResult::none, 0));
  LocalBoardLink link = board.link();
  const char* why = "channel '7': must be 1 to 2";
  STRCMP_EQUAL(why, link.ask("7 arm").value().c_str());
  STRCMP_EQUAL(why, link.prepare("7", 0, "kind", "1").value().c_str());
  const auto tuning = link.tuning("7", 0, 0, TuningSet::in_use);
  const auto muscle = link.muscle("7");
  for (const Error& error : {tuning.error(), muscle.error()}) {
    STRCMP_EQUAL(why, error.text().c_str());
    CHECK(error.code == std::errc::invalid_argument);
  }
}

TEST(LocalBoardLink, ReportsASlackMuscle) {
  Row row = row_of_mode(Mode::position, ModeResult::none, 0);
  row.flags = row_slack;
  const Served board(row);
  LocalBoardLink link = board.link();
  STRCMP_CONTAINS(" - 0 pi slack\n", link.state().value().c_str());
  CHECK_TRUE(nlohmann::json::parse(link.state_json().value())["channels"][0]["slack"].get<bool>());
}

TEST(LocalBoardLink, ASignalLosesNoAnswer) {
  const test::TemporaryFolder folder;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  (folder / "commands").copy(address.sun_path, sizeof(address.sun_path) - 1);
  const hal_linux::Descriptor listener(::socket(AF_UNIX, SOCK_SEQPACKET, 0));
  const auto* where = reinterpret_cast<const sockaddr*>(&address);
  LONGS_EQUAL(0, ::bind(listener.number(), where, sizeof(address)));
  LONGS_EQUAL(0, ::listen(listener.number(), 1));
  auto socket = BoardSocket::open(folder / "commands");
  CHECK(socket.has_value());
  const auto before = std::signal(SIGUSR1, [](int) {});
  const pthread_t asks = pthread_self();
  std::thread board([&] {
    const hal_linux::Descriptor client(::accept(listener.number(), nullptr, nullptr));
    std::array<char, 8> line{};
    CHECK(::recv(client.number(), line.data(), line.size(), 0) > 0);
    for (int i = 0; i < 5; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      pthread_kill(asks, SIGUSR1);
    }
    CHECK(::send(client.number(), "ok", 2, 0) == 2);
  });
  const auto answer = socket->ask("1 renew");
  board.join();
  std::signal(SIGUSR1, before);
  STRCMP_EQUAL("ok", answer ? answer->c_str() : answer.error().text().c_str());
}
