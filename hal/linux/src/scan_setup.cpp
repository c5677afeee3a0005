// Brings a converter's buffer from whatever state it was left in to the one wanted.
#include <algorithm>
#include <limits>
#include <string>

#include <fcntl.h>

#include "supercoil/hal_linux/iio_scan.hpp"

namespace supercoil::hal_linux {

namespace {

constexpr int max_scans = 4096;

Result<void> check(const ScanLocation& place) {
  if (place.length < 2 || place.length > max_scans) {
    return failure("a buffer of " + std::to_string(place.length) + " scans: must be 2 to 4096");
  }
  if (place.inputs.empty()) return failure("a scan without inputs");
  for (auto input = place.inputs.begin(); input != place.inputs.end(); ++input) {
    if (!is_input_name(*input)) return failure("'" + *input + "' is not an input name");
    if (std::find(place.inputs.begin(), input, *input) != input) {
      return failure("input '" + *input + "' is listed twice");
    }
  }
  return {};
}

/// Turns off elements that were left on: their bytes would shift ours.
Result<void> disable_all(const std::string& elements) {
  const auto names = names_in(elements);
  if (!names) return tl::unexpected(names.error());
  const std::string before = elements + "/";
  for (const std::string& name : *names) {
    if (!name.ends_with("_en")) continue;
    if (auto written = write_text(before + name, "0"); !written) return written;
  }
  return {};
}

Result<ScanElement> enable_element(const std::string& elements, const std::string& name) {
  const std::string path = elements + "/in_" + name;
  return write_text(path + "_en", "1")
      .and_then([&] { return read_integer(path + "_index"); })
      .and_then([&](std::int64_t index) -> Result<ScanElement> {
        if (index < 0 || index > std::numeric_limits<int>::max()) {
          return failure(path + "_index is out of range: " + std::to_string(index));
        }
        return read_text(path + "_type").and_then(parse_scan_type).map([&](const ScanType& type) {
          return ScanElement{static_cast<int>(index), type, 0};
        });
      });
}

Result<void> set_trigger(const DeviceFolder& device, const ScanLocation& place) {
  const std::string path = device.folder + "/trigger/current_trigger";
  if (place.trigger.empty()) {
    const auto current = read_text(path);
    if (current && !current->empty()) return {};
    return failure("no trigger is named and none is set in " + path);
  }
  auto written = write_text(path, place.trigger);
  if (written) return written;
  std::vector<std::string> names;
  if (const auto triggers = numbered_folders(place.root, "trigger"); triggers) {
    for (const DeviceFolder& trigger : *triggers) {
      names.push_back("'" + read_text(trigger.folder + "/name").value_or("?") + "'");
    }
  }
  return failed_call(written.error().text() + "; there are " +
                         (names.empty() ? "no triggers at all" : "the triggers " + listed(names)),
                     static_cast<int>(written.error().code));
}

/// Sets the elements' offsets, and checks that the inputs' counts fit into a sample.
Result<void> place_elements(ReadyScan& ready) {
  std::vector<ScanElement> all = ready.inputs;
  all.push_back(ready.timestamp);
  ready.bytes = lay_out(all);
  const auto same = [](const ScanElement& a, const ScanElement& b) { return a.index == b.index; };
  if (std::adjacent_find(all.begin(), all.end(), same) != all.end()) {
    return failure("two elements of a scan have the same index");
  }
  const auto offset_of = [&](const ScanElement& element) {
    return std::find_if(all.begin(), all.end(),
                        [&](const ScanElement& other) { return other.index == element.index; })
        ->offset;
  };
  for (ScanElement& input : ready.inputs) {
    constexpr int bits_of_counts = 32;
    if (input.type.bits + (input.type.is_signed ? 0 : 1) > bits_of_counts) {
      return failure("an input of " + std::to_string(input.type.bits) + " bits: the maximum is 32");
    }
    input.offset = offset_of(input);
  }
  ready.timestamp.offset = offset_of(ready.timestamp);
  return {};
}

Result<ReadyScan> enable_elements(const DeviceFolder& device, const ScanLocation& place) {
  const std::string elements = device.folder + "/scan_elements";
  auto enable = Attribute::open(device.folder + "/buffer/enable", Attribute::Use::write);
  if (!enable) return tl::unexpected(enable.error());
  // Nothing below can be changed while it is enabled.
  if (auto done = enable->set("0"); !done) return tl::unexpected(done.error());
  if (auto done = disable_all(elements); !done) return tl::unexpected(done.error());
  ReadyScan ready{{}, std::move(*enable), {}, {}, 0};
  for (const std::string& name : place.inputs) {
    const auto input = enable_element(elements, name);
    if (!input) return tl::unexpected(input.error());
    ready.inputs.push_back(*input);
  }
  const auto timestamp = enable_element(elements, "timestamp");
  if (!timestamp) return tl::unexpected(timestamp.error());
  ready.timestamp = *timestamp;
  if (auto done = place_elements(ready); !done) return tl::unexpected(done.error());
  return ready;
}

}  // namespace

Result<ReadyScan> set_up_scan(const ScanLocation& place) {
  if (auto good = check(place); !good) return tl::unexpected(good.error());
  const auto device = find_iio_device(place.device, place.root);
  if (!device) return tl::unexpected(device.error());
  auto ready = enable_elements(*device, place);
  if (!ready) return ready;
  const auto settled =
      write_text(device->folder + "/current_timestamp_clock", "monotonic")
          .and_then([&] { return set_trigger(*device, place); })
          .and_then([&] {
            return write_text(device->folder + "/buffer/length", std::to_string(place.length));
          });
  if (!settled) return tl::unexpected(settled.error());
  const std::string node = place.dev + "/" + base_name(device->folder);
  auto opened = open_file(node, O_RDONLY | O_NONBLOCK);
  if (!opened) return tl::unexpected(opened.error());
  ready->device = std::move(*opened);
  return ready;
}

}  // namespace supercoil::hal_linux
