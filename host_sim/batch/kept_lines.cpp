#include "batch/kept_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <system_error>

namespace supercoil::host_sim::batch {

std::string number(double value) {
  if (std::isnan(value)) return {};
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

bool read_number(std::string_view text, double& value) {
  value = NAN;
  return text.empty() || read(text, value);
}

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  for (std::size_t comma = 0; comma != std::string_view::npos;) {
    comma = line.find(',');
    fields.push_back(line.substr(0, comma));
    line.remove_prefix(comma == std::string_view::npos ? line.size() : comma + 1);
  }
  return fields;
}

Result<bool> read_lines(const std::filesystem::path& path, const std::string& head,
                        const TakeLine& take) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (!std::filesystem::exists(status)) return false;
  if (!std::filesystem::is_regular_file(status)) return failure(path.string() + ": is not a file");
  std::ifstream in(path, std::ios::binary);
  std::string begin(head.size(), '\0');
  in.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(in.gcount()));
  if (begin.size() < head.size() && head.starts_with(begin) && !in.bad()) return !begin.empty();
  if (begin != head) {
    return failure(path.string() + ":1: is of another version or definition: it begins \"" +
                   begin.substr(0, std::min(begin.find('\n'), std::size_t{80})) + "\"; must be \"" +
                   head.substr(0, head.find('\n')) + "\". Choose another --out, or delete it");
  }
  // Line by line: a file may be larger than memory.
  auto number = 1 + std::ranges::count(head, '\n');
  for (std::string line; std::getline(in, line); ++number) {
    if (in.eof()) return true;
    const auto taken = take(line, path.string() + ":" + std::to_string(number) + ": ");
    if (!taken) return tl::unexpected(taken.error());
  }
  if (in.bad()) return failure(path.string() + ": cannot be read");
  return false;
}

Result<void> add_parts(const std::vector<std::string>& parts, const std::filesystem::path& own,
                       const AddPart& add) {
  std::vector<std::filesystem::path> files(parts.begin(), parts.end());
  for (const std::filesystem::path& file : files) {
    if (!std::filesystem::exists(file)) return failure(file.string() + ": there is no such file");
  }
  files.push_back(own);
  for (const std::filesystem::path& file : files) {
    const auto torn = add(file);
    if (!torn) return tl::unexpected(torn.error());
    if (*torn) {
      return failure(file.string() +
                     ": its last line is incomplete: the run was interrupted; resume it first");
    }
  }
  return {};
}

}  // namespace supercoil::host_sim::batch
