// supercoil tune: a controller's values, read, changed and stored on a running board.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <nlohmann/json.hpp>

#include "apps/supercoil/board_link.hpp"
#include "apps/supercoil/commands.hpp"
#include "apps/supercoil/tuning_table.hpp"
#include "text/command_text.hpp"
#include "text/nearest.hpp"

namespace supercoil::operating {

namespace {

using control::Tunable;
using OrWhy = tl::expected<void, std::string>;

struct Assignment {
  std::size_t tunable;
  double value;
};

tl::expected<std::vector<Assignment>, std::string> parse(const std::vector<std::string>& words) {
  std::vector<std::string> known;
  for (const Tunable& tunable : control::tunables())
    known.emplace_back(tunable.name);
  std::vector<Assignment> all;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos) return tl::unexpected(word + ": write NAME=VALUE");
    const std::string name = word.substr(0, equals);
    const std::size_t tunable = control::tunable_named(name);
    if (tunable == control::tunable_count)
      return tl::unexpected(name + " cannot be tuned; " + meant_or_all(name, known, "there are"));
    const auto value = tuning_value(control::tunables()[tunable], word.substr(equals + 1));
    if (!value) return tl::unexpected(value.error());
    all.push_back({tunable, *value});
  }
  // What there is depends on the kind, and the poles on the model: as in tunables().
  std::ranges::stable_sort(all, {}, &Assignment::tunable);
  return all;
}

void print(int place, const TunedValues& all) {
  const Tunable& kind = control::tunables()[0];
  const auto in_use = static_cast<std::size_t>(TuningSet::in_use);
  std::printf("controller %d: %s\n", place, tuning_text(kind, all.at(0)[in_use]).c_str());
  std::printf("  %-28s %12s %12s %12s %12s\n", "", "in use", "configured", "stored", "prepared");
  for (const auto& one : all) {
    const Tunable& t = control::tunables()[one.first];
    const auto text = [&](TuningSet set) {
      return tuning_text(t, one.second[static_cast<std::size_t>(set)]);
    };
    const std::string configured = text(TuningSet::configured);
    const bool differs =
        text(TuningSet::in_use) != configured || text(TuningSet::stored) != configured;
    std::printf("%c %-28s %12s %12s %12s %12s\n", differs ? '*' : ' ', t.name.data(),
                text(TuningSet::in_use).c_str(), configured.c_str(),
                text(TuningSet::stored).c_str(), text(TuningSet::prepared).c_str());
  }
}

class Tuning {
 public:
  Tuning(BoardLink& board, const TuneOptions& options) : board_(&board), options_(&options) {}

  OrWhy change(const std::vector<Assignment>& assignments) {
    if (auto begun = prepare("all", options_->from); !begun) return begun;
    for (const Assignment& one : assignments) {
      const Tunable& tunable = control::tunables()[one.tunable];
      std::array<char, 32> text{};
      std::snprintf(text.data(), text.size(), "%.17g", one.value);
      if (auto done = prepare(std::string(tunable.name), text.data()); !done) return done;
    }
    return options_->only_prepare ? OrWhy{}
                                  : ask(channel() + " tune " + std::to_string(options_->place));
  }
  OrWhy ask(const std::string& line) { return judge(line, board_->ask(line)); }

  /// All controllers.
  OrWhy tell() {
    const auto controllers = read_tuning([this](int place, std::size_t tunable, TuningSet set) {
      return board_->tuning(channel(), place, tunable, set);
    });
    if (!controllers) return tl::unexpected(controllers.error());
    if (options_->json) {
      std::printf("%s\n", tuning_json(*controllers).dump().c_str());
      return {};
    }
    int place = 0;
    for (const TunedValues& controller : *controllers)
      print(place++, controller);
    return {};
  }

 private:
  std::string channel() const { return std::to_string(options_->channel); }
  OrWhy prepare(const std::string& name, const std::string& value) {
    return judge(name + " = " + value, board_->prepare(channel(), options_->place, name, value));
  }
  static OrWhy judge(const std::string& what, const BoardLink::Answer& answer) {
    if (!answer) return tl::unexpected(answer.error());
    if (*answer == "ok") return {};
    const bool unsuitable = *answer == answer_text(Refusal::unsuitable, NAN);
    return tl::unexpected(what + ": " + *answer +
                          (unsuitable ? ": unstable on the muscle that is known, or values that "
                                        "contradict each other; nothing changed"
                                      : ""));
  }

  BoardLink* board_;
  const TuneOptions* options_;
};

}  // namespace

int tune_command(const TuneOptions& options) {
  const auto assignments = parse(options.assignments);
  if (!assignments) return refuse(options.json, exit_wrong_input, assignments.error());
  const auto board = open_link(options.can, options.socket);
  if (!board) return refuse(options.json, exit_failed, board.error());
  Tuning tuning(**board, options);
  OrWhy done;
  const bool changes = !assignments->empty() || options.from != "in_use";
  if (changes) done = tuning.change(*assignments);
  const std::string channel = std::to_string(options.channel);
  if (done && options.store) done = tuning.ask(channel + " store tuning");
  if (done && options.clear) done = tuning.ask(channel + " clear tuning");
  if (done) done = tuning.tell();
  return done ? exit_done : refuse(options.json, exit_failed, done.error());
}

}  // namespace supercoil::operating
