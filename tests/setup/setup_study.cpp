// Setup of muscles that nothing was tuned on, each from a description in a bench's units:
//   setup_study [MUSCLES [ERROR_PERCENT [FIRST [SLOWER]]]]
// The figures of docs/setup.md.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "setup/commissioned.hpp"

int main(int argc, char** argv) {
  using namespace supercoil;
  using namespace supercoil::test;
  const int muscles = argc > 1 ? std::atoi(argv[1]) : 20;
  const double error = argc > 2 ? 1e-2 * std::atof(argv[2]) : 0.5;
  const int first = argc > 3 ? std::atoi(argv[3]) : 1;
  const double slower = argc > 4 ? std::atof(argv[4]) : 1.0;
  int followed = 0, kept = 0, near = 0, in_time = 0, both = 0, above_hot_end = 0;
  std::printf(
      "seed linear   tau_s travel_mm promised_um probe_um unexplained error_um standing_um ratio "
      "calibrated_s identified_s took_s rise_K hidden_K\n");
  try {
    for (int seed = first; seed < first + muscles; ++seed) {
      const HeldOut muscle = held_out_muscle(static_cast<unsigned>(seed), error, slower);
      const Commissioned c = commission_by_script(muscle);
      const double ratio = c.error_m / c.promised_m;
      std::printf(
          "%4d %6s %7.2f %9.2f %11.2f %8.2f %11.2f %8.2f %11.2f %5.2f %12.0f %12.0f %6.0f %6.0f "
          "%8.2f %s "
          "%s\n",
          seed, muscle.linear ? "yes" : "no", muscle.time_constant_s, 1e3 * c.travel_m,
          1e6 * c.promised_m, 1e6 * c.probe_m, 1e6 * c.unexplained_m, 1e6 * c.error_m,
          1e6 * c.standing_still_m, ratio, c.calibrated_s, c.identified_s, c.took_s,
          c.hottest_rise_K, c.above_hot_end_K, c.fault == Fault::none ? "" : name(c.fault).data(),
          c.refused.c_str());
      std::fflush(stdout);
      above_hot_end += c.above_hot_end_K > 0.0 ? 1 : 0;
      if (!c.refused.empty()) continue;
      ++followed;
      // A promise that a muscle standing still would keep does not count.
      const bool keeps = ratio <= 1.0 && c.promised_m < c.standing_still_m;
      kept += keeps ? 1 : 0;
      near += keeps && ratio > 1.0 / 3.0 ? 1 : 0;
      const bool soon = c.took_s <= std::max(600.0, 15.0 * muscle.time_constant_s);
      in_time += soon ? 1 : 0;
      both += soon && keeps ? 1 : 0;
    }
  } catch (const std::exception& wrong) {
    std::fprintf(stderr, "setup_study: %s\n", wrong.what());
    return 1;
  }
  std::printf(
      "%d of %d followed; of them %d kept the promise, %d by less than a factor of 3; %d in time, "
      "%d both\n"
      "%d were hotter at times than their board reported as possible\n",
      followed, muscles, kept, near, in_time, both, above_hot_end);
  return 0;
}
