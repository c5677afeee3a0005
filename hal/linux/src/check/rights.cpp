#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>

#include <linux/capability.h>
#include <pthread.h>

#include "supercoil/hal_linux/attribute.hpp"
#include "supercoil/hal_linux/checks.hpp"
#include "supercoil/hal_linux/realtime.hpp"
#include "supercoil/hal_linux/thread.hpp"

namespace supercoil::hal_linux {

namespace {

using hal::Finding;
using hal::Severity;

/// 16 channels at 1 kHz with their recorder, program, libraries and stacks need less.
constexpr std::int64_t needed_bytes = std::int64_t{64} * 1024 * 1024;

/// The text after `key`, without the blanks; empty when there is none.
std::string_view behind(std::string_view text, std::string_view key) {
  const auto found = text.find(key);
  if (found == std::string_view::npos) return {};
  text.remove_prefix(found + key.size());
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  return text.substr(0, text.find_first_of(" \t\n"));
}

/// Whether this process has a capability; empty when the kernel does not say.
std::optional<bool> has_capability(const Machine& machine, int capability) {
  const auto status = read_text(machine.proc + "/self/status");
  if (!status) return {};
  const std::string_view mask = behind(*status, "CapEff:");
  std::uint64_t bits = 0;
  const auto [end, error] = std::from_chars(mask.data(), mask.data() + mask.size(), bits, 16);
  if (error != std::errc{} || end != mask.data() + mask.size()) return {};
  return ((bits >> static_cast<unsigned>(capability)) & 1U) != 0;
}

Finding finding(const std::string& what, const SetupStep& step) {
  if (step.succeeded) return {what, Severity::ok, step.step, ""};
  return {what, Severity::warning, "not " + step.step + ": " + step.reason, step.remedy};
}

}  // namespace

void check_priority(const Machine& machine, const LoopThreadSettings& settings,
                    const hal::FindingSink& sink) {
  SetupStep step;
  const auto tried = Thread::start({"doctor"}, [&] {
                       step = set_fifo_priority(::pthread_self(), settings.priority);
                     }).map([](Thread&&) {});
  if (!tried) step = {"a thread", false, tried.error().text(), "free memory"};
  Finding result = finding("priority", step);
  if (!step.succeeded && has_capability(machine, CAP_SYS_NICE).value_or(false)) {
    result.found += ", despite CAP_SYS_NICE";
    result.remedy =
        "the control group has no real-time share (CONFIG_RT_GROUP_SCHED): give it one in "
        "cpu.rt_runtime_us, or run outside the container";
  }
  sink(result);
}

void check_locked_memory(const Machine& machine, const hal::FindingSink& sink) {
  const std::string what = "locked memory";
  const std::string wanted = std::to_string(needed_bytes / (std::int64_t{1024} * 1024)) + " MiB";
  if (has_capability(machine, CAP_IPC_LOCK).value_or(false)) {
    sink({what, Severity::ok, "without limit (CAP_IPC_LOCK)", ""});
    return;
  }
  const auto limits = read_text(machine.proc + "/self/limits");
  const std::string_view limit = limits ? behind(*limits, "Max locked memory") : std::string_view{};
  const Number bytes = parse_number(limit);
  const bool enough = bytes.status == hal::Status::ok && bytes.value >= needed_bytes;
  if (limit == "unlimited" || enough) {
    sink({what, Severity::ok, "limit " + std::string(limit), ""});
  } else if (bytes.status != hal::Status::ok) {
    sink({what, Severity::warning,
          "the limit is not known: no number in " + machine.proc + "/self/limits",
          "run as root, or LimitMEMLOCK=infinity in the service"});
  } else {
    sink({what, Severity::warning,
          "the limit is " + std::string(limit) + " bytes; " + wanted + " are always enough",
          "run as root, or LimitMEMLOCK=infinity in the service"});
  }
}

void check_cpu_latency(const Machine& machine, const hal::FindingSink& sink) {
  CpuLatencyRequest cpus;
  sink(finding("deep sleep", cpus.hold(machine.dev + "/cpu_dma_latency")));
}

}  // namespace supercoil::hal_linux
