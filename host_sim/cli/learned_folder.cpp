#include "cli/learned_folder.hpp"

#include <cstdio>

namespace supercoil::host_sim {

Result<LearnedMuscles> LearnedFolder::load() {
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

void LearnedFolder::store(std::size_t channel, const board::LearnedUpdate& update) {
  if (!kept_) return;
  storage::LearnedStore& its = stores_[channel];
  const auto stored = update ? its.save(*update).map([](auto) {}) : its.forget();
  if (stored) return;
  complete_ = false;
  std::fprintf(stderr, "supercoil-sim: channel %zu learned, but it is not stored: %s\n",
               channel + 1, stored.error().text().c_str());
}

}  // namespace supercoil::host_sim
