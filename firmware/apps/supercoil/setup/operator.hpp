// Who watches a step of setup: sees what it finds, answers what it asks, and may end it.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "supercoil/hal/error.hpp"

#include "config/section.hpp"

namespace supercoil::operating {

/// One thing that is asked.
struct Question {
  std::string_view key;
  std::string_view text;  ///< with its unit
  config::Range allowed;
  double fallback;  ///< what an empty answer means; NaN: it must be answered

  bool allows(double value) const { return value >= allowed.lowest && value <= allowed.highest; }
};

class Operator {
 public:
  using Done = Result<void>;
  using OrWhy = Result<double>;

  /// How often a question that waits lets the rest go on, which renews a command to heat.
  static constexpr std::chrono::milliseconds look_every{50};

  Operator() = default;
  Operator(const Operator&) = delete;
  Operator& operator=(const Operator&) = delete;
  virtual ~Operator() = default;

  /// What was done or found, as a line.
  virtual void say(const std::string& line) = 0;
  /// How far something has come, 0 to 1; NaN: not known. Cheap.
  virtual void show_progress(const std::string& what, double done) = 0;
  /// Where it is not shown, nobody need find out how far something is.
  virtual bool sees_progress() const = 0;
  /// The step is to end.
  virtual bool interrupted() const = 0;
  /// Waits for an answer in the allowed range. meanwhile: called every look_every; an error of it
  /// ends the waiting. The error: why there is no answer.
  virtual OrWhy ask(const Question& question, const std::function<Done()>& meanwhile) = 0;
  /// What only a script answers, as no person is asked for it. Empty: there is none, or it does not
  /// say. The error: the board does not allow that.
  virtual std::optional<OrWhy> scripted(const Question&) { return std::nullopt; }
};

inline constexpr int range_digits = 5;
/// To so many digits, so that what is shown is allowed; 0 of what is not positive.
double rounded_down(double value, int significant_digits);
/// "0.1 to 10000"
std::string range_text(const config::Range& range);
/// The error: why it is no answer, with what is allowed.
Operator::OrWhy read_answer(const Question& question, const std::string& text);

}  // namespace supercoil::operating
