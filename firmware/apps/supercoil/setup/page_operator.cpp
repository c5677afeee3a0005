#include "apps/supercoil/setup/page_operator.hpp"

#include <cmath>

#include "text/number_text.hpp"

namespace supercoil::operating {

namespace {

using Json = nlohmann::ordered_json;

std::string without_line_end(std::string text) {
  while (!text.empty() && text.back() == '\n')
    text.pop_back();
  return text;
}

}  // namespace

void PageOperator::show(const std::string& line) {
  const std::lock_guard lock(mutex_);
  lines_.push_back(line);
}

void PageOperator::show_progress(const std::string& what, double done) {
  const std::lock_guard lock(mutex_);
  progress_ = {{"what", what}, {"done", std::isfinite(done) ? Json(done) : Json(nullptr)}};
}

bool PageOperator::interrupted() const {
  const std::lock_guard lock(mutex_);
  return !ending_.empty() || Clock::now() - alive_ > page_timeout;
}

bool PageOperator::busy() const {
  const std::lock_guard lock(mutex_);
  return running_;
}

PageOperator::Answer PageOperator::ask(const Question& question,
                                       const std::function<Done()>& meanwhile) {
  std::unique_lock lock(mutex_);
  question_ = question;
  answer_.reset();
  progress_ = nullptr;
  const auto over = [&](Answer result) {
    question_.reset();
    return result;
  };
  while (!answer_) {
    lock.unlock();
    const bool ends = interrupted();
    const Done goes_on = meanwhile();
    lock.lock();
    if (ends) return over(failure("interrupted"));
    if (!goes_on) return over(tl::unexpected(goes_on.error()));
    answered_.wait_for(lock, look_every, [&] { return answer_.has_value(); });
  }
  lines_.push_back(std::string(question.text) + ": " + number_text(*answer_, 9));
  return over(*answer_);
}

bool PageOperator::begin(const std::string& step) {
  const std::lock_guard lock(mutex_);
  if (running_) return false;
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

void PageOperator::conclude(const StepResult& found) {
  const std::lock_guard lock(mutex_);
  running_ = false;
  progress_ = nullptr;
  if (found) {
    kept_ = Commission::kept(*found);
  } else {
    error_ = without_line_end(found.error().text());
    if (ending_.empty() && Clock::now() - alive_ > page_timeout) ending_ = "no page watched it";
    if (!ending_.empty()) error_ += ": " + ending_;
  }
}

PageOperator::Done PageOperator::answer(const std::string& text) {
  const std::lock_guard lock(mutex_);
  if (!question_) return failure("no question is open now");
  const Answer value = read_answer(*question_, text);
  if (!value) return tl::unexpected(value.error());
  answer_ = *value;
  answered_.notify_all();
  return {};
}

void PageOperator::end(const std::string& why) {
  const std::lock_guard lock(mutex_);
  if (running_ && ending_.empty()) ending_ = why;
}

void PageOperator::alive() {
  const std::lock_guard lock(mutex_);
  // A page that returns does not save a step that is already ending.
  if (Clock::now() - alive_ <= page_timeout) alive_ = Clock::now();
}

void PageOperator::add_to(Json& state) const {
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

}  // namespace supercoil::operating
