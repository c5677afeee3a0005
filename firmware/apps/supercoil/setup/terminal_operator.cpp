#include "apps/supercoil/setup/terminal_operator.hpp"

#include <cmath>

#include "apps/supercoil/interrupted.hpp"
#include "text/number_text.hpp"

namespace supercoil::operating {

namespace {

constexpr int max_tries = 3;

}  // namespace

void TerminalOperator::show(const std::string& line) {
  progress_.reset();
  std::fprintf(out_, "  %s\n", line.c_str());
  std::fflush(out_);
}

void TerminalOperator::show_progress(const std::string& what, double done) {
  if (!progress_ || progress_of_ != what) {
    progress_.emplace(what, false);
    progress_of_ = what;
  }
  progress_->show(done, "");
}

bool TerminalOperator::interrupted() const {
  return operating::interrupted != 0;
}

Result<std::string> TerminalOperator::next_line(const std::function<Done()>& meanwhile) {
  for (;;) {
    if (auto goes_on = meanwhile(); !goes_on) return tl::unexpected(goes_on.error());
    if (auto line = answers_.wait(look_every)) return *line;
    // Ctrl-C may come with the end of the answers.
    if (interrupted()) return failure("interrupted");
    if (answers_.ended()) return failure("no answer: the input has ended");
  }
}

std::optional<TerminalOperator::Answer> TerminalOperator::scripted(const Question& q) {
  auto value = script_.next(q);
  if (value && *value) show(std::string(q.text) + ": " + number_text(**value, 9));
  return value;
}

TerminalOperator::Answer TerminalOperator::ask(const Question& q,
                                               const std::function<Done()>& meanwhile) {
  progress_.reset();
  if (const auto value = scripted(q)) return *value;
  // A person may try any number of times; another input might answer wrongly for ever.
  const bool patient = isatty(STDIN_FILENO) == 1;
  for (int i = 0; patient || i < max_tries; ++i) {
    std::fprintf(out_, "%s (%s)%s: ", std::string(q.text).c_str(), range_text(q.allowed).c_str(),
                 std::isnan(q.fallback) ? "" : (" [" + number_text(q.fallback, 9) + "]").c_str());
    std::fflush(out_);
    const auto line = next_line(meanwhile);
    if (!line) {
      // Starts a new line for the next message. After Ctrl-C there is one already; with answers
      // from a file the message continues on this line.
      if (patient && !interrupted()) std::fputs("\n", out_);
      return tl::unexpected(line.error());
    }
    Answer value = read_answer(q, *line);
    if (value) return value;
    std::fprintf(out_, "%s\n", value.error().text().c_str());
  }
  return failure("no allowed answer in 3 tries: " + std::string(q.text));
}

}  // namespace supercoil::operating
