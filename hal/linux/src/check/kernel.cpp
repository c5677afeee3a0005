#include <array>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <sys/utsname.h>

#include "supercoil/hal_linux/attribute.hpp"
#include "supercoil/hal_linux/checks.hpp"
#include "supercoil/hal_linux/device_folder.hpp"

namespace supercoil::hal_linux {

namespace {

using hal::Severity;

/// "0-2,5" holds 1.
bool in_list(const std::string& list, int number) {
  std::istringstream ranges(list);
  for (std::string range; std::getline(ranges, range, ',');) {
    std::istringstream ends(range);
    int first = 0;
    int last = 0;
    char dash = 0;
    if (!(ends >> first)) continue;
    if (!(ends >> dash >> last)) last = first;
    if (number >= first && number <= last) return true;
  }
  return false;
}

/// Debian's real-time kernel package for this architecture.
std::string realtime_package() {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 4> packages{
      {{"x86_64", "linux-image-rt-amd64"},
       {"aarch64", "linux-image-rt-arm64"},
       {"armv7l", "linux-image-rt-armmp"},
       {"i686", "linux-image-rt-686-pae"}}};
  utsname machine{};
  const std::string_view architecture = ::uname(&machine) == 0 ? &machine.machine[0] : "";
  for (const auto& [of, package] : packages) {
    if (architecture == of) return std::string(package);
  }
  return "linux-image-rt-… (apt-cache search linux-image-rt)";
}

}  // namespace

void check_kernel(const Machine& machine, const hal::FindingSink& sink) {
  const auto release = read_text(machine.proc + "/sys/kernel/osrelease");
  const std::string name = release.value_or("of unknown release");
  const auto realtime = read_integer(machine.sys + "/kernel/realtime");
  if (realtime && *realtime == 1) {
    sink({"kernel", Severity::ok, name + ", real-time (PREEMPT_RT)", ""});
    return;
  }
  sink({"kernel", Severity::warning,
        name + ", not a real-time kernel (" + machine.sys + "/kernel/realtime is not 1)",
        "install a kernel with PREEMPT_RT, on Debian " + realtime_package() +
            ": this one may wake the loop milliseconds late when the board is busy"});
}

void check_throttling(const Machine& machine, const hal::FindingSink& sink) {
  constexpr std::int64_t min_percent = 90;
  const std::string what = "real-time share";
  const std::string path = machine.proc + "/sys/kernel/sched_rt_runtime_us";
  const auto runtime_us = read_integer(path);
  const auto period_us = read_integer(machine.proc + "/sys/kernel/sched_rt_period_us");
  if (!runtime_us || !period_us || *period_us <= 0) {
    const std::string why = runtime_us ? path + " has no period" : runtime_us.error().text();
    sink({what, Severity::warning, "not known: " + why, "use a kernel that reports it"});
    return;
  }
  if (*runtime_us < 0) {
    sink({what, Severity::ok, "real-time threads may use all of the processor", ""});
    return;
  }
  const std::int64_t percent = 100 * *runtime_us / *period_us;
  const std::string found = "real-time threads may use " + std::to_string(percent) + " % of each " +
                            std::to_string(*period_us) + " us";
  if (percent >= min_percent) {
    sink({what, Severity::ok, found, ""});
  } else {
    sink({what, percent == 0 ? Severity::problem : Severity::warning,
          found + ", then they are throttled", "sysctl kernel.sched_rt_runtime_us=950000"});
  }
}

void check_governor(const Machine& machine, const hal::FindingSink& sink) {
  const std::string what = "frequency";
  const std::string root = machine.sys + "/devices/system/cpu";
  const auto processors = numbered_folders(root, "cpu");
  std::map<std::string, std::vector<std::string>> by_governor;
  for (const DeviceFolder& processor : processors.value_or(std::vector<DeviceFolder>{})) {
    const auto governor = read_text(processor.folder + "/cpufreq/scaling_governor");
    if (governor) by_governor[*governor].push_back(base_name(processor.folder));
  }
  std::vector<std::string> slow;
  for (const auto& [governor, which] : by_governor)
    if (governor != "performance") slow.push_back("'" + governor + "' on " + listed(which));
  if (slow.empty()) {
    sink({what, Severity::ok,
          by_governor.empty() ? "fixed (no cpufreq in " + root + ")"
                              : "governor 'performance' on all processors",
          ""});
    return;
  }
  sink({what, Severity::warning, "governor " + listed(slow),
        "echo performance | tee " + root +
            "/cpu*/cpufreq/scaling_governor: a processor that slows down makes ticks late"});
}

void check_processors(const Machine& machine, const LoopThreadSettings& settings,
                      const hal::FindingSink& sink) {
  const std::string what = "processors";
  const std::string root = machine.sys + "/devices/system/cpu";
  const std::string online = read_text(root + "/online").value_or("");
  // An empty attribute reads as an error: no processor is isolated.
  const std::string isolated = read_text(root + "/isolated").value_or("");
  const std::string found = "running " + (online.empty() ? std::string("unknown") : online) +
                            ", isolated " + (isolated.empty() ? std::string("none") : isolated);
  if (settings.cpu < 0 || in_list(isolated, settings.cpu)) {
    sink({what, Severity::ok, found, ""});
  } else if (!in_list(online, settings.cpu)) {
    sink({what, Severity::problem,
          found + ": CPU " + std::to_string(settings.cpu) + " is not running",
          "choose another --cpu"});
  } else {
    const std::string cpu = std::to_string(settings.cpu);
    sink({what, Severity::warning, found + ": other work may run on the loop's CPU, " + cpu,
          "isolcpus=" + cpu + " on the kernel's command line"});
  }
}

}  // namespace supercoil::hal_linux
