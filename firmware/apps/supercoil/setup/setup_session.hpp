// Setup on a page: one step at a time, in its own thread.
#pragma once

#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include <nlohmann/json.hpp>

#include "supercoil/hal/error.hpp"

#include "apps/supercoil/monitor/access.hpp"
#include "apps/supercoil/setup/options.hpp"
#include "apps/supercoil/setup/page_operator.hpp"

namespace supercoil::operating {

/// Safe from any thread.
class SetupSession {
 public:
  /// options: config, channel and can. before: called before a step begins.
  SetupSession(SetupOptions options, std::function<void()> before);
  SetupSession(const SetupSession&) = delete;
  SetupSession& operator=(const SetupSession&) = delete;
  /// Ends the step that is under way, and waits for it.
  ~SetupSession();

  /// GET /api/setup: state(); whoever may command watches by it. POST /api/setup {"do": "begin",
  /// "step": …}, {"do": "answer", "text": …}, {"do": "end"} or {"do": "undo"}: the state after it
  /// with "done", what was done in words, or {"error": …}. It and access outlive the server.
  void serve_with(httplib::Server& server, const Access& access);
  /// Ends the step, and disarms the muscle. Does not wait for it.
  void end(const std::string& why) { page_.end(why); }

 private:
  /// The error: why it was not done.
  using Done = Operator::Done;

  /// {file, channel, steps: [{name, does, optional, found}], running, last, lines, progress,
  /// question, error, kept}: what a page shows. running is null where no step is under way; lines,
  /// error and kept are of the last one.
  nlohmann::ordered_json state() const;
  /// What was done; in words if the user should read it.
  Result<std::string> execute(const nlohmann::ordered_json& command);
  Done begin(const std::string& step);
  Result<std::string> undo();
  StepResult run(const std::string& step);

  SetupOptions options_;
  std::function<void()> before_;
  PageOperator page_;
  std::mutex beginning_;  ///< a step, or undo
  std::thread thread_;    ///< of the last step
};

}  // namespace supercoil::operating
