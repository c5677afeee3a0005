// supercoil doctor --compare-senses: leads a person with a meter through the comparison that the
// running firmware makes. All that protects is there; this only asks.
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <thread>

#include <unistd.h>

#include <nlohmann/json.hpp>

#include "apps/supercoil/answer_lines.hpp"
#include "apps/supercoil/board_link.hpp"
#include "apps/supercoil/commands.hpp"
#include "apps/supercoil/interrupted.hpp"
#include "board/meter_comparison.hpp"
#include "config/board_config.hpp"
#include "config/describe.hpp"

namespace supercoil::operating {

namespace {

using Clock = std::chrono::steady_clock;
using board::MeterComparison;
using Range = board::PowerBounds::Interval;
/// The error: why it ended.
template <class Value>
using OrEnded = tl::expected<Value, std::string>;

constexpr std::chrono::milliseconds renewal{100};
constexpr std::chrono::milliseconds probing{300};
/// The board asks for a second at a steady power; a meter needs some time as well.
constexpr std::chrono::milliseconds settling{2500};
constexpr std::chrono::minutes max_question{5};
constexpr int max_tries = 3;

struct Plan {
  std::string channel;
  double power_W = 0.0;
  Range supply_V{0.0, 60.0};
};

std::string shown(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}

/// Arms and heats one channel, and makes it cold again however this ends.
class Heated {
 public:
  Heated(BoardLink& board, std::string channel) : board_(&board), channel_(std::move(channel)) {}
  Heated(const Heated&) = delete;
  Heated& operator=(const Heated&) = delete;
  ~Heated() {
    static_cast<void>(ask("rest"));
    if (const auto off = ask("disarm"); !off) fail(exit_failed, off.error());
  }

  OrEnded<void> ask(const std::string& what) {
    const auto answer = board_->ask(channel_ + " " + what);
    if (!answer) return tl::unexpected(answer.error());
    if (*answer != "ok") return tl::unexpected(what + ": " + *answer);
    return {};
  }
  OrEnded<void> heat(double power_W) {
    if (interrupted != 0) return tl::unexpected<std::string>("interrupted");
    return ask("power " + shown(power_W));
  }

 private:
  BoardLink* board_;
  std::string channel_;
};

/// The questions at one power after the other.
class Guide {
 public:
  Guide(Plan plan, Heated& heated, std::FILE* out)
      : plan_(std::move(plan)), heated_(&heated), out_(out) {}

  OrEnded<void> at(double power_W) {
    power_W_ = power_W;
    std::fprintf(out_, "Channel %s gets %s W.\n", plan_.channel.c_str(), shown(power_W).c_str());
    for (const auto end = Clock::now() + settling; Clock::now() < end;) {
      if (auto heated = heated_->heat(power_W_); !heated) return heated;
      std::this_thread::sleep_for(renewal);
    }
    const auto meter_V = ask("volts at the supply terminals", plan_.supply_V);
    if (!meter_V) return tl::unexpected(meter_V.error());
    if (auto taken = tell("compare_supply", *meter_V); !taken) return taken;
    // The measured power is the product of both senses, and each may be off by its gain.
    const double reported_A = power_W_ / *meter_V;
    const auto meter_A = ask("amperes in the line of channel " + plan_.channel,
                             {reported_A * MeterComparison::min_gain * MeterComparison::min_gain,
                              reported_A * MeterComparison::max_gain * MeterComparison::max_gain});
    if (!meter_A) return tl::unexpected(meter_A.error());
    return tell("compare_current", *meter_A);
  }

 private:
  OrEnded<void> tell(const std::string& verb, double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), " %.9g", value);
    auto taken = heated_->ask(verb + text.data());
    if (taken) return taken;
    return tl::unexpected(
        taken.error() +
        ". This reading and the others do not fit one another, the senses or the "
        "configured resistance; the board has forgotten them and uses what it used before");
  }

  OrEnded<double> ask(const std::string& question, const Range& allowed) {
    for (int i = 0; i < max_tries; ++i) {
      const auto line = answer_to(question);
      if (!line) return tl::unexpected(line.error());
      double value = 0.0;
      const auto [end, error] = std::from_chars(line->data(), line->data() + line->size(), value);
      const bool is_number = error == std::errc{} && end == line->data() + line->size();
      if (is_number && value >= allowed.min && value <= allowed.max) return value;
      std::fprintf(out_, "'%s' is refused: here it must be a number from %s to %s\n", line->c_str(),
                   shown(allowed.min).c_str(), shown(allowed.max).c_str());
    }
    return tl::unexpected("no allowed " + question + " in " + std::to_string(max_tries) +
                          " answers");
  }

  OrEnded<std::string> answer_to(const std::string& question) {
    std::fprintf(out_, "%s: ", question.c_str());
    std::fflush(out_);
    const auto deadline = Clock::now() + max_question;
    while (Clock::now() < deadline) {
      if (auto heated = heated_->heat(power_W_); !heated) return tl::unexpected(heated.error());
      if (auto line = answers_.wait(renewal)) return *line;
      // Ctrl-C may come with the end of the answers, while the board was asked.
      if (answers_.ended())
        return tl::unexpected<std::string>(interrupted != 0 ? "interrupted" : "nobody answers");
    }
    return tl::unexpected<std::string>("no answer within 5 minutes");
  }

  Plan plan_;
  Heated* heated_;
  std::FILE* out_;
  double power_W_ = 0.0;
  AnswerLines answers_{STDIN_FILENO};
};

/// The steady power that leaves full power allowed in the warmest air, were the muscle cooled by a
/// quarter of the least that is configured and the senses as wrong as nobody would notice.
double safe_power_W(ChannelSettings channel, const BoardSettings& board) {
  channel.senses = {};
  const double unseen = power_bounds(channel, board).true_over_measured().max;
  const double rise_K = channel.limiter.derate_from_C - channel.thermal.air.warmest_C;
  const double true_W = rise_K * 0.25 * channel.thermal.bounds.min_transfer_W_per_K;
  return std::min(channel.limiter.max_W, std::max(0.0, true_W) / unseen);
}

/// Which channel of the file is meant: over CAN it is a node. 0: none.
std::size_t channel_of(const DoctorOptions& options, const config::BoardConfig& config) {
  const int first = options.can.empty() || !config.can ? 1 : config.can->first_node;
  const int index = options.channel - first;
  const auto known = static_cast<int>(config.settings.channels.size());
  return index >= 0 && index < known ? static_cast<std::size_t>(index) + 1 : 0;
}

OrEnded<board::SenseComparison> compare(BoardLink& board, const Plan& plan, std::FILE* out) {
  Heated heated(board, plan.channel);
  if (const auto armed = heated.ask("arm"); !armed) return tl::unexpected(armed.error());
  // The probe of arming refuses to be disturbed.
  std::this_thread::sleep_for(probing);
  Guide guide(plan, heated, out);
  for (const double part : {0.5, 1.0}) {
    if (const auto asked = guide.at(part * plan.power_W); !asked)
      return tl::unexpected(asked.error());
  }
  auto found = board.senses(plan.channel);
  if (found && !found->compared())
    return tl::unexpected<std::string>("the board has no comparison");
  return found;
}

int concluded(const OrEnded<board::SenseComparison>& found, const Plan& plan, bool json,
              const std::string& bounds) {
  if (json) {
    nlohmann::ordered_json told{{"channel", std::stoi(plan.channel)}, {"power_W", plan.power_W}};
    if (found) {
      told["supply_gain"] = found->supply_gain;
      told["current_gain"] = found->current_gain;
      told["error_ratio"] = found->error_ratio;
      told["bounds"] = bounds;
    } else {
      told["error"] = found.error();
    }
    std::printf("%s\n", told.dump(2).c_str());
  }
  if (!found) return fail(exit_failed, found.error());
  if (!json) {
    std::printf("true over measured: supply %.4f, current %.4f; %s %% may remain of each\n%s\n",
                found->supply_gain, found->current_gain, shown(100.0 * found->error_ratio).c_str(),
                bounds.c_str());
  }
  return exit_done;
}

}  // namespace

int compare_senses(const DoctorOptions& options) {
  const auto config = config::read_board_config(options.config);
  if (!config && options.power_W <= 0.0) {
    std::fputs(config::to_text(config.error()).c_str(), stderr);
    return exit_wrong_input;
  }
  const std::size_t place = config ? channel_of(options, *config) : 0;
  if (config && place == 0) {
    return fail(exit_wrong_input,
                options.config + " has no channel " + std::to_string(options.channel));
  }
  Plan plan{std::to_string(options.channel), options.power_W};
  if (config) {
    const BoardSettings& board = config->settings;
    plan.supply_V = {board.supervision.min_supply_V, board.supervision.max_supply_V};
    if (plan.power_W <= 0.0) plan.power_W = safe_power_W(board.channels[place - 1], board);
  }
  std::FILE* out = options.json ? stderr : stdout;
  std::fprintf(out,
               "Compares the senses of channel %s with a meter. Arms the channel, heats it with "
               "%s W and then %s W, and asks two questions at each, for at most 5 minutes a "
               "question; then it is cold again. Ctrl-C ends it at any time.\n",
               plan.channel.c_str(), shown(0.5 * plan.power_W).c_str(),
               shown(plan.power_W).c_str());
  std::fflush(out);
  watch_for_interrupts();
  const auto board = open_link(options.can, options.socket);
  if (!board) return fail(exit_failed, board.error());
  const auto found = compare(**board, plan, out);
  std::string bounds;
  if (found && config) {
    ChannelSettings channel = config->settings.channels[place - 1];
    channel.senses = *found;
    const auto ratio = power_bounds(channel, config->settings).true_over_measured();
    bounds = "the true power is " + shown(ratio.min) + " to " + shown(ratio.max) +
             " times the measured power; calibrate and identify this channel again";
  }
  return concluded(found, plan, options.json, bounds);
}

}  // namespace supercoil::operating
