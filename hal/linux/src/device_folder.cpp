#include "supercoil/hal_linux/device_folder.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "supercoil/hal_linux/attribute.hpp"

namespace supercoil::hal_linux {

namespace {

bool ends_with_path(std::string_view path, std::string_view end) {
  if (!path.ends_with(end)) return false;
  // Whole components only: "1/1-0040" is not the end of "i2c-11/1-0040".
  return path.size() == end.size() || end.front() == '/' ||
         path[path.size() - end.size() - 1] == '/';
}

bool matches(const DeviceFolder& device, std::string_view wanted) {
  if (wanted.empty()) return false;
  if (wanted.find('/') != std::string_view::npos) return ends_with_path(device.device_path, wanted);
  return std::find(device.names.begin(), device.names.end(), wanted) != device.names.end();
}

std::string described(const std::vector<DeviceFolder>& devices) {
  std::vector<std::string> items;
  items.reserve(devices.size());
  for (const DeviceFolder& device : devices)
    items.push_back(device.describe());
  return listed(items);
}

}  // namespace

std::string DeviceFolder::describe() const {
  return base_name(folder) + (names.empty() ? " without a name" : " '" + names.front() + "'") +
         " at " + device_path;
}

Result<std::vector<DeviceFolder>> numbered_folders(const std::string& root,
                                                   std::string_view prefix) {
  const auto names = names_in(root);
  if (!names) return tl::unexpected(names.error());
  std::vector<std::int64_t> numbers;
  for (const std::string& name : *names) {
    if (!name.starts_with(prefix)) continue;
    const Number number = parse_number(std::string_view(name).substr(prefix.size()));
    if (number.status == hal::Status::ok && number.value >= 0) numbers.push_back(number.value);
  }
  std::sort(numbers.begin(), numbers.end());
  std::vector<DeviceFolder> folders;
  folders.reserve(numbers.size());
  for (const auto number : numbers) {
    folders.push_back({root + "/" + std::string(prefix) + std::to_string(number), {}, {}});
  }
  return folders;
}

Result<DeviceFolder> choose(const std::vector<DeviceFolder>& all, std::string_view wanted,
                            std::string_view kind, const std::string& root) {
  std::vector<DeviceFolder> meant;
  std::copy_if(all.begin(), all.end(), std::back_inserter(meant),
               [&](const DeviceFolder& device) { return matches(device, wanted); });
  if (meant.size() == 1) return meant.front();
  const std::string by =
      wanted.find('/') == std::string_view::npos ? " with the name '" : " whose path ends with '";
  const std::string what = std::string(kind) + by + std::string(wanted) + "' in " + root;
  if (!meant.empty()) {
    return failure("more than one " + what + ": " + described(meant) +
                   "; say which by the end of its path");
  }
  if (all.empty()) return failure("no " + what + ": there is none");
  return failure("no " + what + ": there are " + described(all));
}

std::string real_path(const std::string& path) {
  std::error_code error;
  const auto real = std::filesystem::canonical(path, error);
  return error ? std::string{} : real.string();
}

std::string base_name(const std::string& path) {
  return path.substr(path.rfind('/') + 1);
}

std::string parent_of(const std::string& path) {
  const auto slash = path.rfind('/');
  return slash == std::string::npos ? std::string{} : path.substr(0, slash);
}

std::string listed(const std::vector<std::string>& items) {
  constexpr std::size_t max_items = 12;
  std::string text;
  for (std::size_t i = 0; i < std::min(items.size(), max_items); ++i) {
    text += (i == 0 ? "" : ", ") + items[i];
  }
  if (items.size() > max_items)
    text += " and " + std::to_string(items.size() - max_items) + " more";
  return text;
}

Result<std::vector<std::string>> names_in(const std::string& folder) {
  std::error_code error;
  std::vector<std::string> names;
  auto entry = std::filesystem::directory_iterator(folder, error);
  for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    names.push_back(entry->path().filename().string());
  }
  if (error) return failed_call("cannot list " + folder, error.value());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace supercoil::hal_linux
