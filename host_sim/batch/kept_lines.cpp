#include "batch/kept_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
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

tl::expected<bool, std::string> read_lines(const std::filesystem::path& path,
                                           const std::string& head, const TakeLine& take) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (!std::filesystem::exists(status)) return false;
  if (!std::filesystem::is_regular_file(status))
    return tl::unexpected(path.string() + ": is not a file");
  std::ifstream in(path, std::ios::binary);
  const std::string all{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in.good() && !in.eof()) return tl::unexpected(path.string() + ": cannot be read");
  if (all.size() < head.size() && head.starts_with(all)) return !all.empty();
  if (!all.starts_with(head)) {
    return tl::unexpected(path.string() + ":1: is not of this version: it begins \"" +
                          all.substr(0, std::min(all.find('\n'), std::size_t{80})) +
                          "\"; must be \"" + head.substr(0, head.find('\n')) +
                          "\". Choose another --out, or delete it");
  }
  std::string_view rest = std::string_view(all).substr(head.size());
  for (auto line = 1 + std::ranges::count(head, '\n'); !rest.empty(); ++line) {
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos) return true;
    const auto taken = take(rest.substr(0, end), path.string() + ":" + std::to_string(line) + ": ");
    if (!taken) return tl::unexpected(taken.error());
    rest.remove_prefix(end + 1);
  }
  return false;
}

tl::expected<void, std::string> add_parts(const std::vector<std::string>& parts,
                                          const std::filesystem::path& own, const AddPart& add) {
  std::vector<std::filesystem::path> files(parts.begin(), parts.end());
  for (const std::filesystem::path& file : files) {
    if (!std::filesystem::exists(file))
      return tl::unexpected(file.string() + ": there is no such file");
  }
  files.push_back(own);
  for (const std::filesystem::path& file : files) {
    const auto torn = add(file);
    if (!torn) return tl::unexpected(torn.error());
    if (*torn) {
      return tl::unexpected(
          file.string() + ": its last line is torn: the run was interrupted; go on with it first");
    }
  }
  return {};
}

}  // namespace supercoil::host_sim::batch
