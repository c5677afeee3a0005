// The daemon's threads over a simulated board in real time; also run under ThreadSanitizer. Nothing
// here is timed: every wait ends with an event.
#include <csignal>
#include <random>
#include <thread>

#include <unistd.h>

#include <CppUTest/TestHarness.h>

#include "apps/supercoil/board_socket.hpp"
#include "apps/supercoild/ending_signals.hpp"
#include "apps/supercoild/local_commands.hpp"
#include "apps/supercoild/loop_thread.hpp"
#include "apps/supercoild/storage_worker.hpp"
#include "apps/supercoild/telemetry.hpp"
#include "unit/firmware/apps/supercoild/support/meeting_bus.hpp"
#include "unit/firmware/apps/supercoild/support/patient_board.hpp"
#include "unit/firmware/apps/supercoild/support/real_time_board.hpp"
#include "unit/firmware/io/telemetry/support/master.hpp"
#include "unit/hal_linux/support/temporary_folder.hpp"

using namespace supercoil;
using namespace supercoil::daemon;
using operating::BoardSocket;

TEST_GROUP(DaemonThreads) {
  test::TemporaryFolder folder;
  test::RigSettings settings = test::patient_board();
  config::BoardConfig config = test::config_of(settings.firmware, folder.path());
  storage::PosixFiles files;
  std::vector<storage::LearnedStore> stores;
  test::RealTimeBoard board{settings.board};
  Loop loop{settings.firmware, board.devices()};
  std::unique_ptr<StorageWorker> storage_worker;
  test::MeetingBus bus;
  supercoil::telemetry::CanEndpoint can{{}, settings.firmware, loop, bus, std::mt19937(1)};
  std::unique_ptr<Telemetry> telemetry;
  std::unique_ptr<LoopThread> thread;
  sigset_t before{};
  void (*hangup_before)(int) = SIG_DFL;

  void setup() override {
    // nohup makes this program ignore the signal too; an ignored signal would not be blocked.
    hangup_before = std::signal(SIGHUP, SIG_DFL);
    // Before there are threads, as in the daemon.
    pthread_sigmask(SIG_BLOCK, nullptr, &before);
    block_ending_signals();
    for (std::size_t i = 0; i < loop.channels(); ++i)
      stores.emplace_back(folder.path(), static_cast<int>(i + 1), files);
    storage_worker = std::make_unique<StorageWorker>(config, stores, files);
    auto commands = LocalCommands::open(folder / "commands");
    if (!commands) FAIL(commands.error().text().c_str());
    telemetry =
        std::make_unique<Telemetry>(loop, storage_worker->relay(), std::move(*commands), &can);
    CHECK(telemetry->start().has_value());
    auto started = LoopThread::start(loop, board, settings.firmware.rate_Hz, {"loop"});
    if (!started) FAIL(started.error().text().c_str());
    thread = std::move(*started);
  }
  void teardown() override {
    thread->stop();
    thread.reset();
    telemetry.reset();
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    std::signal(SIGHUP, hangup_before);
  }

  BoardSocket client() const {
    auto socket = BoardSocket::open(folder / "commands");
    if (!socket) FAIL(socket.error().text().c_str());
    return std::move(*socket);
  }
  static std::string ask(const BoardSocket& socket, const std::string& line) {
    const auto answer = socket.ask(line);
    return answer ? *answer : answer.error().text();
  }
  /// Records rows, as the daemon's main thread does, until the condition holds.
  template <class Condition>
  void until(const Condition& holds) {
    constexpr int max_rounds = 6000;
    for (int i = 0; i < max_rounds; ++i) {
      storage_worker->poll(loop, board.now());
      if (holds()) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    FAIL("it did not come about");
  }
  void until_state(const BoardSocket& socket, const std::string& begins) {
    until([&] { return ask(socket, "state").starts_with(begins); });
  }
  void arm(const BoardSocket& socket) {
    until([&] { return ask(socket, "1 arm") == "ok"; });
    until_state(socket, "1 armed");
  }
  void cools_at(int signal) {
    const BoardSocket socket = client();
    arm(socket);
    kill(getpid(), signal);
    until([&] { return storage_worker->all_off(); });
    sigset_t sent;
    sigemptyset(&sent);
    sigaddset(&sent, signal);
    int taken = 0;
    sigwait(&sent, &taken);
    LONGS_EQUAL(signal, taken);
  }
};

TEST(DaemonThreads, ACommandThatIsNotRenewedExpires) {
  const BoardSocket socket = client();
  arm(socket);
  until([&] { return ask(socket, "1 power 1") == "ok"; });  // busy while it probes
  until_state(socket, "1 active power none");
  until_state(socket, "1 fault rest command_timeout");
  STRCMP_EQUAL("refused: wrong_state", ask(socket, "1 power 1").c_str());
  STRCMP_EQUAL("ok", ask(socket, "1 reset").c_str());
  until_state(socket, "1 disarmed");
}

TEST(DaemonThreads, CoolSwitchesAllChannelsOff) {
  const BoardSocket socket = client();
  arm(socket);
  CHECK_FALSE(storage_worker->all_off());
  telemetry->cool();
  until([&] { return storage_worker->all_off(); });
}

TEST(DaemonThreads, CanMastersAreAnsweredOnTheBusAndLocalClientsOnTheSocket) {
  constexpr std::uint16_t acknowledge = SUPERCOIL_ACKNOWLEDGE_FRAME_ID;
  const BoardSocket socket = client();
  test::Master master;
  master.session = master.name;
  float nonce = telemetry::claim_value;
  for (const std::size_t claims : {1U, 2U}) {
    bus.deliver(master.frame(telemetry::Opcode::lease, nonce));
    until([&] { return bus.sent(acknowledge).size() == claims; });
    nonce = test::read_answer(bus.sent(acknowledge).back()).granted;
  }
  master.session = test::read_answer(bus.sent(acknowledge).back()).granted;
  CHECK(master.session != 0);

  const auto obeyed = [&](Verb verb) {
    const std::size_t answers = bus.sent(acknowledge).size();
    bus.deliver(master.frame(verb));
    STRCMP_EQUAL("refused: wrong_state", ask(socket, "1 rest").c_str());
    until([&] { return bus.sent(acknowledge).size() > answers; });
    return test::read_answer(bus.sent(acknowledge).back()).refusal == 0;
  };
  until([&] { return obeyed(Verb::disarm); });
  constexpr std::uint16_t status = SUPERCOIL_STATUS_FRAME_ID;  // of node 1
  until([&] { return !bus.sent(status).empty() && !bus.sent(status + 1).empty(); });
}

TEST(DaemonThreads, APendingSigtermCoolsWhileTheMainThreadIsBusyElsewhere) {
  cools_at(SIGTERM);
}

TEST(DaemonThreads, APendingSigintCoolsWhileTheMainThreadIsBusyElsewhere) {
  cools_at(SIGINT);
}

TEST(DaemonThreads, APendingSighupCoolsWhileTheMainThreadIsBusyElsewhere) {
  cools_at(SIGHUP);
}

TEST(DaemonThreads, ADisconnectedClientDoesNotTakeAnothersAnswer) {
  const BoardSocket stays = client();
  for (int i = 0; i < 20; ++i) {
    {
      const BoardSocket leaves = client();
      STRCMP_EQUAL("refused: wrong_state", ask(leaves, "1 rest").c_str());
    }
    STRCMP_EQUAL("ok", ask(stays, "1 disarm").c_str());
  }
}

TEST(DaemonThreads, NonsenseIsAnswered) {
  const BoardSocket socket = client();
  STRCMP_EQUAL("wrong: channel 'x': must be 1 to 2; it comes first, as in '1 arm'",
               ask(socket, "x").c_str());
  CHECK(ask(socket, std::string(200, 'a')).starts_with("wrong: channel"));
  STRCMP_EQUAL("wrong: longer than 200 bytes", ask(socket, std::string(5000, 'a')).c_str());
  CHECK(ask(socket, std::string("1 arm\0disarm", 12)).starts_with("wrong: "));
}

TEST(DaemonThreads, AnExcessClientIsRefused) {
  std::vector<BoardSocket> clients;
  for (int i = 0; i < 20; ++i) {
    clients.push_back(client());
    CHECK(ask(clients.back(), "state").starts_with("1 "));
  }
  const BoardSocket one_more = client();
  STRCMP_EQUAL("refused: too many clients", ask(one_more, "state").c_str());
}
