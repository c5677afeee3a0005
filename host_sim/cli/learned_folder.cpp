#include "cli/learned_folder.hpp"

#include <cstdio>

namespace supercoil::host_sim {

tl::expected<LearnedMuscles, std::string> LearnedFolder::load() {
  LearnedMuscles learned;
  if (!kept_) return learned;
  for (std::size_t i = 0; i < stores_.size(); ++i) {
    const auto loaded = stores_[i].load();
    if (!loaded) return tl::unexpected(loaded.error());
    for (const std::string& problem : loaded->problems)
      std::fprintf(stderr, "supercoil-sim: %s\n", problem.c_str());
    learned[i] = loaded->learned;
  }
  return learned;
}

tl::expected<void, std::string> LearnedFolder::save(const Simulation& simulation) {
  for (std::size_t i = 0; kept_ && i < stores_.size(); ++i) {
    const auto& learned = simulation.learned(i);
    if (!learned) continue;
    if (auto saved = stores_[i].save(*learned); !saved) return tl::unexpected(saved.error());
  }
  return {};
}

}  // namespace supercoil::host_sim
