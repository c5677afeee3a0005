#include "storage/examined.hpp"

#include "storage/codec.hpp"
#include "storage/envelope.hpp"

namespace supercoil::storage {

Examined examine(Files& files, const std::string& path) {
  // One byte more than is allowed, so that decode() sees that it is too large.
  const auto text = files.read(path, max_file_bytes + 1);
  if (!text) {
    if (text.error().code == std::errc::no_such_file_or_directory)
      return {false, std::nullopt, path + ": is not there"};
    return {true, std::nullopt, text.error().text()};
  }
  const auto learned = decode(*text);
  if (!learned) return {true, std::nullopt, path + ": " + learned.error().text()};
  return {true, *learned, ""};
}

}  // namespace supercoil::storage
