// A muscle whose motion no longer reaches the sensor, and that is cooled worse from then on.
#include <algorithm>

#include <CppUTest/TestHarness.h>

#include "loop/support/rig.hpp"

using namespace supercoil;
using test::Rig;
using test::Task;

namespace {

/// No resistance tells the temperature: only the position can show that something is wrong.
test::RigSettings deaf_board() {
  test::RigSettings s = test::rough_board();
  s.firmware.channels[Rig::tested].heater.temperature_coefficient_per_K = 0.0;
  s.board.channels[Rig::tested].temperature_coefficient_per_K = 0.0;
  return s;
}

class LostContact {
 public:
  explicit LostContact(const test::RigSettings& settings) : settings_(settings), rig(settings) {
    rig.boot();
  }

  void arm_and_heat(Task task) {
    rig.arm();
    rig.run(0.2);
    rig.heat(task);
  }
  void lose_contact() {
    host_sim::MuscleChannelSettings muscle = settings_.board.channels[Rig::tested];
    muscle.plant.heat_transfer_W_per_K *= 0.25;
    rig.muscle().set(muscle);
    rig.muscle().trouble.slack = true;
  }
  /// Until a fault, for at most so long.
  void run(double time_s) {
    const double end_s = rig.time_s() + time_s;
    while (rig.time_s() < end_s && rig.state() != State::fault) {
      rig.tick();
      hottest_C = std::max(hottest_C, 25.0 + rig.muscle().plant().temperature_rise_K());
    }
  }

 private:
  test::RigSettings settings_;

 public:
  Rig rig;
  double hottest_C = 0.0;
};

}  // namespace

TEST_GROUP(LostContact){};

TEST(LostContact, IsFoundThoughTheChannelIsArmedAnewEvery12Seconds) {
  LostContact muscle(deaf_board());
  muscle.rig.scale = 1.15;  // 2.9 W: in the end 154 °C
  muscle.arm_and_heat(Task::power);
  muscle.run(10.0);
  muscle.lose_contact();
  for (int i = 0; i < 4 && muscle.rig.state() != State::fault; ++i) {
    muscle.run(11.7);
    muscle.rig.send(Verb::disarm);
    muscle.run(0.1);
    if (muscle.rig.state() != State::fault) muscle.arm_and_heat(Task::power);
  }
  CHECK(muscle.rig.fault() == Fault::heater_not_responding);
  CHECK_COMPARE(muscle.hottest_C, <, 160.0);
}
