#include "config/board_config.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "config/read_board.hpp"
#include "config/read_bundles.hpp"
#include "config/read_channel.hpp"
#include "config/read_joint.hpp"
#include "config/toml_file.hpp"

namespace supercoil::config {

namespace {

constexpr std::size_t max_channels = 16;

/// In the order of the file; a mistake in [every_channel] is reported once, not for each channel.
Errors in_order(Errors problems) {
  std::stable_sort(problems.begin(), problems.end(),
                   [](const Error& a, const Error& b) { return a.line < b.line; });
  Errors result;
  for (Error& problem : problems) {
    const auto same = [&](const Error& other) { return other.text() == problem.text(); };
    if (std::none_of(result.begin(), result.end(), same)) result.push_back(std::move(problem));
  }
  return result;
}

/// The channel whose position this one uses; empty: it has its own.
std::optional<std::size_t> position_owner(std::size_t channel, const JointReader& joints,
                                          const BundleReader& bundles) {
  const auto agonist = joints.agonist_of(channel);
  return agonist ? agonist : bundles.leader_of(channel);
}

/// In the order of their numbers, but each after the channel whose position it uses.
std::vector<std::size_t> reading_order(std::size_t channels, const JointReader& joints,
                                       const BundleReader& bundles) {
  std::vector<std::size_t> order;
  const auto add = [&order](std::size_t channel) {
    if (std::ranges::find(order, channel) == order.end()) order.push_back(channel);
  };
  for (std::size_t i = 0; i < channels; ++i) {
    if (const auto owner = position_owner(i, joints, bundles)) add(*owner);
    add(i);
  }
  return order;
}

void read_channels(std::vector<Section> sections, Section& every, const BoardContext& context,
                   const JointReader& joints, const BundleReader& bundles, BoardConfig& config) {
  const std::size_t channels = std::min(sections.size(), max_channels);
  config.settings.channels.resize(channels);
  config.wiring.channels.resize(channels);
  config.labels.resize(channels);
  for (const std::size_t i : reading_order(channels, joints, bundles)) {
    ReadGroup group{joints.place_of(i), joints.max_travel_m(i), std::nullopt};
    if (const auto owner = position_owner(i, joints, bundles)) {
      group.position_owner.emplace(PositionOwner{*owner, config.settings.channels[*owner],
                                                 config.wiring.channels[*owner],
                                                 config.labels[*owner]});
    }
    ReadChannel channel = read_channel(sections[i].over(every.table(), "every_channel"),
                                       static_cast<int>(i + 1), context, group);
    config.settings.channels[i] = std::move(channel.settings);
    config.wiring.channels[i] = std::move(channel.wiring);
    config.labels[i] = std::move(channel.label);
  }
}

/// Refuses 0 channels, or more than a board can have.
bool refuse_number(const std::vector<Section>& channels, Diagnostics& diagnostics) {
  if (!channels.empty() && channels.size() <= max_channels) return false;
  const int line = channels.empty() ? 0 : channels[max_channels].line();
  diagnostics.add(line, "channel",
                  "a board has 1 to 16 [[channel]], not " + std::to_string(channels.size()));
  return true;
}

/// Reports what check() refuses, at its key.
void refuse_settings(Section& board, const BoardSettings& settings, Diagnostics& diagnostics) {
  if (std::isnan(settings.supervision.charge_pump_decay_s)) return;  // reported already
  const auto problem = check(settings);
  if (!problem) return;
  if (problem->key.empty()) {
    diagnostics.add(board.line(), "board", problem->message);
  } else {
    board.wrong(problem->key, problem->message);
  }
}

/// A list in [every_channel] is read for each channel.
void erase_repeated(KeyList& keys) {
  std::set<std::string> names;
  std::erase_if(keys, [&names](const Key& key) { return !names.insert(key.name).second; });
}

}  // namespace

BoardConfigOrProblems parse_board_config(const std::string& text, const std::string& name,
                                         KeyList* keys) {
  Diagnostics diagnostics(name, keys);
  const toml::table document = parse(text, diagnostics);
  if (!diagnostics.empty()) return tl::unexpected(diagnostics.problems());
  Section root(&document, "", diagnostics);
  BoardConfig config;
  config.name = std::filesystem::path(name).stem().string();
  config.crc32 = crc32_of(document);
  config.settings.channels.clear();
  std::vector<Section> buses = root.sections("bus");
  config.wiring.buses = read_buses(buses);

  Section board = root.section("board");
  read_board(board, config);
  Section lines = root.section("lines");
  const std::string chip = lines.text("chip", "");
  WiringReader wiring(config.wiring.buses, chip, config.settings.step_s());
  read_lines(lines, wiring, config.wiring);
  read_supply(root.section("supply"), wiring, config);
  const board::AirSettings air = read_ambient(root.section("ambient"), wiring, config);
  const CommandRules rules = read_command(root.section("command"), config.settings.step_s());

  Section every = root.section("every_channel");
  const std::vector<Section> channels = root.sections("channel");
  JointReader joints(root.sections("joint"), std::min(channels.size(), max_channels));
  BundleReader bundles(root.sections("bundle"), std::min(channels.size(), max_channels), joints);
  const BoardContext context{config.settings,
                             wiring,
                             air,
                             rules.timeout_s,
                             rules.damaged_in_a_row,
                             rules.refused_in_a_row,
                             joints.is_wrong(),
                             bundles.is_wrong()};
  read_channels(channels, every, context, joints, bundles, config);
  joints.finish(config);
  bundles.finish(config);
  Section can = root.section("can");
  if (root.has("can"))
    config.can = read_can(can, config.settings.rate_Hz, config.settings.channels);
  root.finish();
  if (!refuse_number(channels, diagnostics)) refuse_settings(board, config.settings, diagnostics);
  refuse_slow_buses(buses, config.wiring, config.settings.step_s());
  if (keys != nullptr) erase_repeated(*keys);
  if (!diagnostics.empty()) return tl::unexpected(in_order(diagnostics.problems()));
  return config;
}

BoardConfigOrProblems read_board_config(const std::string& path, KeyList* keys) {
  Diagnostics diagnostics(path);
  const std::string text = read_text(path, diagnostics);
  if (!diagnostics.empty()) return tl::unexpected(diagnostics.problems());
  return parse_board_config(text, path, keys);
}

}  // namespace supercoil::config
