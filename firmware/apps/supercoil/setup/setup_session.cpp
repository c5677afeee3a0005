#include "apps/supercoil/setup/setup_session.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "apps/supercoil/number_text.hpp"
#include "apps/supercoil/setup/commission.hpp"
#include "apps/supercoil/setup/describe_step.hpp"
#include "apps/supercoil/setup/record.hpp"
#include "apps/supercoil/setup/setup_board.hpp"
#include "apps/supercoil/setup/steps.hpp"

namespace supercoil::operating {

namespace {

using Json = nlohmann::ordered_json;

std::string without_line_end(std::string text) {
  while (!text.empty() && text.back() == '\n')
    text.pop_back();
  return text;
}

bool is_step(const std::string& name) {
  return std::ranges::any_of(setup_steps, [&](const SetupStep& s) { return s.name == name; });
}

}  // namespace

/// What the thread of the step and those of the page share.
class SetupSession::Page final : public Operator {
 public:
  void say(const std::string& line) override {
    const std::lock_guard lock(mutex_);
    lines_.push_back(line);
  }
  void show_progress(const std::string& what, double done) override {
    const std::lock_guard lock(mutex_);
    progress_ = {{"what", what}, {"done", std::isfinite(done) ? Json(done) : Json(nullptr)}};
  }
  bool sees_progress() const override { return true; }
  bool interrupted() const override {
    const std::lock_guard lock(mutex_);
    return !ending_.empty() || Clock::now() - alive_ > page_timeout;
  }
  OrWhy ask(const Question& question, const std::function<Done()>& meanwhile) override;

  /// False: a step is under way.
  bool begin(const std::string& step);
  void conclude(const StepResult& found);
  bool answer(const std::string& text);
  void end(const std::string& why);
  void alive();
  void add_to(Json& state) const;
  bool busy() const {
    const std::lock_guard lock(mutex_);
    return running_;
  }

  std::thread thread;

 private:
  using Clock = std::chrono::steady_clock;

  mutable std::mutex mutex_;
  std::condition_variable answered_;
  std::string step_;
  bool running_ = false;
  std::vector<std::string> lines_;
  Json progress_;
  std::optional<Question> question_;
  std::optional<double> answer_;
  std::string ending_;  ///< why the step is to end; empty: it is not
  std::string error_;
  bool kept_ = true;
  Clock::time_point alive_{};
};

Operator::OrWhy SetupSession::Page::ask(const Question& question,
                                        const std::function<Done()>& meanwhile) {
  std::unique_lock lock(mutex_);
  question_ = question;
  answer_.reset();
  progress_ = nullptr;
  const auto over = [&](OrWhy result) {
    question_.reset();
    return result;
  };
  while (!answer_) {
    lock.unlock();
    const bool ends = interrupted();
    const Done goes_on = meanwhile();
    lock.lock();
    if (ends) return over(tl::unexpected<std::string>("interrupted"));
    if (!goes_on) return over(tl::unexpected(goes_on.error()));
    answered_.wait_for(lock, look_every, [&] { return answer_.has_value(); });
  }
  lines_.push_back(std::string(question.text) + ": " + number_text(*answer_, 9));
  return over(*answer_);
}

bool SetupSession::Page::begin(const std::string& step) {
  const std::lock_guard lock(mutex_);
  if (running_) return false;
  if (thread.joinable()) thread.join();
  step_ = step;
  running_ = true;
  lines_.clear();
  progress_ = nullptr;
  ending_.clear();
  error_.clear();
  kept_ = true;
  alive_ = Clock::now();
  return true;
}

void SetupSession::Page::conclude(const StepResult& found) {
  const std::lock_guard lock(mutex_);
  running_ = false;
  progress_ = nullptr;
  if (found) {
    kept_ = Commission::kept(*found);
  } else {
    error_ = without_line_end(found.error());
    if (ending_.empty() && Clock::now() - alive_ > page_timeout) ending_ = "no page watched it";
    if (!ending_.empty()) error_ += ": " + ending_;
  }
}

bool SetupSession::Page::answer(const std::string& text) {
  const std::lock_guard lock(mutex_);
  if (!question_) return false;
  double value = question_->fallback;
  if (!text.empty()) {
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    if (read.ec != std::errc{} || read.ptr != text.data() + text.size()) value = NAN;
  }
  if (!(value >= question_->allowed.lowest && value <= question_->allowed.highest)) return false;
  answer_ = value;
  answered_.notify_all();
  return true;
}

void SetupSession::Page::end(const std::string& why) {
  const std::lock_guard lock(mutex_);
  if (running_ && ending_.empty()) ending_ = why;
}

void SetupSession::Page::alive() {
  const std::lock_guard lock(mutex_);
  // Who comes back does not save a step that ends already.
  if (Clock::now() - alive_ <= page_timeout) alive_ = Clock::now();
}

void SetupSession::Page::add_to(Json& state) const {
  const std::lock_guard lock(mutex_);
  state["running"] = running_ ? Json(step_) : Json(nullptr);
  state["last"] = step_;
  state["lines"] = lines_;
  state["progress"] = progress_;
  state["question"] = nullptr;
  if (question_) {
    state["question"] = {
        {"key", question_->key},
        {"text", question_->text},
        {"range", range_text(question_->allowed)},
        {"fallback", std::isnan(question_->fallback) ? Json(nullptr)
                                                     : Json(number_text(question_->fallback, 9))}};
  }
  state["error"] = error_;
  state["kept"] = kept_;
}

SetupSession::SetupSession(SetupOptions options, std::function<void()> before)
    : options_(std::move(options)),
      before_(std::move(before)),
      page_(std::make_unique<SetupSession::Page>()) {}

SetupSession::~SetupSession() {
  end("the monitor ends");
  if (page_->thread.joinable()) page_->thread.join();
}

Json SetupSession::state() const {
  Json told{{"file", options_.config}, {"channel", options_.channel}};
  const auto record = SetupRecord::open(options_.config, options_.channel);
  Json steps = Json::array();
  for (const SetupStep& step : setup_steps) {
    steps.push_back({{"name", step.name},
                     {"does", step.does},
                     {"optional", step.optional},
                     {"found", record ? record->found(std::string(step.name)) : Json()}});
  }
  told["steps"] = std::move(steps);
  page_->add_to(told);
  if (!record) told["error"] = record.error();
  return told;
}

SetupSession::Done SetupSession::begin(const std::string& step) {
  if (!is_step(step)) return tl::unexpected("there is no step '" + step + "'");
  if (!page_->begin(step)) return tl::unexpected<std::string>("another step is under way");
  before_();
  page_->thread = std::thread([this, step] { run(step); });
  return {};
}

void SetupSession::run(const std::string& step) {
  StepResult found = [&]() -> StepResult {
    auto record = SetupRecord::open(options_.config, options_.channel);
    if (!record) return tl::unexpected(record.error());
    SetupBoard board(options_, *page_);
    auto result = step == "describe" ? describe_step(options_, *page_) : board.run(step);
    if (!result) return result;
    if (auto kept = record->add(step, *result); !kept) return tl::unexpected(kept.error());
    return result;
  }();
  page_->conclude(found);
}

SetupSession::Done SetupSession::answer(const std::string& text) {
  const Json asked = state()["question"];
  if (asked.is_null()) return tl::unexpected<std::string>("nothing is asked now");
  if (page_->answer(text)) return {};
  return tl::unexpected("'" + text + "' is refused: it must be a number from " +
                        asked["range"].get<std::string>());
}

void SetupSession::end(const std::string& why) {
  page_->end(why);
}

SetupSession::Done SetupSession::undo() {
  if (page_->busy()) return tl::unexpected<std::string>("a step is under way");
  return undo_setup(options_);
}

void SetupSession::alive() {
  page_->alive();
}

}  // namespace supercoil::operating
