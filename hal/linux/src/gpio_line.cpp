#include "supercoil/hal_linux/gpio_line.hpp"

#include <optional>
#include <utility>
#include <vector>

#include "supercoil/hal_linux/device_folder.hpp"

namespace supercoil::hal_linux {

namespace {

std::string described(const GpioChip& chip) {
  return chip.name() + " '" + chip.label() + "'";
}

/// The chips in dev, and why others could not be opened.
struct Chips {
  std::vector<GpioChip> open;
  std::vector<std::string> described;
};

Result<Chips> open_chips(const std::string& dev) {
  const auto folders = numbered_folders(dev, "gpiochip");
  if (!folders) return tl::unexpected(folders.error());
  Chips chips;
  for (const DeviceFolder& node : *folders) {
    // Some systems keep a chip's former number as a link to it.
    if (real_path(node.folder) != real_path(dev) + "/" + base_name(node.folder)) continue;
    auto chip = GpioChip::open(node.folder);
    chips.described.push_back(chip ? described(*chip) : chip.error().text());
    if (chip) chips.open.push_back(std::move(*chip));
  }
  return chips;
}

Result<GpioChip> find_chip(const std::string& label, const std::string& dev) {
  auto chips = open_chips(dev);
  if (!chips) return tl::unexpected(chips.error());
  const std::string what = "chip with the label '" + label + "' in " + dev;
  std::optional<GpioChip> found;
  for (GpioChip& chip : chips->open) {
    if (chip.label() != label) continue;
    if (found) return failure("more than one " + what + ": " + listed(chips->described));
    found = std::move(chip);
  }
  if (found) return std::move(*found);
  if (chips->described.empty()) return failure("no " + what + ": there is no chip");
  return failure("no " + what + ": there are " + listed(chips->described));
}

Result<unsigned> find_line(const GpioChip& chip, const std::string& name) {
  std::optional<unsigned> found;
  std::vector<std::string> names;
  for (unsigned offset = 0; offset < chip.line_count(); ++offset) {
    const std::string line = chip.describe(offset).name;
    if (!line.empty()) names.push_back("'" + line + "'");
    if (line != name || line.empty()) continue;
    if (found) {
      return failure("more than one line '" + name + "' on " + described(chip) + ": " +
                     std::to_string(*found) + " and " + std::to_string(offset));
    }
    found = offset;
  }
  if (found) return *found;
  const std::string what = "no line '" + name + "' on " + described(chip);
  if (names.empty()) return failure(what + ": none of its lines has a name");
  return failure(what + ": there are " + listed(names));
}

struct FoundLine {
  GpioChip chip;
  unsigned offset;
  LineDescription description;
};

Result<FoundLine> find(const LineName& name, const std::string& dev) {
  auto chip = find_chip(name.chip, dev);
  if (!chip) return tl::unexpected(chip.error());
  const auto offset = find_line(*chip, name.line);
  if (!offset) return tl::unexpected(offset.error());
  LineDescription description = chip->describe(*offset);
  return FoundLine{std::move(*chip), *offset, std::move(description)};
}

Result<HeldLine> hold(FoundLine&& found, Direction direction) {
  const std::string what =
      "cannot take line '" + found.description.name + "' of " + described(found.chip);
  auto line = std::move(found.chip).request(found.offset, direction);
  if (line) return line;
  const std::string& consumer = found.description.consumer;
  const bool held = line.error().code == std::errc::device_or_resource_busy && !consumer.empty();
  return failed_call(held ? what + ", which '" + consumer + "' holds" : what,
                     static_cast<int>(line.error().code));
}

}  // namespace

Result<HeldLine> hold_line(const LineName& name, Direction direction, const std::string& dev) {
  return find(name, dev).and_then(
      [&](FoundLine&& found) { return hold(std::move(found), direction); });
}

Result<UndrivenLine> read_undriven(const LineName& name, const std::string& dev) {
  return find(name, dev).and_then([](FoundLine&& found) {
    const Bias bias = found.description.bias;
    return hold(std::move(found), Direction::input).map([&](HeldLine&& line) {
      return UndrivenLine{line.get(), bias};
    });
  });
}

Result<std::unique_ptr<GpioOutput>> GpioOutput::open(const LineName& name, const std::string& dev) {
  auto line = hold_line(name, Direction::output, dev);
  if (!line) return tl::unexpected(line.error());
  return std::make_unique<GpioOutput>(std::move(*line));
}

GpioOutput::~GpioOutput() {
  // Chips differ in whether a line keeps its level when it is released.
  static_cast<void>(line_.set(false));
}

Result<std::unique_ptr<GpioInput>> GpioInput::open(const LineName& name, const std::string& dev) {
  auto line = hold_line(name, Direction::input, dev);
  if (!line) return tl::unexpected(line.error());
  return std::make_unique<GpioInput>(std::move(*line));
}

}  // namespace supercoil::hal_linux
