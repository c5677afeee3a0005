// Files that grow by a line when a run ends, so that an interrupted comparison can go on.
#pragma once

#include <charconv>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "supercoil/hal/error.hpp"

namespace supercoil::host_sim::batch {

/// Part number of all, from 1 on: every so-manieth run.
struct Shard {
  std::int64_t number = 1;
  std::int64_t of = 1;
};

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
using TakeLine = std::function<Result<void>(std::string_view line, const std::string& where)>;

/// Reads what follows the head. True: the last line was torn, and is left out. A file with another
/// head, and what take refuses, are errors. An absent file has no lines.
Result<bool> read_lines(const std::filesystem::path& path, const std::string& head,
                        const TakeLine& take);

/// Adds what a file has. True: its last line is torn. The error names the file.
using AddPart = std::function<Result<bool>(const std::filesystem::path& part)>;

/// Adds each part of a whole, which must be there and not torn, and what the whole's own file had
/// before, if it is there: merging loses nothing.
Result<void> add_parts(const std::vector<std::string>& parts, const std::filesystem::path& own,
                       const AddPart& add);

}  // namespace supercoil::host_sim::batch
