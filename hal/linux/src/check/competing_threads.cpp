#include <charconv>
#include <map>
#include <vector>

#include <sched.h>

#include "supercoil/hal_linux/attribute.hpp"
#include "supercoil/hal_linux/checks.hpp"
#include "supercoil/hal_linux/device_folder.hpp"

namespace supercoil::hal_linux {

namespace {

// Fields of proc(5), counted from the third, which follows the name.
constexpr std::size_t flags_field = 6;
constexpr std::size_t priority_field = 37;
constexpr std::size_t policy_field = 38;
/// PF_KTHREAD of the kernel's sched.h.
constexpr std::int64_t kernel_thread = 0x00200000;
/// SCHED_DEADLINE; the C library has no name for it.
constexpr int deadline = 6;

bool is_number(const std::string& name) {
  return parse_number(name).status == hal::Status::ok;
}

std::string counted(int count, const std::string& one) {
  return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

/// The threads that run in preference to the loop, and of which program: "name (90)".
struct CompetingThreads {
  std::map<std::string, int> programs;
  int of_kernel = 0;
};

void note(const ThreadStat& thread, const LoopThreadSettings& settings,
          CompetingThreads& competing) {
  const bool above = thread.policy == deadline || thread.priority > settings.priority;
  if (!above) return;
  if (thread.of_kernel) {
    ++competing.of_kernel;
  } else {
    const std::string priority_text =
        thread.policy == deadline ? "deadline" : std::to_string(thread.priority);
    ++competing.programs[thread.name + " (" + priority_text + ")"];
  }
}

/// tasks: /proc/PID/task
void note_tasks(const std::string& tasks, const LoopThreadSettings& settings,
                CompetingThreads& competing) {
  for (std::string path : names_in(tasks).value_or(std::vector<std::string>{})) {
    path.insert(0, tasks + "/").append("/stat");
    // One that cannot be read ended in the meantime.
    const auto thread = parse_thread_stat(read_text(path).value_or(""));
    if (thread) note(*thread, settings, competing);
  }
}

}  // namespace

std::optional<ThreadStat> parse_thread_stat(std::string_view line) {
  // A name may contain blanks and brackets.
  const auto opened = line.find('(');
  const auto closed = line.rfind(')');
  if (opened == std::string_view::npos || closed == std::string_view::npos || closed < opened) {
    return {};
  }
  ThreadStat thread;
  thread.name = line.substr(opened + 1, closed - opened - 1);
  line.remove_prefix(closed + 1);
  for (std::size_t field = 0; field <= policy_field; ++field) {
    const auto begin = line.find_first_not_of(' ');
    if (begin == std::string_view::npos) return {};
    line.remove_prefix(begin);
    const std::string_view word = line.substr(0, line.find(' '));
    line.remove_prefix(word.size());
    const Number number = parse_number(word);
    if (field == flags_field) thread.of_kernel = (number.value & kernel_thread) != 0;
    if (field == priority_field) thread.priority = static_cast<int>(number.value);
    if (field == policy_field) thread.policy = static_cast<int>(number.value);
    const bool counts = field == flags_field || field >= priority_field;
    if (counts && number.status != hal::Status::ok) return {};
  }
  return thread;
}

void check_competing_threads(const Machine& machine, const LoopThreadSettings& settings,
                             const hal::FindingSink& sink) {
  using hal::Severity;
  const std::string what = "other programs";
  const auto processes = names_in(machine.proc);
  if (!processes) {
    sink({what, Severity::warning, processes.error().text(), "mount /proc"});
    return;
  }
  CompetingThreads competing;
  for (const std::string& process : *processes) {
    if (!is_number(process)) continue;
    note_tasks(std::string(machine.proc).append("/").append(process).append("/task"), settings,
               competing);
  }
  const std::string above = " above priority " + std::to_string(settings.priority);
  const std::string kernel = counted(competing.of_kernel, "kernel thread");
  if (competing.programs.empty()) {
    sink({what, Severity::ok, "none" + above + " (besides " + kernel + ")", ""});
    return;
  }
  std::vector<std::string> names;
  for (const auto& [name, threads] : competing.programs)
    names.push_back(threads == 1 ? name : name + ", " + counted(threads, "thread"));
  sink({what, Severity::warning, listed(names) + above + " (and " + kernel + ")",
        "lower their priority (chrt), or raise supercoild's (--priority): they make ticks late"});
}

}  // namespace supercoil::hal_linux
