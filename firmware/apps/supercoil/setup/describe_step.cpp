#include <nlohmann/json.hpp>

#include "apps/common/feasibility_json.hpp"
#include "apps/supercoil/setup/board_file.hpp"
#include "apps/supercoil/setup/channel_steps.hpp"
#include "apps/supercoil/setup/describe_muscle.hpp"
#include "apps/supercoil/setup/file_joint.hpp"
#include "apps/supercoil/setup/file_steps.hpp"
#include "apps/supercoil/setup/next_question.hpp"
#include "apps/supercoil/setup/record.hpp"
#include "apps/supercoil/setup/script.hpp"
#include "config/board_config.hpp"
#include "config/describe.hpp"
#include "config/toml_file.hpp"
#include "text/number_text.hpp"

namespace supercoil::operating {

namespace {

using Json = nlohmann::ordered_json;

/// The answers to describe: of the nameplate, if there is one, and of the muscle.
struct DescribeAnswers {
  Nameplate nameplate;
  MuscleAnswers muscle;
};

/// Stores the answer at once, and offers it when the question is asked again.
Result<double> ask_and_store(Question q, SetupRecord& record, Operator& user) {
  const std::string key(q.key);
  const auto before = record.answer(key);
  if (before && q.allows(*before)) q.fallback = *before;
  const auto value = user.ask(q, [] { return Operator::Done(); });
  if (!value) return failure(value.error().text() + "\n");
  if (auto kept = record.add_answer(key, *value); !kept) return failure(kept.error().text() + "\n");
  return *value;
}

/// Asks the questions one after the other.
Result<DescribeAnswers> ask_questions(const BoardRanges& board, SetupRecord& record,
                                      Operator& user) {
  DescribeAnswers answers;
  const auto has = ask_and_store(has_nameplate, record, user);
  if (!has) return tl::unexpected(has.error());
  for (std::size_t i = 0; *has > 0.0 && i < nameplate_questions.size(); ++i) {
    do {
      const auto value = ask_and_store(nameplate_questions[i], record, user);
      if (!value) return tl::unexpected(value.error());
      answers.nameplate.set(i, *value);
      if (const std::string wrong = answers.nameplate.objection(); !wrong.empty()) user.show(wrong);
    } while (!answers.nameplate.objection().empty());
  }
  for (std::size_t i = 0; i < questions.size(); ++i) {
    Question q = next_question(i, answers.muscle, board);
    const double rated = answers.nameplate.suggested(static_cast<QuestionId>(i));
    if (!std::isnan(rated)) q.fallback = std::fmin(rated, q.allowed.max);
    const auto value = ask_and_store(q, record, user);
    if (!value) return tl::unexpected(value.error());
    answers.muscle.set(i, *value);
  }
  return answers;
}

/// The error for a value that the board does not allow, worded like the question to a person.
Error out_of_range_error(const Question& q, double value, const std::string& script, int line) {
  return {script, line, "muscle." + std::string(q.key),
          "must be " + range_text(q.allowed) + " here: " + std::string(q.text),
          number_text(value, range_digits)};
}

/// Fills in what a script leaves open, or returns an error for each gap.
Result<DescribeAnswers> complete_script(const Script& script, const SetupOptions& options,
                                        const BoardRanges& board) {
  MuscleAnswers answers = script.muscle;
  std::string wrong;
  if (const std::string rated = script.nameplate.objection(); !rated.empty())
    wrong += options.script + ": nameplate." + rated + "\n";
  for (std::size_t i = 0; i < questions.size(); ++i) {
    if (answers.has(i)) {
      const Question q = next_question(i, answers, board);
      const double value = answers.of(static_cast<QuestionId>(i));
      if (value > q.allowed.max)
        wrong += out_of_range_error(q, value, options.script, script.lines[i]).text() + "\n";
      continue;
    }
    const Question& q = questions[i];
    const double rated = script.nameplate.suggested(static_cast<QuestionId>(i));
    const double offered = std::isnan(rated) ? q.fallback : rated;
    const config::Range allowed = next_question(i, answers, board).allowed;
    if (rated > allowed.max) {
      wrong += options.script + ": muscle." + std::string(q.key) + " = " +
               number_text(rated, range_digits) + " by [nameplate]: must be " +
               range_text(allowed) + " here: answer it in [muscle]: " + std::string(q.text) + "\n";
    } else if (!std::isnan(offered)) {
      answers.set(i, offered);
    } else {
      wrong += options.script + ": muscle." + std::string(q.key) +
               ": is missing: " + std::string(q.text) + ", " + range_text(q.allowed) + "\n";
    }
  }
  if (!wrong.empty()) return failure(wrong);
  return DescribeAnswers{script.nameplate, answers};
}

/// Sets the joint's range_deg instead of the travel if range_deg is the bound; writes nothing if
/// range_deg is at least as tight as the answer.
void fit_travel(const std::string& text, int channel, std::vector<Entry>& entries, Operator& user) {
  const auto travel = std::ranges::find(entries, travel_key, &Entry::path);
  auto fitting =
      travel_entry(text, channel, std::stod(travel->literal), travel->literal, travel->reason);
  if (fitting) {
    *travel = std::move(*fitting);
    return;
  }
  user.show("its travel stays as set by its joint's range_deg: " +
            number_text(1e3 * joint_in_file(text, channel)->max_travel_m(), 4) + " mm");
  entries.erase(travel);
}

/// A list of controllers was chosen by a person: it stays, with the model for its laws.
bool is_kept(const Entry& entry, const std::string& text, std::size_t channel) {
  if (entry.path != "controller" && entry.path != "reference_model") return false;
  const toml::table document = toml::parse(text);
  return document.at_path("channel[" + std::to_string(channel) + "].controller").is_array();
}

void show_joint_measurement(const FileJoint& joint, Operator& user) {
  user.show("it turns a joint: answer for this muscle moving " +
            std::string(joint.has_other ? "the joint alone, with the other muscle cold"
                                        : "the joint against what draws it back") +
            ". Hang weights at the lever, " + number_text(1e3 * joint.lever.zero_radius_m(), 4) +
            " mm from the axis; answers in mm are its contraction; the weight that it lifts is the "
            "joint's inertia over the lever's square");
}

/// From a file that need not be complete yet.
config::LoopTime loop_time_in_file(const std::string& text, int channel) {
  const toml::table document = toml::parse(text);
  const double rate_Hz = document.at_path("board.rate_Hz").value_or(BoardSettings().rate_Hz);
  const auto at = [&](const char* key) {
    const auto node = document.at_path("channel[" + std::to_string(channel - 1) + "]." + key);
    return node ? node : document.at_path(std::string("every_channel.") + key);
  };
  // A PWM on a bus takes a tick.
  const double delay_ms = at("heater.delay_ms").value_or(at("pwm.bus") ? 1e3 / rate_Hz : 0.0);
  return {1.0 / rate_Hz, 1.0 / rate_Hz + 1e-3 * delay_ms};
}

Result<Json> write_description(const DescribeAnswers& answers, const SetupOptions& options,
                               const std::string& text, Operator& user) {
  auto described = describe_muscle(answers.muscle, loop_time_in_file(text, options.channel));
  if (!described) {
    const std::string script = options.script.empty() ? "" : options.script + ": ";
    return failure(script + described.error().text() + "\n");
  }
  for (Entry& limit : answers.nameplate.limits(trip_in_file_C(text, options.channel)))
    described->entries.push_back(std::move(limit));
  const auto index = static_cast<std::size_t>(options.channel) - 1;
  std::erase_if(described->entries,
                [&](const Entry& entry) { return is_kept(entry, text, index); });
  fit_travel(text, options.channel, described->entries, user);
  const auto config = write_entries(options, "describe", text, described->entries);
  if (!config) return tl::unexpected(config.error());
  Json found;
  for (const Entry& entry : described->entries) {
    user.show(entry.key() + " = " + entry.literal + "  (" + entry.reason + ")");
    found[entry.key()] = entry.literal;
  }
  found["feasibility"] = feasibility_json(config->settings, index);
  for (const std::string& line : config::describe_feasibility(config->settings, index))
    user.show(line);
  for (const std::string& line : config::advice(*config))
    user.show("advice: " + line);
  return found;
}

}  // namespace

Result<Json> describe_step(const SetupOptions& options, Operator& user) {
  const auto text = read_board_text(options.config);
  if (!text) return tl::unexpected(text.error());
  const auto joint = joint_in_file(*text, options.channel);
  BoardRanges ranges = board_ranges(*text, options.channel);
  if (joint) ranges.max_position_m = NAN;
  Result<DescribeAnswers> answers;
  const bool asks = options.script.empty();
  if (!asks) {
    const auto script = read_script(options.script);
    if (!script) return tl::unexpected(script.error());
    answers = complete_script(*script, options, ranges);
  }
  if (joint) show_joint_measurement(*joint, user);
  if (asks) {
    auto record = SetupRecord::open(options.config, options.channel);
    if (!record) return failure(record.error().text() + "\n");
    answers = ask_questions(ranges, *record, user);
  }
  if (!answers) return tl::unexpected(answers.error());
  auto written = write_description(*answers, options, *text, user);
  if (!written && asks)
    user.show("the answers are kept: " + options.command("describe") + " offers them again");
  return written;
}

}  // namespace supercoil::operating
