// Words of a line of text.
#pragma once

#include <algorithm>
#include <string_view>

namespace supercoil {

/// The next word, cut off from the text; empty at its end.
inline std::string_view next_word(std::string_view& text) {
  const std::size_t from = std::min(text.find_first_not_of(" \t\r\n"), text.size());
  const std::size_t to = std::min(text.find_first_of(" \t\r\n", from), text.size());
  const std::string_view word = text.substr(from, to - from);
  text.remove_prefix(to);
  return word;
}

}  // namespace supercoil
