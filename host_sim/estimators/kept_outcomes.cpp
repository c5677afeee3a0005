#include "estimators/kept_outcomes.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "batch/kept_lines.hpp"

namespace supercoil::host_sim::estimators {

namespace {

using control::Theta;

constexpr std::size_t key_columns = 3;
constexpr std::array figures{&Outcome::to_5_percent_s, &Outcome::to_1_percent_s,
                             &Outcome::back_to_5_percent_s, &Outcome::steady_rms,
                             &Outcome::reported_rms};
constexpr std::array curves{&Outcome::squares_from_rest, &Outcome::squares_after_change};

std::size_t columns() {
  return key_columns + 4 * (figures.size() + curves.size() * plotted_s().size());
}

std::string head() {
  return "# supercoil-sim " SUPERCOIL_RELEASE
         " estimators, a line a run; inf: never settled; empty: not told\n"
         "trial,estimator,seed: then theta1 to theta4 of each: to_5_percent_s, to_1_percent_s, "
         "back_to_5_percent_s, steady_rms, reported_rms, squares of the plotted errors\n";
}

std::string text(const Theta& values) {
  std::string line;
  for (const double value : values)
    line += "," + batch::number(value);
  return line;
}

template <class Kinds>
std::optional<std::size_t> place_of(const Kinds& kinds, std::string_view name) {
  const auto found = std::ranges::find_if(kinds, [&](const auto& one) { return one.name == name; });
  if (found == kinds.end()) return std::nullopt;
  return static_cast<std::size_t>(std::distance(kinds.begin(), found));
}

std::optional<std::pair<Key, Outcome>> read_line(std::string_view line) {
  const auto fields = batch::fields_of(line);
  if (fields.size() != columns()) return std::nullopt;
  const auto trial = place_of(trials, fields[0]);
  const auto contender = place_of(contenders, fields[1]);
  if (!trial || !contender) return std::nullopt;
  Key key{*trial, *contender, 0};
  bool right = batch::read(fields[2], key.seed);
  auto field = fields.begin() + key_columns;
  const auto next = [&] {
    Theta values;
    for (double& value : values)
      right = batch::read_number(*field++, value) && right;
    return values;
  };
  Outcome outcome;
  for (const auto figure : figures)
    outcome.*figure = next();
  for (const auto curve : curves) {
    for (std::size_t i = 0; i < plotted_s().size(); ++i)
      (outcome.*curve).push_back(next());
  }
  if (!right) return std::nullopt;
  return std::pair(key, std::move(outcome));
}

}  // namespace

std::string to_line(const Key& key, const Outcome& outcome) {
  std::string line = std::string(trials[key.trial].name) + "," +
                     std::string(contenders[key.contender].name) + "," + std::to_string(key.seed);
  for (const auto figure : figures)
    line += text(outcome.*figure);
  for (const auto curve : curves) {
    for (const Theta& squares : outcome.*curve)
      line += text(squares);
  }
  return line + "\n";
}

std::string to_file(const Outcomes& outcomes) {
  std::string file = head();
  for (const auto& [key, outcome] : outcomes)
    file += to_line(key, outcome);
  return file;
}

Result<ReadOutcomes> read_outcomes(const std::filesystem::path& path) {
  ReadOutcomes read;
  const auto torn = batch::read_lines(
      path, head(), [&](std::string_view line, const std::string& where) -> Result<void> {
        auto one = read_line(line);
        if (!one) {
          return failure(where + "is damaged: must have a trial, an estimator and " +
                         std::to_string(columns() - 2) + " numbers");
        }
        read.outcomes.insert(std::move(*one));
        return {};
      });
  if (!torn) return tl::unexpected(torn.error());
  read.torn = *torn;
  return read;
}

}  // namespace supercoil::host_sim::estimators
