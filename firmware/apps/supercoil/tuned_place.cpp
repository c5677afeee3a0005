#include "apps/supercoil/tuned_place.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

namespace supercoil::operating {

namespace {

std::optional<std::size_t> number_of(std::string_view word) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  const bool whole = error == std::errc{} && end == word.data() + word.size();
  return whole ? std::optional(number) : std::nullopt;
}

bool is_estimator(std::string_view word) {
  if (const auto number = number_of(word)) return *number >= first_estimator_place;
  return std::ranges::any_of(control::estimator_names,
                             [&](const auto& known) { return known.first == word; });
}

}  // namespace

std::string places_text(const std::vector<std::string>& kinds) {
  std::string all;
  for (std::size_t i = 0; i < kinds.size(); ++i)
    all += (i == 0 ? "" : ", ") + std::to_string(i) + " (" + kinds[i] + ")";
  return all;
}

ReadTunable tunable_reader(BoardLink& board, const std::string& channel) {
  return [&board, channel](int place, std::size_t tunable, TuningSet set) {
    return board.tuning(channel, place, tunable, set);
  };
}

Result<std::size_t> find_place(Tuned what, std::string_view word,
                               const std::vector<std::string>& kinds) {
  const std::string noun(name(what));
  const auto number = number_of(word);
  if (number && *number < kinds.size()) return *number;
  const auto found = std::ranges::find(kinds, word);
  const auto of_kind = std::ranges::count(kinds, word);
  if (of_kind == 1) return static_cast<std::size_t>(found - kinds.begin());
  if (of_kind > 1) {
    return failure("several " + noun + "s are " + std::string(word) +
                       ": write the number; there are " + places_text(kinds),
                   std::errc::invalid_argument);
  }
  return failure("there is no " + noun + " " + std::string(word) +
                     (kinds.empty()       ? ""
                      : kinds.size() == 1 ? "; there is "
                                          : "; there are ") +
                     places_text(kinds),
                 std::errc::invalid_argument);
}

Result<std::size_t> find_place(Tuned what, std::string_view word, const ReadTunable& read_value) {
  return read_kinds(what, read_value).and_then([&](const std::vector<std::string>& kinds) {
    return find_place(what, word, kinds);
  });
}

Result<std::size_t> find_any_place(std::string_view word, const ReadTunable& read_value) {
  const Tuned what = is_estimator(word) ? Tuned::estimator : Tuned::controller;
  const auto number = number_of(word);
  const std::string among_its_like = what == Tuned::estimator && number
                                         ? std::to_string(*number - first_estimator_place)
                                         : std::string(word);
  return find_place(what, among_its_like, read_value).map([&](std::size_t place) {
    return static_cast<std::size_t>(place_of(what, place));
  });
}

}  // namespace supercoil::operating
