// Collects findings about several channels, each line once.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "supervisor/fault.hpp"

namespace supercoil::config {

/// One line for each finding, however many channels share it.
class Findings {
 public:
  /// Findings that are added from now on concern this channel, from 1.
  void enter(std::size_t channel) { channel_ = channel; }

  /// About the channel of enter(): "FAULT: reason".
  void add(Fault fault, const std::string& reason) { add(name(fault), reason); }
  /// Likewise: "what: reason".
  void add(std::string_view what, const std::string& reason) {
    add(std::string(what) + ": " + reason);
  }
  /// Likewise; the same text of another channel joins its line.
  void add(const std::string& text) {
    const auto found = std::ranges::find(findings_, text, &Finding::text);
    if (found == findings_.end()) {
      findings_.push_back({text, {channel_}});
    } else {
      found->channels.push_back(channel_);
    }
  }
  /// "channels 1, 3: text", in the order in which they were first added.
  std::vector<std::string> lines() const {
    std::vector<std::string> result;
    for (const Finding& finding : findings_) {
      std::string owner = finding.channels.size() == 1 ? "channel" : "channels";
      for (std::size_t i = 0; i < finding.channels.size(); ++i)
        owner += (i == 0 ? " " : ", ") + std::to_string(finding.channels[i]);
      result.push_back(owner + ": " + finding.text);
    }
    return result;
  }

 private:
  struct Finding {
    std::string text;
    std::vector<std::size_t> channels;
  };

  std::size_t channel_ = 0;
  std::vector<Finding> findings_;
};

}  // namespace supercoil::config
