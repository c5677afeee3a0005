// A simulated board of two channels in real time with supercoild's threads and its socket for
// commands, FOLDER/commands: for programs that command a board without CAN.
//
//     local_board FOLDER       ready when it prints "ready"; ends when its input does
#include <cstdio>
#include <thread>

#include <poll.h>
#include <unistd.h>

#include "apps/supercoild/local_commands.hpp"
#include "apps/supercoild/loop_thread.hpp"
#include "apps/supercoild/storage_worker.hpp"
#include "apps/supercoild/telemetry.hpp"
#include "unit/firmware/apps/supercoild/support/patient_board.hpp"
#include "unit/firmware/apps/supercoild/support/real_time_board.hpp"

using namespace supercoil;
using namespace supercoil::daemon;

namespace {

int run(const std::string& folder) {
  const test::RigSettings settings = test::patient_board();
  const config::BoardConfig config = test::config_of(settings.firmware, folder);
  storage::PosixFiles files;
  std::vector<storage::LearnedStore> stores;
  for (std::size_t i = 0; i < settings.firmware.channels.size(); ++i)
    stores.emplace_back(folder, static_cast<int>(i + 1), files);
  test::RealTimeBoard board(settings.board);
  Loop loop(settings.firmware, board.devices());
  StorageWorker storage(config, stores, files);
  auto commands = LocalCommands::open(folder + "/commands");
  if (!commands) {
    std::fprintf(stderr, "local_board: %s\n", commands.error().text().c_str());
    return 1;
  }
  Telemetry telemetry(loop, storage.relay(), std::move(*commands), nullptr);
  const auto telling = telemetry.start();
  const auto thread = LoopThread::start(loop, board, settings.firmware.rate_Hz, {"loop"});
  if (!telling || !thread) {
    std::fprintf(stderr, "local_board: %s\n",
                 (telling ? thread.error().text() : telling.error().text()).c_str());
    return 1;
  }
  std::puts("ready");
  std::fflush(stdout);
  for (pollfd input{STDIN_FILENO, POLLIN, 0}; ::poll(&input, 1, 10) == 0;)
    storage.poll(loop, board.now());
  (*thread)->stop();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2) return run(argv[1]);
  std::fprintf(stderr, "usage: local_board FOLDER\n");
  return 2;
}
