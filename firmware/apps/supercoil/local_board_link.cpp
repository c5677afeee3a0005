// The supercoild of this board, through its socket.
#include <array>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include <nlohmann/json.hpp>

#include "apps/common/state_words.hpp"
#include "apps/supercoil/board_link.hpp"
#include "loop/snapshot.hpp"
#include "text/command_text.hpp"

namespace supercoil::operating {

namespace {

using StateWords = std::array<std::string, state_words.size()>;

Result<StateWords> words_of(const std::string& line) {
  StateWords words;
  std::istringstream text(line);
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (!(text >> words[i]) && i < state_controller) return failure("state: " + line);
  }
  return words;
}

}  // namespace

BoardLink::Answer LocalBoardLink::ask(const std::string& line) {
  return socket_.ask(line).map(unmarked);
}

BoardLink::Answer LocalBoardLink::line_of(const std::string& request, const std::string& channel) {
  const auto lines = socket_.ask(request);
  if (!lines) return tl::unexpected(lines.error());
  if (is_wrong_line(*lines)) return failure(unmarked(*lines));
  std::istringstream text(*lines);
  std::size_t channels = 0;
  for (std::string line; std::getline(text, line); ++channels) {
    if (line.starts_with(channel + " ")) return line;
  }
  const auto known = parse_channel(channel, channels);
  if (!known) return tl::unexpected(known.error());
  return failure("nothing is known about channel " + channel);
}

BoardLink::Answer LocalBoardLink::state_json() {
  auto lines = state();
  if (!lines) return lines;
  using Json = nlohmann::ordered_json;
  Json channels = Json::array();
  std::istringstream text(*lines);
  for (std::string line; std::getline(text, line);) {
    const auto words = words_of(line);
    if (!words) return tl::unexpected(words.error());
    Json channel;
    for (std::size_t i = 0; i < words->size(); ++i) {
      const std::string key(state_words[i]);
      const std::string& word = (*words)[i];
      if (word.empty()) continue;
      if (i == 0 || i == state_controller) {
        channel[key] = std::stoi(word);
      } else if (i >= state_first_number && i <= state_progress) {
        const double value = std::strtod(word.c_str(), nullptr);
        channel[key] = std::isfinite(value) ? Json(value) : Json(nullptr);
      } else if (i == state_slack) {
        channel[key] = word == "slack";
      } else if (i == state_controller_kind) {
        channel[key] = word == "-" ? Json(nullptr) : Json(word);
      } else {
        channel[key] = i == state_notes && word == "-" ? "" : word;
      }
    }
    channels.push_back(channel);
  }
  return Json{{"channels", channels}}.dump() + "\n";
}

Result<BoardLink::Status> LocalBoardLink::status(const std::string& channel) {
  const auto line = line_of("status", channel);
  if (!line) return tl::unexpected(line.error());
  Status status;
  std::string number, probing;
  if (!(std::istringstream(*line) >> number >> status.state >> status.fault >> probing))
    return failure("status: " + *line);
  status.probing = probing == "probing";
  return status;
}

Result<BoardLink::Ending> LocalBoardLink::ending(const std::string& channel) {
  const auto words = line_of("state", channel).and_then(words_of);
  if (!words) return tl::unexpected(words.error());
  const std::string& notes = (*words)[state_notes];
  return Ending{(*words)[state_result], notes == "-" ? "" : notes};
}

Result<board::SenseComparison> LocalBoardLink::senses(const std::string& channel) {
  const auto line = line_of("senses", channel);
  if (!line) return tl::unexpected(line.error());
  board::SenseComparison senses;
  std::istringstream text(line->substr(channel.size()));
  if (text >> senses.supply_gain >> senses.current_gain >> senses.error_ratio) return senses;
  return failure("senses: " + *line);
}

Result<KnownMuscle> LocalBoardLink::muscle(const std::string& channel) {
  const auto line = line_of("muscle", channel);
  if (!line) return tl::unexpected(line.error());
  KnownMuscle known;
  known.fill(NAN);  // for what an older board does not report
  std::istringstream words(line->substr(channel.size()));
  std::size_t count = 0;
  for (std::string word; count < known.size() && words >> word; ++count)
    known[count] = std::strtod(word.c_str(), nullptr);  // streams do not read nan
  if (count <= known_unexplained_ratio) return failure("muscle: " + *line);
  return known;
}

Result<double> LocalBoardLink::tuning(const std::string& channel, int place, std::size_t tunable,
                                      TuningSet set) {
  const std::string name(control::tunables()[tunable].name);
  const auto answer =
      socket_.ask("tuning " + channel + " " + std::to_string(place) + " " + name + " " +
                  std::string(tuning_set_names[static_cast<std::size_t>(set)]));
  if (!answer) return tl::unexpected(answer.error());
  char* end = nullptr;
  const double value = std::strtod(answer->c_str(), &end);
  if (is_wrong_line(*answer)) return failure(unmarked(*answer), std::errc::invalid_argument);
  if (end == answer->c_str()) return failure("tuning: " + *answer);
  return value;
}

BoardLink::Answer LocalBoardLink::prepare(const std::string& channel, int place,
                                          const std::string& name, const std::string& value) {
  return socket_.ask("prepare " + channel + " " + std::to_string(place) + " " + name + " " + value)
      .map(unmarked);
}

Result<double> LocalBoardLink::error_m(const std::string& channel) {
  const auto words = line_of("state", channel).and_then(words_of);
  if (!words) return tl::unexpected(words.error());
  if ((*words)[state_mode] != mode_names[static_cast<std::size_t>(Mode::position)]) return NAN;
  return std::strtod((*words)[state_position].c_str(), nullptr) -
         std::strtod((*words)[state_model].c_str(), nullptr);
}

Result<double> LocalBoardLink::position_m(const std::string& channel) {
  return line_of("state", channel).and_then(words_of).map([](const StateWords& words) {
    return std::strtod(words[state_position].c_str(), nullptr);
  });
}

Result<double> LocalBoardLink::progress(const std::string& channel) {
  return line_of("state", channel).and_then(words_of).map([](const StateWords& words) {
    return std::strtod(words[state_progress].c_str(), nullptr);
  });
}

}  // namespace supercoil::operating
