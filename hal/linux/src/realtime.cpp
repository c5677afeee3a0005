#include "supercoil/hal_linux/realtime.hpp"

#include <array>
#include <cerrno>
#include <cstdint>
#include <system_error>

#include <fcntl.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

namespace supercoil::hal_linux {

namespace {

std::string message(int error) {
  return std::generic_category().message(error);
}

SetupStep outcome(std::string step, const std::string& reason, const std::string& remedy) {
  const bool succeeded = reason.empty();
  return {std::move(step), succeeded, reason, succeeded ? std::string{} : remedy};
}

std::string limit_text(__rlimit_resource resource) {
  rlimit limit{};
  if (::getrlimit(resource, &limit) != 0) return "unknown";
  return limit.rlim_cur == RLIM_INFINITY ? "unlimited" : std::to_string(limit.rlim_cur);
}

}  // namespace

SetupStep lock_memory() {
  const int done = ::mlockall(MCL_CURRENT | MCL_FUTURE);
  const std::string reason = done == 0 ? ""
                                       : message(errno) + "; the limit of locked memory is " +
                                             limit_text(RLIMIT_MEMLOCK) + " bytes";
  return outcome("memory locked", reason, "run as root, or LimitMEMLOCK=infinity in the service");
}

SetupStep set_fifo_priority(pthread_t thread, int priority) {
  const std::string step = "priority " + std::to_string(priority) + " of SCHED_FIFO";
  sched_param wanted{};
  wanted.sched_priority = priority;
  const int error = ::pthread_setschedparam(thread, SCHED_FIFO, &wanted);
  if (error == EINVAL) return outcome(step, message(error), "choose a priority of 1 to 99");
  const std::string remedy = "run as root, or LimitRTPRIO=99 in the service";
  if (error != 0) {
    return outcome(step, message(error) + "; the limit of priority is " + limit_text(RLIMIT_RTPRIO),
                   remedy);
  }
  // Some sandboxes accept it and do nothing.
  int policy = 0;
  sched_param now{};
  const bool taken = ::pthread_getschedparam(thread, &policy, &now) == 0 && policy == SCHED_FIFO &&
                     now.sched_priority == priority;
  return outcome(step, taken ? "" : "accepted, but the thread does not have it", remedy);
}

SetupStep pin_to_cpu(pthread_t thread, int cpu) {
  const std::string step = "on CPU " + std::to_string(cpu) + " alone";
  const std::string remedy =
      "choose one of the " + std::to_string(::sysconf(_SC_NPROCESSORS_ONLN)) +
      " CPUs that run, counted from 0, and are within the service's AllowedCPUs=";
  if (cpu < 0 || cpu >= CPU_SETSIZE) return outcome(step, message(EINVAL), remedy);
  cpu_set_t wanted;
  CPU_ZERO(&wanted);
  CPU_SET(static_cast<std::size_t>(cpu), &wanted);
  const int error = ::pthread_setaffinity_np(thread, sizeof(wanted), &wanted);
  if (error != 0) return outcome(step, message(error), remedy);
  cpu_set_t now;
  const bool taken =
      ::pthread_getaffinity_np(thread, sizeof(now), &now) == 0 && CPU_EQUAL(&now, &wanted) != 0;
  return outcome(step, taken ? "" : "accepted, but the thread may run elsewhere", remedy);
}

SetupStep CpuLatencyRequest::hold(const std::string& path) {
  const std::string step = "CPUs kept from deep sleep";
  const std::string remedy = "run as root, or allow writing to " + path;
  auto opened = open_file(path, O_WRONLY | O_NONBLOCK);
  if (!opened) return outcome(step, opened.error().text(), remedy);
  // A binary number of microseconds; it holds for as long as the file is open.
  const std::array<char, sizeof(std::int32_t)> zero{};
  const auto written = write_next(*opened, zero.data(), zero.size());
  if (written != hal::Status::ok) {
    return outcome(step, "cannot write to " + path + ": " + text(written), remedy);
  }
  file_ = std::move(*opened);
  return outcome(step, "", "");
}

}  // namespace supercoil::hal_linux
