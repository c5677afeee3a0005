// Setup on a page: what the step's thread and the page's request threads share.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "apps/supercoil/setup/commission.hpp"
#include "apps/supercoil/setup/operator.hpp"

namespace supercoil::operating {

/// Serves one step after the other. Safe from any thread.
class PageOperator final : public Operator {
 public:
  /// After this long without a watching page the step ends: nobody sees the muscle.
  static constexpr std::chrono::seconds page_timeout{10};

  // For the step.
  void show(const std::string& line) override;
  void show_progress(const std::string& what, double done) override;
  bool sees_progress() const override { return true; }
  bool interrupted() const override;
  Answer ask(const Question& question, const std::function<Done()>& meanwhile) override;

  /// False: a step is under way.
  bool begin(const std::string& step);
  void conclude(const StepResult& found);

  // For the page.
  /// Answers the current question. The error: nothing is asked, or what is allowed.
  Done answer(const std::string& text);
  /// Tells the step to end; the first reason is kept.
  void end(const std::string& why);
  /// Reports that a page is watching.
  void alive();
  bool busy() const;
  /// running, last, lines, progress, question, error and kept of SetupSession::state().
  void add_to(nlohmann::ordered_json& state) const;

 private:
  using Clock = std::chrono::steady_clock;

  mutable std::mutex mutex_;
  std::condition_variable answered_;
  std::string step_;
  bool running_ = false;
  std::vector<std::string> lines_;
  nlohmann::ordered_json progress_;
  std::optional<Question> question_;
  std::optional<double> answer_;
  std::string ending_;  ///< why the step is to end; empty: it may go on
  std::string error_;
  bool kept_ = true;
  Clock::time_point alive_{};
};

}  // namespace supercoil::operating
