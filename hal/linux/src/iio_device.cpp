#include "supercoil/hal_linux/iio_device.hpp"

#include <algorithm>
#include <optional>

#include "supercoil/hal_linux/attribute.hpp"
#include "supercoil/hal_linux/scan_element.hpp"

namespace supercoil::hal_linux {

Result<std::vector<DeviceFolder>> iio_devices(const std::string& root) {
  auto devices = numbered_folders(root, "iio:device");
  if (!devices) return devices;
  for (DeviceFolder& device : *devices) {
    // The folder is a link to …/i2c-1/1-0048/iio:device0.
    device.device_path = parent_of(real_path(device.folder));
    if (const auto name = read_text(device.folder + "/name"); name && !name->empty()) {
      device.names.push_back(*name);
    }
  }
  return devices;
}

Result<DeviceFolder> find_iio_device(const std::string& device, const std::string& root) {
  return iio_devices(root).and_then(
      [&](const auto& all) { return choose(all, device, "converter", root); });
}

std::optional<CountRange> count_range(const ConverterLocation& place) {
  constexpr int max_bits = 32;  // no converter has more
  if (!is_input_name(place.input)) return {};
  const auto device = find_iio_device(place.device, place.root);
  if (!device) return {};
  const auto type = read_text(device->folder + "/scan_elements/in_" + place.input + "_type")
                        .and_then(parse_scan_type);
  if (!type || type->bits > max_bits) return {};
  const std::int64_t codes = std::int64_t{1} << static_cast<unsigned>(type->bits);
  if (type->is_signed) return CountRange{-codes / 2, codes / 2 - 1};
  return CountRange{0, codes - 1};
}

bool is_input_name(const std::string& input) {
  return !input.empty() && std::all_of(input.begin(), input.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_';
  });
}

}  // namespace supercoil::hal_linux
