#include "apps/supercoil/setup/describe_step.hpp"

#include <charconv>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <system_error>

#include <unistd.h>

#include <nlohmann/json.hpp>

#include "apps/supercoil/answer_lines.hpp"
#include "apps/supercoil/interrupted.hpp"
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

constexpr int max_tries = 3;
constexpr std::chrono::milliseconds look_every{100};

Or<std::string> next_line(AnswerLines& lines) {
  for (;;) {
    if (auto line = lines.wait(look_every)) return *line;
    if (interrupted != 0) return tl::unexpected<std::string>("interrupted\n");
    if (lines.ended()) return tl::unexpected<std::string>("nobody answers\n");
  }
}

Or<double> answer_to(const Question& q, AnswerLines& lines, std::FILE* out) {
  const std::string range =
      number_text(q.allowed.lowest, 9) + " to " + number_text(q.allowed.highest, 9);
  for (int i = 0; i < max_tries; ++i) {
    std::fprintf(out, "%s (%s)%s: ", std::string(q.text).c_str(), range.c_str(),
                 std::isnan(q.fallback) ? "" : (" [" + number_text(q.fallback, 9) + "]").c_str());
    std::fflush(out);
    const auto line = next_line(lines);
    if (!line) return tl::unexpected(line.error());
    if (line->empty() && !std::isnan(q.fallback)) return q.fallback;
    double value = 0.0;
    const char* end = line->data() + line->size();
    const auto read = std::from_chars(line->data(), end, value);
    const bool is_number = read.ec == std::errc{} && read.ptr == end;
    if (is_number && value >= q.allowed.lowest && value <= q.allowed.highest) return value;
    std::fprintf(out, "'%s' is refused: it must be a number from %s\n", line->c_str(),
                 range.c_str());
  }
  return tl::unexpected("no allowed answer in 3 tries: " + std::string(q.text) + "\n");
}

/// Whatever is left open is asked for, or an error for each.
Or<MuscleAnswers> complete(MuscleAnswers answers, const SetupOptions& options, std::FILE* out) {
  AnswerLines lines(STDIN_FILENO);
  std::string missing;
  for (std::size_t i = 0; i < questions.size(); ++i) {
    if (answers.has(i)) continue;
    const Question& q = questions[i];
    if (options.script.empty()) {
      const auto value = answer_to(q, lines, out);
      if (!value) return tl::unexpected(value.error());
      answers.set(i, *value);
    } else if (!std::isnan(q.fallback)) {
      answers.set(i, q.fallback);
    } else {
      missing += options.script + ": muscle." + std::string(q.key) +
                 ": is missing: " + std::string(q.text) + ", " + number_text(q.allowed.lowest, 9) +
                 " to " + number_text(q.allowed.highest, 9) + "\n";
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

Or<Json> describe_step(const SetupOptions& options, std::FILE* out) {
  config::Diagnostics diagnostics(options.config);
  const std::string text = config::read_text(options.config, diagnostics);
  if (diagnostics.empty()) config::parse(text, diagnostics);
  if (!diagnostics.empty()) return tl::unexpected(config::to_text(diagnostics.problems()));
  MuscleAnswers answers;
  if (!options.script.empty()) {
    const auto read = read_answers(options.script);
    if (!read) return tl::unexpected(read.error());
    answers = *read;
  }
  const auto completed = complete(answers, options, out);
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
    std::fprintf(out, "  %s = %s  (%s)\n", entry.path.c_str(), entry.literal.c_str(),
                 entry.reason.c_str());
    found[entry.path] = entry.literal;
  }
  const auto index = static_cast<std::size_t>(options.channel) - 1;
  for (const std::string& line :
       config::describe_feasibility(config->settings.channels[index], config->settings))
    std::fprintf(out, "  %s\n", line.c_str());
  for (const std::string& line : config::advice(*config))
    std::fprintf(out, "  advice: %s\n", line.c_str());
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
