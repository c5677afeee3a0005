// A board as its owner describes it: what the loop needs, and what it is wired to.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "config/bundle.hpp"
#include "config/diagnostics.hpp"
#include "config/wiring.hpp"
#include "loop/settings.hpp"
#include "telemetry/settings.hpp"

namespace supercoil::config {

/// Default temperature limits of a channel: for nylon, or for a muscle worn on the skin.
enum class Preset { nylon, skin };

/// Describes a channel; the loop does not need it.
struct ChannelLabel {
  std::string name;
  std::string joint;  ///< name of the joint that the channel turns alone; may be empty
  Preset preset = Preset::nylon;
  bool position_in_deg = false;  ///< its sensor, of a joint's angle, is configured in degrees
  std::optional<double>
      thermal_fuse_C;            ///< at which it opens; 0: not fitted; empty: not configured
  std::optional<Bundle> bundle;  ///< empty: one muscle
};

/// Describes a joint; the loop does not need it.
struct JointLabel {
  std::string name;
  std::optional<double> max_pull_N{};  ///< that one muscle bears; empty: not configured
  double pretension_N = 0.0;           ///< each muscle's pull when both are cold, at the angle 0
};

/// A board.toml that was read without a mistake.
struct BoardConfig {
  std::string name;
  std::uint32_t crc32 = 0;  ///< of the file's content, as for a scenario
  BoardSettings settings;   ///< passes check()
  BoardWiring wiring;       ///< as many channels as the settings
  std::vector<ChannelLabel> labels;
  std::vector<JointLabel> joints;    ///< as many as the settings have
  std::vector<std::string> bundles;  ///< their names; as many as the settings have
  std::optional<telemetry::CanSettings> can;
  std::string storage_folder;  ///< what was learned is kept here
};

/// A configuration, or everything that is wrong with it, in the order of the file.
using BoardConfigOrProblems = tl::expected<BoardConfig, Errors>;

/// path: a .toml file. keys: gets all keys that apply to it, if not null.
BoardConfigOrProblems read_board_config(const std::string& path, KeyList* keys = nullptr);

/// The same from text; name: as in messages.
BoardConfigOrProblems parse_board_config(const std::string& text, const std::string& name,
                                         KeyList* keys = nullptr);

}  // namespace supercoil::config
