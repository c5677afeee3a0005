// A number that is a formula: what is computed with it is written down in SMT-LIB's notation.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace supercoil::test {

/// A comparison of formulas has no value: the path chooses each outcome, and records its
/// condition.
struct Path {
  std::vector<bool> choices;
  std::vector<std::string> conditions;

  bool decide(const std::string& condition) {
    const bool holds = conditions.size() < choices.size() && choices[conditions.size()];
    conditions.push_back(holds ? condition : "(not " + condition + ")");
    return holds;
  }
};

class Symbol {
 public:
  Symbol(double value) : text_(std::to_string(value)) {}
  explicit Symbol(std::string text) : text_(std::move(text)) {}

  const std::string& text() const { return text_; }

  static inline Path path;

  friend Symbol operator+(const Symbol& a, const Symbol& b) { return made_of("+", a, b); }
  friend Symbol operator-(const Symbol& a, const Symbol& b) { return made_of("-", a, b); }
  friend Symbol operator*(const Symbol& a, const Symbol& b) { return made_of("*", a, b); }
  friend Symbol operator/(const Symbol& a, const Symbol& b) { return made_of("/", a, b); }
  friend Symbol operator-(const Symbol& a) { return Symbol("(- " + a.text_ + ")"); }
  friend Symbol exp(const Symbol& a) { return Symbol("(exponential " + a.text_ + ")"); }
  friend bool operator>(const Symbol& a, const Symbol& b) {
    return path.decide(made_of(">", a, b).text_);
  }

 private:
  static Symbol made_of(const std::string& operation, const Symbol& a, const Symbol& b) {
    return Symbol("(" + operation + " " + a.text_ + " " + b.text_ + ")");
  }

  std::string text_;
};

}  // namespace supercoil::test
