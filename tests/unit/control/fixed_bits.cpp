// Runs everything that has a q8.24 variant in closed loop and prints a hash of its outputs. The
// test fixed_point_same_bits compares the hashes of different compilers and optimisations.
//
// Only the library is under test: positions are rounded to a nanometre first and inputs are built
// without the maths library, so that the muscle's own double arithmetic cannot differ.
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "supercoil/control/estimation/gradient.hpp"
#include "supercoil/control/tracking/model_follower.hpp"

#include "unit/control/support/muscle.hpp"

using namespace supercoil::control;

namespace {

constexpr double step_s = 1e-3;

/// FNV-1a over the bytes of doubles; the library's outputs as doubles hold its raw numbers exactly.
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

/// The laws and the estimator by themselves: Controller and Estimator would pull in every
/// arithmetic, which takes longer to compile than all the rest.
template <class Law>
void print(const char* name, Law law) {
  const ControllerSettings settings;
  ModelFollower<Q8_24, Law> controller(settings, std::move(law), step_s);
  const GradientSettings learning;
  GradientEstimator<Q8_24> estimator(learning, step_s);
  supercoil::test::Muscle muscle(PhysicalParameters{}, step_s);
  Hash hash;
  double position_m = 0.0;
  double applied_W = 0.0;
  bool limited = false;
  for (int k = 0; k < 40000; ++k) {
    position_m = std::round(muscle.position_m() * 1e9) * 1e-9;
    estimator.step(to<Q8_24>(position_m / settings.dc_gain_m_per_W), to<Q8_24>(applied_W));
    controller.learn({.theta = estimator.theta(), .settled = true});
    const auto out = controller.step({.reference_m = reference_m(step_s * k),
                                      .position_m = position_m,
                                      .applied_power_W = applied_W,
                                      .limited = limited});
    hash.add(out.demanded_power_W);
    hash.add(out.model_m);
    for (const double theta : estimator.theta())
      hash.add(theta);
    hash.add(static_cast<double>(estimator.error()));
    applied_W = PowerRange{}.clip(out.demanded_power_W);
    limited = applied_W != out.demanded_power_W;
    muscle.step(applied_W);
  }
  // The values show at a glance that the loop ran.
  std::printf("%-11s %016" PRIx64 " position %.9f m theta4 %.6f\n", name, hash.value(), position_m,
              estimator.theta()[3]);
}

void print(const char* name, const MracSettings& settings) {
  print(name, Mrac<Q8_24>(settings, step_s));
}

}  // namespace

int main() {
  const ControllerSettings s;
  print("printed", MracSettings{}.scaled(10.0));
  print("a", *mrac_preset("a"));
  print("pi", Pi<Q8_24>(s.pi, s.dc_gain_m_per_W, step_s));
  print("pd_ff", PdFeedforward<Q8_24>(s.pd_ff, s.dc_gain_m_per_W, step_s));
  print("adaptive_ff", AdaptiveFeedforward<Q8_24>(s.adaptive_ff, step_s));
  return 0;
}
