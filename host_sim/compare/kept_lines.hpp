// Files that grow by a line when a run ends, so that an interrupted comparison can go on.
#pragma once

#include <charconv>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

namespace supercoil::host_sim::compare {

/// The shortest text that reads back as the same value; nothing for NaN.
std::string number(double value);

/// All of the text. base: for integers.
template <class Value, class... Base>
bool read(std::string_view text, Value& value, Base... base) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base...);
  return error == std::errc{} && end == text.data() + text.size();
}
/// As number() writes it.
bool read_number(std::string_view text, double& value);

std::vector<std::string_view> fields_of(std::string_view line);

/// Takes one line; where: "FILE:LINE: ", for errors.
using TakeLine =
    std::function<tl::expected<void, std::string>(std::string_view line, const std::string& where)>;

/// Reads what follows the head. True: the last line was torn, and is left out. A file with another
/// head, and what take refuses, are errors. An absent file has no lines.
tl::expected<bool, std::string> read_lines(const std::filesystem::path& path,
                                           const std::string& head, const TakeLine& take);

}  // namespace supercoil::host_sim::compare
