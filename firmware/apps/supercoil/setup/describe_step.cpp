#include "apps/supercoil/setup/describe_step.hpp"

#include <filesystem>
#include <system_error>

#include <nlohmann/json.hpp>

#include "apps/supercoil/number_text.hpp"
#include "apps/supercoil/output_file.hpp"
#include "apps/supercoil/setup/describe_muscle.hpp"
#include "apps/supercoil/setup/muscle_answers.hpp"
#include "apps/supercoil/setup/record.hpp"
#include "config/board_config.hpp"
#include "config/describe.hpp"
#include "config/edit_toml.hpp"
#include "config/toml_file.hpp"

namespace supercoil::operating {

namespace {

using Json = nlohmann::ordered_json;
template <class Value>
using Or = tl::expected<Value, std::string>;

/// Whatever is left open is asked for, or an error for each.
Or<MuscleAnswers> complete(MuscleAnswers answers, const SetupOptions& options, Operator& who) {
  std::string missing;
  for (std::size_t i = 0; i < questions.size(); ++i) {
    if (answers.has(i)) continue;
    const Question& q = questions[i];
    if (options.script.empty()) {
      const auto value = who.ask(q, [] { return Operator::Done(); });
      if (!value) return tl::unexpected(value.error() + "\n");
      answers.set(i, *value);
    } else if (!std::isnan(q.fallback)) {
      answers.set(i, q.fallback);
    } else {
      missing += options.script + ": muscle." + std::string(q.key) +
                 ": is missing: " + std::string(q.text) + ", " + range_text(q.allowed) + "\n";
    }
  }
  if (!missing.empty()) return tl::unexpected(missing);
  return answers;
}

/// A list of controllers was chosen by somebody: it stays.
bool stays(const Entry& entry, const std::string& text, std::size_t channel) {
  const toml::table document = toml::parse(text);
  const toml::node* node =
      document.at_path("channel[" + std::to_string(channel) + "]." + entry.path).node();
  return node != nullptr && node->is_array();
}

Or<std::string> edited(std::string text, const SetupOptions& options, std::vector<Entry>& entries) {
  const auto channel = static_cast<std::size_t>(options.channel) - 1;
  std::erase_if(entries, [&](const Entry& entry) { return stays(entry, text, channel); });
  for (const Entry& entry : entries) {
    auto changed = config::with_channel_value(text, channel, entry.path, entry.literal);
    if (!changed) return tl::unexpected(options.config + ": " + changed.error() + "\n");
    text = std::move(*changed);
  }
  return text;
}

}  // namespace

std::string kept_config(const std::string& config) {
  return config + ".before-setup";
}

Or<Json> describe_step(const SetupOptions& options, Operator& who) {
  config::Diagnostics diagnostics(options.config);
  const std::string text = config::read_text(options.config, diagnostics);
  if (diagnostics.empty()) config::parse(text, diagnostics);
  if (!diagnostics.empty()) return tl::unexpected(config::to_text(diagnostics.problems()));
  MuscleAnswers answers;
  if (!options.script.empty()) {
    const auto read = read_script(options.script);
    if (!read) return tl::unexpected(read.error());
    answers = read->muscle;
  }
  const auto completed = complete(answers, options, who);
  if (!completed) return tl::unexpected(completed.error());
  auto described = describe_muscle(*completed);
  if (!described) return tl::unexpected(described.error() + "\n");
  const auto changed = edited(text, options, described->entries);
  if (!changed) return tl::unexpected(changed.error());
  const auto config = config::parse_board_config(*changed, options.config);
  if (!config) return tl::unexpected(config::to_text(config.error()));

  std::error_code ignored;
  if (!std::filesystem::exists(kept_config(options.config), ignored)) {
    if (auto kept = write_whole(kept_config(options.config), text); !kept)
      return tl::unexpected(kept.error() + "\n");
  }
  if (auto written = write_whole(options.config, *changed); !written)
    return tl::unexpected(written.error() + "\n");
  Json found;
  for (const Entry& entry : described->entries) {
    who.say(entry.path + " = " + entry.literal + "  (" + entry.reason + ")");
    found[entry.path] = entry.literal;
  }
  const auto index = static_cast<std::size_t>(options.channel) - 1;
  for (const std::string& line :
       config::describe_feasibility(config->settings.channels[index], config->settings))
    who.say(line);
  for (const std::string& line : config::advice(*config))
    who.say("advice: " + line);
  return found;
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
