// The operator of a step of setup: sees its findings, answers its questions, and may end it.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "supercoil/hal/error.hpp"

#include "config/section.hpp"

namespace supercoil::operating {

/// One question to the operator.
struct Question {
  std::string_view key;
  std::string_view text;  ///< with its unit
  config::Range allowed;
  double fallback;  ///< what an empty answer means; NaN: it must be answered

  bool allows(double value) const { return value >= allowed.min && value <= allowed.max; }
};

class Operator {
 public:
  using Done = Result<void>;
  using Answer = Result<double>;

  /// How often a waiting question calls `meanwhile`, which renews a command to heat.
  static constexpr std::chrono::milliseconds look_every{50};

  Operator() = default;
  Operator(const Operator&) = delete;
  Operator& operator=(const Operator&) = delete;
  virtual ~Operator() = default;

  /// Shows what was done or found, as a line.
  virtual void show(const std::string& line) = 0;
  /// Shows progress, 0 to 1; NaN: not known. Cheap.
  virtual void show_progress(const std::string& what, double done) = 0;
  /// When progress is not shown, callers need not compute it.
  virtual bool sees_progress() const = 0;
  /// Whether the step is to end.
  virtual bool interrupted() const = 0;
  /// Waits for an answer in the allowed range. meanwhile: called every look_every; its error ends
  /// the waiting. The error: why there is no answer.
  virtual Answer ask(const Question& question, const std::function<Done()>& meanwhile) = 0;
  /// The answer to what only a script answers; no person is asked. Empty: there is no script, or no
  /// answer in it. The error: the board does not allow the answer.
  virtual std::optional<Answer> scripted(const Question&) { return std::nullopt; }
};

inline constexpr int range_digits = 5;
/// Rounds down to this many digits, so that the value shown is allowed; 0 if not positive.
double rounded_down(double value, int significant_digits);
/// "0.1 to 10000"
std::string range_text(const config::Range& range);
/// The error: why the text is not an allowed answer, with what is allowed.
Operator::Answer read_answer(const Question& question, const std::string& text);

}  // namespace supercoil::operating
