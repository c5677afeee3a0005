#include "config/read_bundles.hpp"

#include <algorithm>
#include <cmath>

#include "text/number_text.hpp"

namespace supercoil::config {

BundleReader::BundleReader(std::vector<Section> sections, std::size_t channels,
                           const JointReader& joints) {
  for (Section& section : sections) {
    std::vector<std::size_t> places = read_channels(section, channels, joints);
    is_wrong_ = is_wrong_ || places.empty();
    bundles_.push_back({std::move(section), {std::move(places)}});
  }
}

std::vector<std::size_t> BundleReader::read_channels(Section& section, std::size_t channels,
                                                     const JointReader& joints) {
  constexpr const char* key = "channels";
  const auto max_number = std::max<std::size_t>(2, channels);
  const auto numbers =
      section.required_numbers(key, {1.0, static_cast<double>(max_number)}, 2, max_number);
  std::vector<std::size_t> places;
  for (const double number : numbers) {
    const auto place = static_cast<std::size_t>(number) - 1;
    const char* wrong = nullptr;
    if (number != std::floor(number)) {
      wrong = "does not exist: channels are numbered from 1";
    } else if (place >= channels) {
      wrong = "is not in this file";
    } else if (joints.place_of(place).turns()) {
      wrong = "turns a joint, and so cannot be in a bundle";
    } else if (std::ranges::find(taken_, place) != taken_.end()) {
      wrong = "is already in a bundle";
    }
    if (wrong != nullptr) {
      section.wrong(key, "channel " + number_text(number, 3) + " " + wrong);
      return {};
    }
    taken_.push_back(place);
    places.push_back(place);
  }
  return places;
}

std::optional<std::size_t> BundleReader::leader_of(std::size_t channel) const {
  for (const Read& read : bundles_) {
    const auto& places = read.bundle.channels;
    const auto found = std::ranges::find(places, channel);
    if (found != places.end() && found != places.begin()) return read.bundle.leader();
  }
  return std::nullopt;
}

void BundleReader::finish(BoardConfig& config) {
  for (std::size_t i = 0; i < bundles_.size(); ++i) {
    Read& read = bundles_[i];
    const std::string name = read.section.text("name", "bundle " + std::to_string(i + 1));
    if (!read.bundle.channels.empty()) {
      add_bundle(config.settings, read.bundle);
      config.bundles.push_back(name);
    }
    read.section.finish();
  }
}

}  // namespace supercoil::config
