#include "campaign/results.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <ostream>
#include <string_view>
#include <utility>

#include "batch/kept_lines.hpp"

namespace supercoil::host_sim::campaign {

namespace {

std::string hexadecimal(std::uint32_t value) {
  std::array<char, 8> digits{};
  constexpr int base = 16;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value, base).ptr;
  return {digits.data(), end};
}

bool same(const Outcome& one, const Outcome& other) {
  return one.refused == other.refused && one.fault == other.fault &&
         std::ranges::equal(one.values, other.values, [](double x, double y) {
           return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
         });
}

std::optional<Key> read_key(const std::vector<std::string_view>& fields, const Study& study) {
  Key key;
  std::uint64_t number = 0;
  const auto contender = std::ranges::find(study.contenders, fields[1], &compare::Document::name);
  const bool one_lot = study.sampling == Sampling::latin_hypercube;
  const auto last = static_cast<std::uint64_t>(one_lot ? study.runs : max_runs);
  if (!batch::read(fields[0], number) || contender == study.contenders.end()) return std::nullopt;
  if (number < 1 || number > last) return std::nullopt;
  key.run = static_cast<std::size_t>(number) - 1;
  key.contender = static_cast<std::size_t>(contender - study.contenders.begin());
  return key;
}

/// For a field of a table.
std::string without_commas(std::string text) {
  for (char& c : text) {
    if (c == ',') c = ';';
    if (c == '\n' || c == '\r') c = ' ';
  }
  return text;
}

double ratio(double value, double max) {
  if (std::isnan(value)) return INFINITY;
  if (value <= max) return max > 0.0 ? value / max : 0.0;
  return max > 0.0 ? value / max : INFINITY;
}

}  // namespace

std::string origin_of(const Study& study) {
  return "supercoil-sim " SUPERCOIL_RELEASE " campaign " + study.name + ", definition " +
         hexadecimal(study.definition);
}

std::string Lines::head() const {
  std::string text = "# " + origin_of(*study_) +
                     ", a line a run; inf: no longer followed, or never settled\nrun,contender";
  for (const Draw& draw : study_->draws)
    text += "," + draw.name;
  text += ",refused,fault";
  for (std::size_t i = 0; i < quantity_count; ++i)
    text += "," + std::string(quantity(i).name);
  return text + "\n";
}

std::string Lines::begin_of(const Key& key) const {
  std::string text =
      std::to_string(key.run + 1) + "," + study_->contenders[key.contender].name + ",";
  const auto drawn = draws_->of_run(key.run);
  for (std::size_t i = 0; i < drawn.size(); ++i)
    text += text_of(study_->draws[i], drawn[i]) + ",";
  return text;
}

std::string Lines::line(const Key& key, const Outcome& outcome) const {
  std::string text = begin_of(key) + outcome.refused + "," + outcome.fault;
  for (const double value : outcome.values)
    text += "," + batch::number(value);
  return text + "\n";
}

void Lines::write(std::ostream& out, const Outcomes& outcomes) const {
  out << head();
  for (const auto& [key, outcome] : outcomes)
    out << line(key, outcome);
}

Result<bool> Lines::read(const std::filesystem::path& path, Outcomes& into) const {
  const std::size_t before = 2 + study_->draws.size();
  const std::size_t columns = before + 2 + quantity_count;
  const auto take = [&](std::string_view text, const std::string& where) -> Result<void> {
    const auto damaged = [&](const std::string& why) {
      return failure(where + "is damaged: " + why + ": " + std::string(text));
    };
    const auto fields = batch::fields_of(text);
    if (fields.size() != columns)
      return damaged("must have " + std::to_string(columns) + " fields");
    const auto key = read_key(fields, *study_);
    if (!key) return damaged("there is no such run");
    if (!text.starts_with(begin_of(*key)))
      return damaged("the study draws other values for this run");
    Outcome outcome{std::string(fields[before]), std::string(fields[before + 1]), {}};
    for (std::size_t i = 0; i < quantity_count; ++i) {
      if (!batch::read_number(fields[before + 2 + i], outcome.values[i]))
        return damaged(std::string(quantity(i).name) + " must be a number");
    }
    const auto [entry, is_new] = into.try_emplace(*key, outcome);
    if (!is_new && !same(entry->second, outcome)) {
      return failure(where + "run " + std::to_string(key->run + 1) + " gave another result before");
    }
    return {};
  };
  return batch::read_lines(path, head(), take);
}

std::optional<Outcome> carry_out(const Study& study, const Draws& draws, const Key& key,
                                 const std::atomic<bool>& stop) {
  const auto scenario = draws.scenario(draws.of_run(key.run), key.contender, key.run);
  if (scenario) return simulate(*scenario, study.window, stop);
  Outcome refused;
  const Error& first = scenario.error().front();
  refused.refused = without_commas((first.key.empty() ? "" : first.key + ": ") + first.message);
  refused.values.fill(NAN);
  return refused;
}

double severity(const Study& study, const Outcome& outcome) {
  double worst = 0.0;
  for (const Goal& goal : study.goals)
    worst = std::fmax(worst, ratio(outcome.values.at(goal.quantity), goal.max));
  return worst;
}

}  // namespace supercoil::host_sim::campaign
