// The socket for programs on the board itself, without the daemon's threads around it.
#include "apps/supercoild/local_commands.hpp"

#include <array>
#include <cerrno>
#include <cstring>

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <CppUTest/TestHarness.h>

#include "loop/support/rig.hpp"
#include "unit/hal_linux/support/temporary_folder.hpp"

using namespace supercoil;
using namespace supercoil::daemon;

namespace {

class Client {
 public:
  explicit Client(const std::string& path) : socket_(::socket(AF_UNIX, SOCK_SEQPACKET, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, path.data(), path.size());
    const auto* where = reinterpret_cast<const sockaddr*>(&address);
    LONGS_EQUAL(0, ::connect(socket_.number(), where, sizeof(address)));
  }
  void send(const std::string& line) const {
    LONGS_EQUAL(line.size(), ::send(socket_.number(), line.data(), line.size(), MSG_NOSIGNAL));
  }
  /// Empty: nothing has arrived.
  std::string received() const {
    std::array<char, 8192> text{};
    const ssize_t size = ::recv(socket_.number(), text.data(), text.size(), MSG_DONTWAIT);
    return size > 0 ? std::string(text.data(), static_cast<std::size_t>(size)) : "";
  }

 private:
  hal_linux::Descriptor socket_;
};

LocalCommands opened(const std::string& path) {
  auto commands = LocalCommands::open(path);
  if (!commands) FAIL(commands.error().text().c_str());
  return std::move(*commands);
}

}  // namespace

TEST_GROUP(LocalCommands) {
  test::TemporaryFolder folder;
  std::string path = folder / "commands";
  LocalCommands commands = opened(path);
  test::Rig rig{test::rough_board()};
  NewestRows rows{rig.loop.channels()};

  std::string answer_to(const Client& client, const std::string& line) {
    client.send(line);
    commands.serve(rig.loop, rows, 0);
    return client.received();
  }
  void pass_answers() {
    for (Answer answer; rig.loop.answer(answer);)
      commands.pass(answer, rig.loop);
  }
  /// The answer from the loop's next tick.
  std::string obeyed(const Client& client, const std::string& line) {
    STRCMP_EQUAL("", answer_to(client, line).c_str());
    rig.executive.run_tick();
    pass_answers();
    return client.received();
  }
  /// A client that has been accepted.
  Client client() {
    Client made(path);
    commands.serve(rig.loop, rows, 0);
    return made;
  }
};

TEST(LocalCommands, OwnerAndGroupMayCommandWhateverTheUmask) {
  for (const mode_t mask : {0U, 0007U, 0077U}) {
    const mode_t usual = ::umask(mask);
    const LocalCommands again = opened(path);
    LONGS_EQUAL(mask, ::umask(usual));
    struct stat made {};
    LONGS_EQUAL(0, ::lstat(path.c_str(), &made));
    CHECK(S_ISSOCK(made.st_mode));
    LONGS_EQUAL(0660, made.st_mode & 07777U);
  }
}

/// The owner of the folder can leave anything there before the socket is made.
TEST(LocalCommands, TheTargetOfALinkInTheSocketsPlaceIsLeftUnchanged) {
  folder.write("other", "of somebody else");
  LONGS_EQUAL(0, ::chmod((folder / "other").c_str(), 0600));
  folder.link("link", "other");
  const LocalCommands again = opened(folder / "link");
  struct stat other {};
  LONGS_EQUAL(0, ::stat((folder / "other").c_str(), &other));
  LONGS_EQUAL(0600, other.st_mode & 07777U);
  STRCMP_EQUAL("of somebody else", folder.read("other").c_str());
}

TEST(LocalCommands, AreAnsweredOnceTheLoopHasExecutedThem) {
  const Client one = client();
  const Client other = client();
  STRCMP_EQUAL("", answer_to(one, "1 disarm").c_str());
  STRCMP_EQUAL("", answer_to(other, "1 rest").c_str());
  rig.executive.run_tick();
  pass_answers();
  STRCMP_EQUAL("ok", one.received().c_str());
  STRCMP_EQUAL("refused: wrong_state", other.received().c_str());
}

TEST(LocalCommands, AreRefusedAtOnceWhileTheQueueIsFullWithoutChangingTheOrder) {
  const Client busy = client();
  STRCMP_EQUAL("", answer_to(busy, "1 rest").c_str());
  while (rig.loop.send({0, Verb::disarm, 0.0, Source::can})) {
  }
  STRCMP_EQUAL("refused: too many commands", answer_to(busy, "1 disarm").c_str());
  rig.executive.run_tick();
  for (Answer answer; rig.loop.answer(answer);) {
    if (answer.command.source != Source::can) commands.pass(answer, rig.loop);
  }
  STRCMP_EQUAL("refused: wrong_state", busy.received().c_str());
  STRCMP_EQUAL("", busy.received().c_str());
}

TEST(LocalCommands, AreRefusedRatherThanTruncated) {
  const Client one = client();
  const std::string longest = "1 power 4.5" + std::string(186, '0') + "e-3";
  LONGS_EQUAL(200, longest.size());
  STRCMP_EQUAL("", answer_to(one, longest).c_str());
  // Cut after 200 bytes it would ask for 4.5 W instead of 4.5 mW.
  STRCMP_EQUAL("wrong: longer than 200 bytes",
               answer_to(one, "1 power 4.5" + std::string(189, '0') + "e-3").c_str());
  STRCMP_CONTAINS("1 disarmed", answer_to(one, "state").c_str());
}

/// Only a set of values that cannot be used has a reason.
TEST(LocalCommands, AnUnsuitableScaleIsNotExplainedByTuning) {
  const Client one = client();
  STRCMP_EQUAL("", answer_to(one, "1 scale 0.01").c_str());
  rig.executive.run_tick();
  Answer answer;
  CHECK(rig.loop.answer(answer));
  answer.refusal = Refusal::unsuitable;
  commands.pass(answer, rig.loop);
  STRCMP_EQUAL("refused: unsuitable", one.received().c_str());
}

TEST(LocalCommands, AControllerIsTuned) {
  const Client one = client();
  const auto in_use = [&] { return answer_to(one, "tuning 1 0 integral_W_per_m_s in_use"); };
  const std::string before = in_use();
  STRCMP_EQUAL("ok", answer_to(one, "prepare 1 0 integral_W_per_m_s 321.5").c_str());
  STRCMP_EQUAL(before.c_str(), in_use().c_str());
  STRCMP_EQUAL("", answer_to(one, "1 tune 0").c_str());
  rig.executive.run_tick();
  pass_answers();
  STRCMP_EQUAL("ok", one.received().c_str());
  STRCMP_EQUAL("321.5", in_use().c_str());
  STRCMP_EQUAL("ok", answer_to(one, "prepare 1 0 all configured").c_str());
  STRCMP_EQUAL(before.c_str(), answer_to(one, "tuning 1 0 integral_W_per_m_s prepared").c_str());
}

TEST(LocalCommands, TheReasonForAnUnsuitableControllerIsGiven) {
  const Client one = client();
  STRCMP_EQUAL("ok", answer_to(one, "prepare 1 0 integral_W_per_m_s 1e7").c_str());
  answer_to(one, "1 tune 0");
  rig.executive.run_tick();
  pass_answers();
  STRCMP_CONTAINS("refused: unsuitable: kind is unstable on this muscle", one.received().c_str());
  for (const auto& [line, answer] :
       {std::pair{"prepare 1 0 integral_W_per_m_s 1e9",
                  "refused: out_of_range; 1e+07 would be obeyed"},
        std::pair{"prepare 1 7 kind 1", "refused: out_of_range"},
        std::pair{"prepare 1 0 volume 1", "refused: out_of_range"},
        std::pair{"prepare 1 0 kind pi", "wrong: 'pi' is not a number"},
        std::pair{"prepare 1 0 all mine", "wrong: 'mine' is not a set of values"},
        std::pair{"prepare 9 0 kind 1", "wrong: channel '9': must be 1 to 2"},
        std::pair{"tuning 1 x kind in_use", "wrong: 'x' is not a controller"},
        std::pair{"tuning 1 0 kind", "wrong: '' is not a set of values"},
        std::pair{"tuning 1 0 volume in_use", "nan"}})
    STRCMP_EQUAL(answer, answer_to(one, line).c_str());
}

TEST(LocalCommands, ALostAnswerDoesNotShiftOthers) {
  const Client one = client();
  const Client other = client();
  answer_to(one, "1 disarm");
  answer_to(other, "1 rest");
  rig.executive.run_tick();
  Answer lost;
  CHECK(rig.loop.answer(lost));
  pass_answers();
  STRCMP_EQUAL("", one.received().c_str());
  STRCMP_EQUAL("refused: wrong_state", other.received().c_str());
}

TEST(LocalCommands, AnExcessClientIsRefusedWithAReason) {
  constexpr std::size_t max_clients = 20;
  std::vector<Client> clients;
  clients.reserve(max_clients);
  while (clients.size() < max_clients)
    clients.push_back(client());
  const Client one_more = client();
  STRCMP_EQUAL("refused: too many clients", one_more.received().c_str());
  CHECK_FALSE(answer_to(clients.back(), "state").empty());
}

TEST(LocalCommands, MuscleHasOneLinePerMuscle) {
  const Client asking = client();
  const std::string answer = answer_to(asking, "muscle");
  STRCMP_CONTAINS(
      "1 0.162 0.089 16 2 0.09 0.0086 10 0 1 0 nan nan nan nan nan "
      "0.162 0.089 16 2 0.09 0.0086 10 nan nan nan nan nan nan nan nan nan nan nan nan -0.025 "
      "0.025 nan 4.5 160 0.13 0.2 0.045 0.18 nan\n2 ",
      answer.c_str());
}

TEST(LocalCommands, TheStateOfATrajectoryIsReported) {
  const Client one = client();
  Row row{};
  row.time_ns = 123456789012345;
  rows.put(row);
  STRCMP_EQUAL("1 empty 0 0 123456.789012345\n2 empty 0 0 123456.789012345\n",
               answer_to(one, "playback").c_str());
  STRCMP_EQUAL("wrong: channel '3': must be 1 to 2", answer_to(one, "3 knot 0 0.005 0").c_str());
  // At rest there is no motion that could follow the knot.
  STRCMP_EQUAL("refused: wrong_state", obeyed(one, "1 knot 0 0.005 0").c_str());
}

TEST(LocalCommands, AStartIsGivenInBoardTime) {
  rig.boot();
  rig.arm();
  rig.run(0.2);
  const Client one = client();
  STRCMP_EQUAL("ok", obeyed(one, "1 position 0.002").c_str());
  STRCMP_EQUAL("ok", obeyed(one, "1 knot 0 0.002 0").c_str());
  const double now_s = hal::seconds(rig.board.now());
  for (const std::string& when : {std::string("1e300"), std::string("-1e300"), std::string("0"),
                                  std::to_string(now_s + 61.0)})
    STRCMP_EQUAL("refused: out_of_range", obeyed(one, "1 start " + when).c_str());
  STRCMP_EQUAL("ok", obeyed(one, "1 start " + std::to_string(now_s + 0.1)).c_str());
}
