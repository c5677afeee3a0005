// What setup has done so far, beside the board's file: it goes on after a power cut.
#pragma once

#include <string>

#include <nlohmann/json.hpp>
#include <tl/expected.hpp>

namespace supercoil::operating {

/// Of one channel. "board.toml.setup.json" has one object for each channel, and in it one for each
/// step that is done: what the step found.
class SetupRecord {
 public:
  /// An absent file is an empty record. The error says why a file is none; nothing is lost then.
  static tl::expected<SetupRecord, std::string> open(const std::string& config, int channel);
  static std::string path_of(const std::string& config) { return config + ".setup.json"; }

  bool has(const std::string& step) const;
  /// A step behind this one is done.
  bool is_past(const std::string& step) const;
  /// What a step found; null: it was not done.
  nlohmann::ordered_json found(const std::string& step) const;
  /// In what a step found: the same of a joint's other muscle, which was measured with it, and its
  /// "channel".
  static constexpr const char* antagonist_key = "antagonist";
  /// Written at once, whole; what was found of an antagonist goes to its channel. What follows the
  /// step is to be done anew.
  tl::expected<void, std::string> add(const std::string& step, const nlohmann::ordered_json& found);

 private:
  SetupRecord(std::string path, std::string channel, nlohmann::ordered_json document)
      : path_(std::move(path)), channel_(std::move(channel)), document_(std::move(document)) {}

  void put(const std::string& name, const std::string& step, const nlohmann::ordered_json& found);

  std::string path_;
  std::string channel_;
  nlohmann::ordered_json document_;
};

}  // namespace supercoil::operating
