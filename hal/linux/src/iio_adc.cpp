#include "supercoil/hal_linux/iio_adc.hpp"

#include <algorithm>
#include <limits>
#include <string_view>

#include "supercoil/hal_linux/monotonic_clock.hpp"

namespace supercoil::hal_linux {

namespace {

/// "voltage0, voltage1": the inputs for which a device has in_…_raw.
std::string inputs_of(const std::string& folder) {
  constexpr std::string_view before = "in_";
  constexpr std::string_view behind = "_raw";
  std::vector<std::string> inputs;
  for (const std::string& name : names_in(folder).value_or(std::vector<std::string>{})) {
    if (name.size() <= before.size() + behind.size()) continue;
    if (!name.starts_with(before) || !name.ends_with(behind)) continue;
    inputs.push_back(name.substr(before.size(), name.size() - before.size() - behind.size()));
  }
  std::sort(inputs.begin(), inputs.end());
  return inputs.empty() ? "none" : listed(inputs);
}

}  // namespace

Result<std::unique_ptr<IioAdc>> IioAdc::open(const ConverterLocation& place) {
  if (!is_input_name(place.input)) return failure("'" + place.input + "' is not an input name");
  const auto device = find_iio_device(place.device, place.root);
  if (!device) return tl::unexpected(device.error());
  auto raw = Attribute::open(device->folder + "/in_" + place.input + "_raw", Attribute::Use::read);
  if (!raw && raw.error().code == std::errc::no_such_file_or_directory) {
    return failure("no input '" + place.input + "' on " + device->describe() + ": there are " +
                   inputs_of(device->folder));
  }
  if (!raw) return tl::unexpected(raw.error());
  if (const auto first = raw->integer(); !first) return tl::unexpected(first.error());
  return std::make_unique<IioAdc>(std::move(*raw));
}

hal::Sample IioAdc::latest() {
  using Limits = std::numeric_limits<std::int32_t>;
  const hal::Time before = MonotonicClock::time();
  const Number raw = raw_.number();
  if (raw.status != hal::Status::ok) return {0, before, raw.status};
  if (raw.value < Limits::min() || raw.value > Limits::max()) {
    return {0, before, hal::Status::io_error};
  }
  return {static_cast<std::int32_t>(raw.value), before, hal::Status::ok};
}

}  // namespace supercoil::hal_linux
