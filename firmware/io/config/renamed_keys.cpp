#include "config/renamed_keys.hpp"

namespace supercoil::config {

namespace {

constexpr std::string_view common_channel = "every_channel";
constexpr std::string_view one_channel = "channel";

/// The path without list indices and with the name of a channel's own table:
/// "channel[1].estimator[2]" and "every_channel.estimator" are both channel.estimator.
std::string plain(const std::string& path) {
  std::string result;
  bool in_place = false;
  for (const char c : path) {
    if (c == '[') in_place = true;
    if (!in_place) result += c;
    if (c == ']') in_place = false;
  }
  if (result.starts_with(common_channel)) result.replace(0, common_channel.size(), one_channel);
  return result;
}

/// Whether path is table, or ends with it after a dot.
bool is_in(std::string_view path, std::string_view table) {
  if (path == table) return true;
  return !table.empty() && path.size() > table.size() && path.ends_with(table) &&
         path[path.size() - table.size() - 1] == '.';
}

}  // namespace

std::string_view renamed_to(const std::string& path, std::string_view old_key) {
  const std::string table = plain(path);
  for (const RenamedKey& renamed : renamed_keys) {
    if (renamed.old_key == old_key && is_in(table, renamed.table)) return renamed.key;
  }
  return {};
}

std::string renamed_message(const std::string& path, std::string_view old_key) {
  const std::string_view key = renamed_to(path, old_key);
  if (key.empty()) return {};
  return "was renamed in 0.2.0: write " + (path.empty() ? "" : path + ".") + std::string(key);
}

}  // namespace supercoil::config
