// Files that grow by a line whenever a run ends, so that an interrupted comparison can be resumed.
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

/// One of `count` equal parts of all runs, numbered from 1: every `count`-th run.
struct Shard {
  std::int64_t number = 1;
  std::int64_t count = 1;
};

/// The shortest text that reads back as the same value; nothing for NaN.
std::string number(double value);

/// Reads a value from the whole text. base: for integers.
template <class Value, class... Base>
bool read(std::string_view text, Value& value, Base... base) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base...);
  return error == std::errc{} && end == text.data() + text.size();
}
/// Reads what number() wrote.
bool read_number(std::string_view text, double& value);

std::vector<std::string_view> fields_of(std::string_view line);

/// Takes one line; where: "FILE:LINE: ", for errors.
using TakeLine = std::function<Result<void>(std::string_view line, const std::string& where)>;

/// Reads the lines after the head. True: the last line was torn, and is left out. A different head
/// or a line that take refuses is an error. An absent file has no lines.
Result<bool> read_lines(const std::filesystem::path& path, const std::string& head,
                        const TakeLine& take);

/// Adds a file's contents. True: its last line is torn. The error names the file.
using AddPart = std::function<Result<bool>(const std::filesystem::path& part)>;

/// Adds all parts, which must exist and not be torn, and what the result's own file already has, if
/// it exists: merging loses nothing.
Result<void> add_parts(const std::vector<std::string>& parts, const std::filesystem::path& own,
                       const AddPart& add);

}  // namespace supercoil::host_sim::batch
