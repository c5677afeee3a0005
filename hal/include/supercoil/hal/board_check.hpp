// Findings of a check of a board before anything is heated.
#pragma once

#include <functional>
#include <string>

namespace supercoil::hal {

/// How much a Finding matters.
enum class Severity {
  ok,
  warning,  ///< the firmware runs, but not as it should; or the state is unknown
  problem,  ///< the firmware does not start, or nothing may be heated with it
};

/// In one word, for people.
constexpr const char* text(Severity severity) {
  switch (severity) {
    case Severity::ok:
      return "ok";
    case Severity::warning:
      return "warning";
    case Severity::problem:
      return "problem";
  }
  return "?";
}

/// One finding.
struct Finding {
  std::string what;  ///< e.g. "channel 1, enable"
  Severity severity = Severity::ok;
  std::string found;   ///< how it is; if missing, where it was looked for and what is there
  std::string remedy;  ///< what to do; empty when ok
};

/// Takes each finding as it is made. A check of a board is a function that gets one; it may block
/// and allocate, and never turns anything on.
using FindingSink = std::function<void(const Finding&)>;

}  // namespace supercoil::hal
