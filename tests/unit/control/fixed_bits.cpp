// Runs everything that has a q8.24 variant in closed loop and prints a hash of its outputs. The
// test fixed_point_same_bits compares the hashes of different compilers and optimisations.
//
// Only the library is under test: positions come to it already rounded to a nanometre and inputs
// are built without the maths library, so that the muscle's own double arithmetic cannot differ.
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "supercoil/control/estimation/estimator.hpp"
#include "supercoil/control/tracking/controller.hpp"

#include "unit/control/support/muscle.hpp"

using namespace supercoil::control;

namespace {

/// FNV-1a over the bytes of doubles; those of the library's outputs hold its raw numbers exactly.
class Hash {
 public:
  void add(double value) {
    unsigned char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    for (const unsigned char byte : bytes)
      state_ = (state_ ^ byte) * 0x100000001b3ULL;
  }
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

/// Steps of 5, 15, 8 and 20 mm.
double reference_m(double time_s) {
  constexpr double levels[] = {0.005, 0.015, 0.008, 0.020};
  return levels[static_cast<int>(time_s / 10.0) % 4];
}

std::uint64_t run(const MracSettings& mrac, ControllerKind kind, double final_values[2]) {
  constexpr double step_s = 1e-3;
  ControllerSettings settings;
  settings.kind = kind;
  settings.arithmetic = Arithmetic::q8_24;
  settings.mrac = mrac;
  Controller controller(settings, step_s);
  EstimatorSettings learning;
  learning.arithmetic = Arithmetic::q8_24;
  Estimator estimator(learning, step_s);
  supercoil::test::Muscle muscle(PhysicalParameters{}, step_s);
  Hash hash;
  double applied_W = 0.0;
  bool limited = false;
  for (int k = 0; k < 40000; ++k) {
    const double position_m = std::round(muscle.position_m() * 1e9) * 1e-9;
    estimator.step(position_m, applied_W);
    const auto out = controller.step({.reference_m = reference_m(step_s * k),
                                      .position_m = position_m,
                                      .applied_power_W = applied_W,
                                      .limited = limited});
    hash.add(out.wanted_power_W);
    hash.add(out.model_m);
    const auto estimate = *estimator.estimate();
    controller.learn(estimate);
    for (const double theta : estimate.theta)
      hash.add(theta);
    hash.add(estimate.prediction_error_W);
    applied_W = PowerRange{}.clip(out.wanted_power_W);
    limited = applied_W != out.wanted_power_W;
    muscle.step(applied_W);
    final_values[0] = position_m;
    final_values[1] = estimate.theta[3];
  }
  return hash.value();
}

void print(const char* name, const MracSettings& mrac, ControllerKind kind = ControllerKind::mrac) {
  double final_values[2];
  const std::uint64_t hash = run(mrac, kind, final_values);
  // The values show at a glance that the loop did something.
  std::printf("%-8s %016" PRIx64 " position %.9f m theta4 %.6f\n", name, hash, final_values[0],
              final_values[1]);
}

}  // namespace

int main() {
  print("printed", MracSettings{}.scaled(10.0));
  print("a", *mrac_preset("a"));
  print("pi", MracSettings{}, ControllerKind::pi);
  print("pd_ff", MracSettings{}, ControllerKind::pd_ff);
  print("adapt_ff", MracSettings{}, ControllerKind::adaptive_ff);
  return 0;
}
