#include "supercoil/hal_linux/attribute.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>

namespace supercoil::hal_linux {

namespace {

/// -9223372036854775808 and a newline are 21 bytes; a text that fills this is not a number.
constexpr std::size_t max_number = 32;
/// sysfs gives one page.
constexpr std::size_t max_text = 4096;

int flags(Attribute::Use use) {
  // Without O_NONBLOCK, opening a pipe in the attribute's place would block for ever.
  switch (use) {
    case Attribute::Use::read:
      return O_RDONLY | O_NONBLOCK;
    case Attribute::Use::write:
      return O_WRONLY | O_NONBLOCK;
    case Attribute::Use::both:
      break;
  }
  return O_RDWR | O_NONBLOCK;
}

bool is_text(char c) {
  return (c >= ' ' && c <= '~') || c == '\n' || c == '\t';
}

std::string excerpt(const std::string& text) {
  constexpr std::size_t max_bytes = 40;
  return text.size() <= max_bytes ? "'" + text + "'" : "'" + text.substr(0, max_bytes) + "'…";
}

}  // namespace

Number parse_number(std::string_view text) noexcept {
  if (!text.empty() && text.back() == '\n') text.remove_suffix(1);
  Number number{0, hal::Status::ok};
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number.value);
  if (error != std::errc{} || rest != end) return {0, hal::Status::io_error};
  return number;
}

Result<Attribute> Attribute::open(const std::string& path, Use use) {
  auto file = open_file(path, flags(use));
  if (!file) return tl::unexpected(file.error());
  struct stat status {};
  if (::fstat(file->number(), &status) != 0) return failed_call("cannot examine " + path, errno);
  if (!S_ISREG(status.st_mode)) return failure(path + " is not a file");
  return Attribute(std::move(*file), path);
}

Number Attribute::number() const noexcept {
  std::array<char, max_number> buffer{};
  const Transfer got = read_start(file_, buffer.data(), buffer.size());
  if (got.status != hal::Status::ok) return {0, got.status};
  if (got.bytes == buffer.size()) return {0, hal::Status::io_error};
  return parse_number({buffer.data(), got.bytes});
}

hal::Status Attribute::write(std::int64_t value) const noexcept {
  std::array<char, max_number> buffer{};
  const auto written = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return write(
      std::string_view(buffer.data(), static_cast<std::size_t>(written.ptr - buffer.data())));
}

hal::Status Attribute::write(std::string_view text) const noexcept {
  return write_start(file_, text.data(), text.size());
}

Result<std::string> Attribute::text() const {
  std::string content(max_text + 1, '\0');
  errno = 0;
  const Transfer got = read_start(file_, content.data(), content.size());
  if (got.status != hal::Status::ok) {
    return errno == 0 ? failure(path_ + " is empty") : failed_call("cannot read " + path_, errno);
  }
  content.resize(got.bytes);
  if (content.size() > max_text) return failure(path_ + " is longer than a page");
  if (!std::all_of(content.begin(), content.end(), is_text)) return failure(path_ + " is not text");
  while (!content.empty() && content.back() == '\n')
    content.pop_back();
  return content;
}

Result<void> Attribute::set(std::string_view text) const {
  errno = 0;
  if (write(text) == hal::Status::ok) return {};
  const std::string what = "cannot write '" + std::string(text) + "' to " + path_;
  return errno == 0 ? failure(what + ": only part was accepted") : failed_call(what, errno);
}

Result<std::int64_t> Attribute::integer() const {
  const auto content = text();
  if (!content) return tl::unexpected(content.error());
  const Number number = parse_number(*content);
  if (number.status != hal::Status::ok) {
    return failure(path_ + " holds " + excerpt(*content) + ", which is not a whole number");
  }
  return number.value;
}

Result<std::string> read_text(const std::string& path) {
  return Attribute::open(path, Attribute::Use::read).and_then([](const Attribute& attribute) {
    return attribute.text();
  });
}

Result<std::int64_t> read_integer(const std::string& path) {
  return Attribute::open(path, Attribute::Use::read).and_then([](const Attribute& attribute) {
    return attribute.integer();
  });
}

Result<void> write_text(const std::string& path, std::string_view text) {
  return Attribute::open(path, Attribute::Use::write).and_then([&](const Attribute& attribute) {
    return attribute.set(text);
  });
}

}  // namespace supercoil::hal_linux
