#include "supercoil/hal_linux/iio_device.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>

#include "supercoil/hal_linux/attribute.hpp"
#include "supercoil/hal_linux/scan_element.hpp"

namespace supercoil::hal_linux {

namespace {

/// "voltage0" → "voltage": what inputs of one kind share. A differential input keeps its '-'.
std::string kind_of(const std::string& input) {
  std::string kind;
  std::copy_if(input.begin(), input.end(), std::back_inserter(kind),
               [](char c) { return c < '0' || c > '9'; });
  return kind;
}

Result<double> read_decimal(const std::string& path) {
  const auto text = read_text(path);
  if (!text) return tl::unexpected(text.error());
  double value = 0.0;
  const char* const end = text->data() + text->size();
  const auto [rest, error] = std::from_chars(text->data(), end, value);
  if (error != std::errc{} || rest != end || !std::isfinite(value)) {
    return problem(path + " holds '" + *text + "', which is not a number");
  }
  return value;
}

/// The input's own value or that of its kind; nothing when there is neither.
Result<std::optional<double>> shared_value(const std::string& folder, const std::string& input,
                                           const std::string& what) {
  const std::string before = folder + "/in_";
  const std::string behind = "_" + what;
  for (const std::string& name : {input, kind_of(input)}) {
    const auto value = read_decimal(std::string(before).append(name).append(behind));
    if (value) return *value;
    if (value.error().code != ENOENT) return tl::unexpected(value.error());
  }
  return std::optional<double>{};
}

}  // namespace

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

Result<Scaling> kernel_scaling(const ConverterPlace& place) {
  if (!is_input_name(place.input)) return problem("'" + place.input + "' is not an input's name");
  const auto device = find_iio_device(place.device, place.root);
  if (!device) return tl::unexpected(device.error());
  const auto scale = shared_value(device->folder, place.input, "scale");
  if (!scale) return tl::unexpected(scale.error());
  if (!*scale) return problem(device->describe() + " tells no scale of " + place.input);
  const auto offset = shared_value(device->folder, place.input, "offset");
  if (!offset) return tl::unexpected(offset.error());
  return Scaling{**scale, offset->value_or(0.0)};
}

std::optional<CountRange> count_range(const ConverterPlace& place) {
  constexpr int most_bits = 32;  // more are no converter's
  if (!is_input_name(place.input)) return {};
  const auto device = find_iio_device(place.device, place.root);
  if (!device) return {};
  const auto type = read_text(device->folder + "/scan_elements/in_" + place.input + "_type")
                        .and_then(parse_scan_type);
  if (!type || type->bits > most_bits) return {};
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
