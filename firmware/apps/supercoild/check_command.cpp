#include <cmath>
#include <cstdio>

#include <nlohmann/json.hpp>

#include "apps/common/exit_status.hpp"
#include "apps/common/feasibility_json.hpp"
#include "apps/common/keys_json.hpp"
#include "apps/common/problems_json.hpp"
#include "apps/supercoild/commands.hpp"
#include "apps/supercoild/locked_memory.hpp"
#include "apps/supercoild/storage_worker.hpp"
#include "config/board_config.hpp"
#include "config/describe.hpp"
#include "storage/posix_files.hpp"
#include "storage/store.hpp"

namespace supercoil::daemon {

namespace {

using Json = nlohmann::ordered_json;

/// Applies what each channel has learned and returns its version; 0: nothing. On a machine other
/// than the board the folder does not exist.
std::vector<std::uint32_t> recall_learned(config::BoardConfig& config) {
  storage::PosixFiles files;
  std::vector<std::uint32_t> versions;
  for (std::size_t i = 0; i < config.settings.channels.size(); ++i) {
    storage::LearnedStore store(config.storage_folder, static_cast<int>(i + 1), files);
    const auto loaded = store.load();
    const bool known = loaded && loaded->learned;
    versions.push_back(known ? loaded->learned->version : 0);
    if (!known) continue;
    apply_learned(config.settings.channels[i], *loaded->learned);
    if (const auto problem =
            drop_unusable_tuning(config.settings.channels[i], config.settings.step_s())) {
      std::fprintf(stderr, "channel %zu: the stored tuning is not used: %s %s\n", i + 1,
                   problem->key.c_str(), problem->message.c_str());
    }
  }
  return versions;
}

Json json_of(const config::BoardConfig& config, const std::vector<std::uint32_t>& versions) {
  Json channels = Json::array();
  for (std::size_t i = 0; i < versions.size(); ++i) {
    channels.push_back({{"name", config.labels[i].name},
                        {"learned_version", versions[i]},
                        {"feasibility", feasibility_json(config.settings, i)}});
  }
  Json can;
  if (config.can) {
    can = {{"interface", config.can->interface},
           {"bit_rate", std::llround(config.can->bit_rate)},
           {"first_node", config.can->first_node}};
  }
  return {{"board", config.name},
          {"rate_Hz", config.settings.rate_Hz},
          {"channels", channels},
          {"can", can},
          {"weaknesses", config::warnings(config)},
          {"advice", config::advice(config)}};
}

void print(const Json& json) {
  std::puts(json.dump(2).c_str());
}

int refuse(const Errors& problems, bool as_json) {
  if (as_json) {
    print(problems_json(problems));
  } else {
    std::fputs(config::to_text(problems).c_str(), stderr);
  }
  return exit_wrong_input;
}

}  // namespace

int keys_command(const std::string& file, bool as_json) {
  config::KeyList keys;
  const auto config = config::read_board_config(file, &keys);
  if (!config) return refuse(config.error(), as_json);
  if (as_json) {
    print(keys_json(keys));
  } else {
    std::fputs(config::to_text(keys).c_str(), stdout);
  }
  return exit_done;
}

int check_command(const std::string& file, bool as_json) {
  auto config = config::read_board_config(file);
  if (!config) return refuse(config.error(), as_json);
  const std::vector<std::uint32_t> versions = recall_learned(*config);
  if (as_json) {
    print(json_of(*config, versions));
    return exit_done;
  }
  for (std::size_t i = 0; i < versions.size(); ++i) {
    if (versions[i] == 0) continue;
    std::printf("channel %zu: with what was learned before, version %u in %s\n", i + 1, versions[i],
                config->storage_folder.c_str());
  }
  std::fputs(config::describe(*config).c_str(), stdout);
  std::fputs(describe_locked_memory(*config).c_str(), stdout);
  return exit_done;
}

}  // namespace supercoil::daemon
