#include "attack/bundle_attack.hpp"

namespace supercoil::test {

namespace {

constexpr std::array<NamedMuscle, 2> bundled_muscles{{{0, "leader"}, {2, "follower"}}};

void add_bundle_cooling(std::vector<BundleAttack>& attacks) {
  for (const bool off : {false, true}) {
    for (const double ratio : {0.2, 0.4, worst_configured_cooling, 2.0}) {
      add_to_each(attacks, bundled_muscles,
                  (off ? "off its anchor, cooling × " : "cooling × ") + text_of(ratio),
                  {.cooling_ratio = ratio, .off = off}, cooled_by<BundleAttack>(ratio));
    }
  }
}

}  // namespace

std::vector<BundleAttack> all_bundle_attacks() {
  std::vector<BundleAttack> attacks;
  add_lying_senses(attacks, bundled_muscles);
  add_bundle_cooling(attacks);
  add_leaks(attacks, bundled_muscles);
  add_from_start(attacks, "current senses of two followers swapped").swapped_currents = true;
  add_hot_air(attacks);
  add_identified(attacks);
  return attacks;
}

}  // namespace supercoil::test
