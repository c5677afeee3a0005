#include "attack/bundle_attack.hpp"

namespace supercoil::test {

namespace {

using BundleAttacks = std::vector<BundleAttack>;

/// To the muscle that leads, and to one that follows.
void add_to_both_kinds(BundleAttacks& attacks, const std::string& what, const BundledHarm& harm,
                       const BundleAttack& other = {}) {
  for (const std::size_t muscle : {std::size_t{0}, std::size_t{2}}) {
    BundleAttack a = other;
    a.name = (muscle == 0 ? "leader: " : "follower: ") + what;
    a.muscles.at(muscle) = harm;
    attacks.push_back(a);
  }
}

void add_lying_bundle_senses(BundleAttacks& attacks) {
  BundleAttack from_start;
  from_start.from_start = true;
  for (const double gain : {0.64, 0.78, 1.3, 1.5})
    add_to_both_kinds(attacks, "current × " + text_of(gain), {.current_gain = gain}, from_start);
  for (const double gain : {0.78, 0.9, 1.3}) {
    BundleAttack a = from_start;
    a.name = "supply × " + text_of(gain);
    a.supply_gain = gain;
    attacks.push_back(a);
  }
}

void add_bundle_cooling(BundleAttacks& attacks) {
  for (const bool off : {false, true}) {
    for (const double ratio : {0.2, 0.4, worst_configured_cooling, 2.0}) {
      BundleAttack other;
      if (ratio < worst_configured_cooling) {
        other.guard = "thermal fuse";
        other.blindness = worse_cooling;
      }
      const std::string what = (off ? "off its anchor, cooling × " : "cooling × ") + text_of(ratio);
      add_to_both_kinds(attacks, what, {.cooling_ratio = ratio, .off = off}, other);
    }
  }
}

void add_bundle_leaks(BundleAttacks& attacks) {
  for (const double percent : {1.0, 5.0, 20.0, 100.0}) {
    BundleAttack other;
    if (percent <= 5.0) other.blindness = leak_as_noise;
    add_to_both_kinds(attacks, leak_text(percent), {.switch_leak_ratio = 0.01 * percent}, other);
  }
}

void add_bundle_mistakes(BundleAttacks& attacks) {
  BundleAttack& swapped = attacks.emplace_back();
  swapped.name = "current senses of two followers swapped";
  swapped.from_start = swapped.swapped_currents = true;
  BundleAttack& air = attacks.emplace_back();
  air.name = "air at 60 °C";
  air.from_start = true;
  air.air_C = 60.0;
  air.blindness = warmer_air;
}

void add_identified_bundles(BundleAttacks& attacks) {
  const BundleAttacks others = attacks;
  for (BundleAttack a : others) {
    if (a.blindness.empty() && a.guard.empty()) continue;
    a.name = "identified, " + a.name;
    a.identified = true;
    if (a.air_C >= 60.0) a.guard = "thermal fuse";
    attacks.push_back(a);
  }
}

}  // namespace

BundleAttacks all_bundle_attacks() {
  BundleAttacks attacks;
  add_lying_bundle_senses(attacks);
  add_bundle_cooling(attacks);
  add_bundle_leaks(attacks);
  add_bundle_mistakes(attacks);
  add_identified_bundles(attacks);
  return attacks;
}

}  // namespace supercoil::test
