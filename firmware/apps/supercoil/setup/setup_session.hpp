// Setup as a page leads through it: one step at a time, in a thread of its own.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include <nlohmann/json_fwd.hpp>
#include <tl/expected.hpp>

#include "apps/supercoil/setup/options.hpp"

namespace supercoil::operating {

/// Safe from any thread.
class SetupSession {
 public:
  using Done = tl::expected<void, std::string>;
  /// After so long without a page that watches, the step ends: nobody sees the muscle.
  static constexpr std::chrono::seconds page_timeout{10};

  /// options: config, channel and can. before: called before a step begins.
  SetupSession(SetupOptions options, std::function<void()> before);
  SetupSession(const SetupSession&) = delete;
  SetupSession& operator=(const SetupSession&) = delete;
  /// Ends the step that is under way, and waits for it.
  ~SetupSession();

  /// {file, channel, steps: [{name, does, optional, found}], running, lines, progress, question,
  /// error, kept}: what a page shows. running is null where no step is under way; lines, error and
  /// kept are of the last one.
  nlohmann::ordered_json state() const;
  /// The error: why it was not begun.
  Done begin(const std::string& step);
  /// Of the question that is asked now. The error: what is allowed.
  Done answer(const std::string& text);
  /// The step ends, and the muscle is disarmed. Does not wait for it.
  void end(const std::string& why);
  /// The file as it was before setup.
  Done undo();
  /// A page watches.
  void alive();

 private:
  class Page;

  void run(const std::string& step);

  SetupOptions options_;
  std::function<void()> before_;
  std::unique_ptr<Page> page_;
};

}  // namespace supercoil::operating
