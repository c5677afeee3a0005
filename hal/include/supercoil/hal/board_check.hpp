// What is found of a board when it is looked at before anybody heats anything.
#pragma once

#include <functional>
#include <string>

namespace supercoil::hal {

enum class Verdict {
  ok,
  warning,  ///< the firmware runs, but not as it should; or it cannot be known
  problem,  ///< the firmware does not start, or nothing may be heated with it
};

constexpr const char* text(Verdict verdict) {
  switch (verdict) {
    case Verdict::ok:
      return "ok";
    case Verdict::warning:
      return "warning";
    case Verdict::problem:
      return "problem";
  }
  return "?";
}

/// One thing that was looked at.
struct Finding {
  std::string what;  ///< e.g. "channel 1, enable"
  Verdict verdict = Verdict::ok;
  std::string found;   ///< how it is; of what is missing, where it was looked for and what is there
  std::string remedy;  ///< what to do; empty when ok
};

/// Takes each finding as it is made. A check of a board is a function that gets one; it may block
/// and allocate, and never turns anything on.
using Tell = std::function<void(const Finding&)>;

}  // namespace supercoil::hal
