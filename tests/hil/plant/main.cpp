// supercoil-rig-plant: the muscles and the power stage of the emulated board. It runs on the
// board's own processor, at a higher priority than everything else there, and so takes time from
// the firmware: the witness reports how much (S lines).
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <fstream>
#include <optional>
#include <system_error>

#include <sched.h>
#include <sys/mman.h>

#include <CLI/CLI.hpp>

#include "injected_faults.hpp"
#include "plant.hpp"
#include "witness.hpp"

namespace {

using namespace supercoil;

struct Options {
  rig::PlantSettings plant;
  std::string witness;
  std::string injected_faults;
  int priority = 90;
};

hal::Time now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

void sleep_until(hal::Time wake) {
  const auto whole = std::chrono::duration_cast<std::chrono::seconds>(wake);
  const timespec time{whole.count(), (wake - whole).count()};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr) == EINTR) {
  }
}

void become_real_time(int priority) {
  const sched_param parameters{priority};
  if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0 ||
      sched_setscheduler(0, SCHED_FIFO, &parameters) != 0)
    throw std::system_error(errno, std::generic_category(), "real-time priority");
}

std::string started(const rig::PlantSettings& settings) {
  char text[200];
  std::snprintf(text, sizeof text,
                "# supercoil-rig-plant channels=%d rate_Hz=%g supply_V=%g "
                "charge_pump_decay_ms=%g sense_filter_ms=%g",
                settings.channels, settings.rate_Hz, settings.supply_V,
                settings.charge_pump_decay_ms, settings.sense_filter_ms);
  return text;
}

[[noreturn]] void run(const Options& options) {
  rig::Plant plant(options.plant);
  rig::Witness witness(options.witness);
  std::optional<rig::Orders> orders;
  if (!options.injected_faults.empty()) orders.emplace(options.injected_faults);
  become_real_time(options.priority);
  witness.note(started(options.plant));

  const hal::Duration period = hal::duration_from(1.0 / options.plant.rate_Hz);
  const hal::Time start = now();
  for (long step = 1, last = 0;; last = step++) {
    // A step that came too late is caught up: the board's own clock goes on in whole periods.
    while (start + step * period + period < now())
      ++step;
    const hal::Time wake = start + step * period;
    sleep_until(wake);
    const hal::Time woken = now();
    const bool slow = last == 0 || step / 10 != last / 10;
    plant.step(step * period, slow);
    const hal::Time latched = now();
    witness.look(plant, latched);
    if (std::string order; orders && slow && !(order = orders->next()).empty()) {
      const std::string wrong = rig::obey(order, plant.board(), plant.channels());
      witness.note("T " + std::to_string(latched.count() / 1000) + " " + order +
                   (wrong.empty() ? "" : ": refused, it " + wrong));
    }
    if (last == 0 && orders) std::ofstream(options.injected_faults + ".ready");
    witness.step_took(latched, now() - woken, woken - wake, static_cast<int>(step - last - 1));
  }
}

int run_program(int count, char** arguments) {
  Options options;
  rig::PlantSettings& plant = options.plant;
  CLI::App app{"The muscles and the power stage of the emulated board.", "supercoil-rig-plant"};
  app.add_option("--channels", plant.channels)->check(CLI::Range(1, 4))->capture_default_str();
  app.add_flag("--joint", plant.joint,
               "The first two channels are a joint's, of the default lever");
  app.add_option("--rate-Hz", plant.rate_Hz)->check(CLI::Range(100, 2000))->capture_default_str();
  app.add_option("--supply-V", plant.supply_V)->capture_default_str();
  app.add_option("--decay-ms", plant.charge_pump_decay_ms, "Of the charge pump")
      ->capture_default_str();
  app.add_option("--sense-filter-ms", plant.sense_filter_ms)->capture_default_str();
  app.add_option("--seed", plant.seed, "Of the sensors' noise")->capture_default_str();
  app.add_option("--priority", options.priority, "SCHED_FIFO")->capture_default_str();
  app.add_option("--i2c-bus", plant.i2c_bus)->capture_default_str();
  app.add_option("--pwm-address", plant.pwm_address)->capture_default_str();
  app.add_option("--first-converter", plant.first_converter)->capture_default_str();
  app.add_option("--lines", plant.lines, "A folder of each line")->capture_default_str();
  app.add_option("--witness", options.witness, "Where lines are written; else standard output");
  app.add_option("--faults", options.injected_faults, "FIFO of faults to inject");
  CLI11_PARSE(app, count, arguments);
  if (plant.joint && plant.channels < 2) {
    std::fputs("supercoil-rig-plant: --joint needs two channels\n", stderr);
    return EXIT_FAILURE;
  }
  run(options);
}

}  // namespace

int main(int count, char** arguments) {
  try {
    return run_program(count, arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "supercoil-rig-plant: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
