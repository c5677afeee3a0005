#include "apps/supercoil/setup/board_file.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "apps/supercoil/setup/record.hpp"
#include "apps/supercoil/user_file.hpp"
#include "config/edit_toml.hpp"
#include "config/toml_file.hpp"
#include "storage/crc32.hpp"

namespace supercoil::operating {

std::string free_name(const std::string& path) {
  std::string name = path;
  std::error_code ignored;
  for (int i = 2; std::filesystem::exists(name, ignored); ++i)
    name = path + "-" + std::to_string(i);
  return name;
}

Result<std::string> read_board_text(const std::string& config) {
  config::Diagnostics diagnostics(config);
  std::string text = config::read_text(config, diagnostics);
  if (diagnostics.empty()) config::parse(text, diagnostics);
  if (!diagnostics.empty()) return failure(config::to_text(diagnostics.problems()));
  return text;
}

std::string missing_channel(const std::string& config, int channel) {
  const auto text = read_board_text(config);
  if (!text) return "";
  const toml::table document = toml::parse(*text);
  const toml::array* const channels = document["channel"].as_array();
  const std::size_t count = channels == nullptr ? document.contains("channel") : channels->size();
  if (static_cast<std::size_t>(channel) <= count) return "";
  return config + " has no channel " + std::to_string(channel) + ", but " + std::to_string(count);
}

Result<config::BoardConfig> write_entries(const SetupOptions& options, const std::string& step,
                                          const std::string& text,
                                          const std::vector<Entry>& entries) {
  std::string changed = text;
  const auto channel = static_cast<std::size_t>(options.channel) - 1;
  for (const Entry& entry : entries) {
    auto next = config::with_value(changed, entry.joint ? "joint" : "channel",
                                   entry.joint.value_or(channel), entry.path, entry.literal);
    if (!next) return failure(options.config + ": " + next.error().text() + "\n");
    changed = std::move(*next);
  }
  auto config = config::parse_board_config(changed, options.config);
  if (!config) {
    // The line numbers belong to a text that is not written.
    for (Error& problem : config.error())
      problem.line = 0;
    return failure(config::to_text(config.error()));
  }

  if (changed == text) return std::move(*config);
  auto record = SetupRecord::open(options.config, options.channel);
  if (!record) return failure(record.error().text() + "\n");
  const std::string before = free_name(options.config + before_setup);
  auto written = write_file(before, text);
  if (written)
    written = record->add_write({options.channel, step, before, storage::crc32(changed)});
  if (written) written = write_file(options.config, changed);
  if (!written) return failure(written.error().text() + "\n");
  return std::move(*config);
}

bool wrote_file(const nlohmann::ordered_json& found) {
  return std::ranges::any_of(
      found.items(), [](const auto& item) { return item.key().find('.') != std::string::npos; });
}

}  // namespace supercoil::operating
