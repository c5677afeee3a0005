// What the storage worker stores after a comparison with a meter, and what the next start reads.
#include "apps/supercoild/storage_worker.hpp"

#include <cstdio>
#include <ctime>
#include <string>

#include <unistd.h>

#include <CppUTest/TestHarness.h>

#include "loop/support/rig.hpp"
#include "unit/hal_linux/support/temporary_folder.hpp"

using namespace supercoil;

TEST_GROUP(StorageWorker) {
  static constexpr double supply_V = 12.0;

  test::TemporaryFolder folder;
  storage::PosixFiles files;
  test::RigSettings settings = test::rough_board();
  test::Rig rig{settings};
  std::vector<storage::LearnedStore> stores;
  std::unique_ptr<daemon::StorageWorker> storage_worker;

  config::BoardConfig config() const {
    config::BoardConfig config;
    config.settings = settings.firmware;
    config.storage_folder = folder.path();
    config.labels.resize(settings.firmware.channels.size());
    return config;
  }
  config::BoardConfig configured = config();

  void setup() override {
    for (int channel : {1, 2})
      stores.emplace_back(folder.path(), channel, files);
    storage_worker = std::make_unique<daemon::StorageWorker>(configured, stores, files);
    rig.boot();
    rig.arm();
    rig.run(0.1);
  }
  void compare() {
    for (const double power_W : {0.5, 1.0}) {
      for (int i = 0; i < 40; ++i) {
        rig.send(Verb::power, power_W);
        rig.run(0.05);
      }
      rig.send(Verb::compare_supply, supply_V);
      rig.send(Verb::compare_current, rig.muscle().true_power_W() / supply_V);
      rig.run_ticks(1);
    }
    keep();
  }
  void keep() {
    storage_worker->poll(rig.loop, hal::Time{});
  }
  /// The first channel of a board that starts now.
  ChannelSettings next_start() {
    config::BoardConfig next = config();
    const auto known = daemon::load_learned(next, stores);
    if (!known) FAIL(known.error().text().c_str());
    return next.settings.channels[0];
  }
};

TEST(StorageWorker, DatesAComparisonForTheNextStart) {
  CHECK_FALSE(next_start().senses.compared());
  const auto before = static_cast<double>(std::time(nullptr));
  compare();
  const ChannelSettings next = next_start();
  CHECK(next.senses.compared());
  CHECK(next.senses.compared_s >= before);
  CHECK(next.senses.compared_s <= static_cast<double>(std::time(nullptr)));
  // The muscle was never learned: the configured one stays valid.
  CHECK_FALSE(next.has_muscle);
  CHECK(next.muscle == settings.firmware.channels[0].muscle);
}

TEST(StorageWorker, ALaterScaleKeepsTheComparisonAndItsDate) {
  compare();
  const board::SenseComparison compared = next_start().senses;
  rig.send(Verb::scale, 0.9 * rig.snapshot().position_m);
  rig.run_ticks(1);
  keep();
  const ChannelSettings next = next_start();
  CHECK(next.has_muscle);
  DOUBLES_EQUAL(0.9, next.calibration.position_scale, 0.05);
  CHECK(next.senses == compared);
}

TEST(StorageWorker, TheComparisonOutlivesTheMuscleAndHasItsOwnForgetCommand) {
  compare();
  rig.send(Verb::scale, 0.9 * rig.snapshot().position_m);
  rig.send(Verb::store, 0.0);
  rig.run_ticks(1);
  keep();
  CHECK_FALSE(next_start().has_muscle);
  CHECK(next_start().senses.compared());
  rig.send(Verb::rest);
  rig.send(Verb::compare_supply, 0.0);
  rig.run_ticks(1);
  keep();
  CHECK_FALSE(next_start().senses.compared());
}

TEST(StorageWorker, TheNextStartLogsWhyTheProofOfResponseIsOff) {
  const auto logged = [&] {
    std::FILE* const kept = std::tmpfile();
    const int own = ::dup(STDERR_FILENO);
    ::dup2(::fileno(kept), STDERR_FILENO);
    next_start();
    ::dup2(own, STDERR_FILENO);
    ::close(own);
    std::rewind(kept);
    std::string text(65536, '\0');
    text.resize(std::fread(text.data(), 1, text.size(), kept));
    std::fclose(kept);
    return text;
  };
  constexpr const char* switched_off = "channel 1: detectors.proof_of_response is false: nothing";
  CHECK(logged().find("responds") == std::string::npos);
  settings.firmware.channels[0].supervision.proof_of_response = false;
  STRCMP_CONTAINS(switched_off, logged().c_str());
  add_joint(settings.firmware, {.agonist = 0, .antagonist = 1});
  const std::string of_joint = logged();
  STRCMP_CONTAINS("channel 2: a joint's two muscles have no proof of response: nothing",
                  of_joint.c_str());
  CHECK(of_joint.find("proof_of_response is false") == std::string::npos);
}
