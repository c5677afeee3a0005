#include "compare/result.hpp"

#include <bit>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include "batch/kept_lines.hpp"

namespace supercoil::host_sim::compare {

namespace {

constexpr std::size_t key_columns = 4;
constexpr std::size_t columns = key_columns + 2 + measures.size();

std::string head() {
  std::string text = "# supercoil-sim " SUPERCOIL_RELEASE
                     " compare, a line a run; inf: no longer followed, or never settled\n"
                     "controller,disturbance,arithmetic,seed,definition,fault";
  for (const Measure& measure : measures)
    text += "," + std::string(measure.name);
  return text + "\n";
}

std::optional<std::pair<Key, Result>> read_line(std::string_view line) {
  const auto fields = batch::fields_of(line);
  if (fields.size() != columns) return std::nullopt;
  Key key{std::string(fields[0]), std::string(fields[1]), std::string(fields[2]), 0};
  Result result;
  constexpr int hexadecimal = 16;
  bool right =
      batch::read(fields[3], key.seed) && batch::read(fields[4], result.definition, hexadecimal);
  result.fault = fields[5];
  for (std::size_t i = 0; i < measures.size(); ++i) {
    const std::string_view field = fields[key_columns + 2 + i];
    right = right && batch::read_number(field, result.values[i]);
  }
  if (!right) return std::nullopt;
  return std::pair(std::move(key), std::move(result));
}

std::string described(const Key& key) {
  return key.controller + " with " + key.disturbance + " in " + key.arithmetic + ", seed " +
         std::to_string(key.seed);
}

}  // namespace

bool Result::same_as(const Result& other) const {
  bool same = definition == other.definition && fault == other.fault;
  for (std::size_t i = 0; i < values.size(); ++i) {
    same = same &&
           std::bit_cast<std::uint64_t>(values[i]) == std::bit_cast<std::uint64_t>(other.values[i]);
  }
  return same;
}

std::string to_line(const Key& key, const Result& result) {
  std::array<char, 16> definition{};
  constexpr int hexadecimal = 16;
  const auto end = std::to_chars(definition.data(), definition.data() + definition.size(),
                                 result.definition, hexadecimal)
                       .ptr;
  std::string line = key.controller + "," + key.disturbance + "," + key.arithmetic + "," +
                     std::to_string(key.seed) + "," + std::string(definition.data(), end) + "," +
                     result.fault;
  for (const double value : result.values)
    line += "," + batch::number(value);
  return line + "\n";
}

std::string to_file(const Results& results) {
  std::string text = head();
  for (const auto& [key, result] : results)
    text += to_line(key, result);
  return text;
}

supercoil::Result<ReadResults> read_results(const std::filesystem::path& path) {
  ReadResults read;
  const auto torn = batch::read_lines(
      path, head(),
      [&](std::string_view line, const std::string& where) -> supercoil::Result<void> {
        auto one = read_line(line);
        if (!one) {
          return failure(
              where + "is damaged: must have " + std::to_string(columns) +
              " fields, with numbers for the seed and the measures: " + std::string(line));
        }
        return merge(read.results, {std::move(*one)}, where);
      });
  if (!torn) return tl::unexpected(torn.error());
  read.torn = *torn;
  return read;
}

supercoil::Result<void> merge(Results& into, const Results& from, const std::string& name) {
  for (const auto& [key, result] : from) {
    const auto [entry, is_new] = into.try_emplace(key, result);
    if (!is_new && !entry->second.same_as(result)) {
      return failure(name + ": " + described(key) + " gave another result before");
    }
    Key first = key;
    first.seed = 0;
    const auto other = into.lower_bound(first);
    if (other->second.definition != result.definition) {
      return failure(name + ": " + described(key) + " was run with another definition than seed " +
                     std::to_string(other->first.seed));
    }
  }
  return {};
}

}  // namespace supercoil::host_sim::compare
