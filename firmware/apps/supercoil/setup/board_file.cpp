#include "apps/supercoil/setup/board_file.hpp"

#include <filesystem>
#include <system_error>

#include "apps/supercoil/setup/record.hpp"
#include "apps/supercoil/user_file.hpp"
#include "config/edit_toml.hpp"
#include "config/toml_file.hpp"

namespace supercoil::operating {

std::string kept_config(const std::string& config) {
  return config + ".before-setup";
}

tl::expected<std::string, std::string> read_board_text(const std::string& config) {
  config::Diagnostics diagnostics(config);
  std::string text = config::read_text(config, diagnostics);
  if (diagnostics.empty()) config::parse(text, diagnostics);
  if (!diagnostics.empty()) return tl::unexpected(config::to_text(diagnostics.problems()));
  return text;
}

tl::expected<config::BoardConfig, std::string> write_entries(const SetupOptions& options,
                                                             const std::string& text,
                                                             const std::vector<Entry>& entries) {
  std::string changed = text;
  const auto channel = static_cast<std::size_t>(options.channel) - 1;
  for (const Entry& entry : entries) {
    auto next = config::with_channel_value(changed, channel, entry.path, entry.literal);
    if (!next) return tl::unexpected(options.config + ": " + next.error() + "\n");
    changed = std::move(*next);
  }
  auto config = config::parse_board_config(changed, options.config);
  if (!config) return tl::unexpected(config::to_text(config.error()));

  std::error_code ignored;
  if (!std::filesystem::exists(kept_config(options.config), ignored)) {
    if (auto kept = write_whole(kept_config(options.config), text); !kept)
      return tl::unexpected(kept.error() + "\n");
  }
  if (auto written = write_whole(options.config, changed); !written)
    return tl::unexpected(written.error() + "\n");
  return std::move(*config);
}

tl::expected<void, std::string> undo_setup(const SetupOptions& options) {
  const std::string kept = kept_config(options.config);
  std::error_code error;
  if (!std::filesystem::exists(kept, error))
    return tl::unexpected(kept + ": is not there: setup has changed nothing");
  std::filesystem::rename(kept, options.config, error);
  if (error) return tl::unexpected(kept + ": " + error.message());
  std::filesystem::remove(SetupRecord::path_of(options.config), error);
  return {};
}

}  // namespace supercoil::operating
