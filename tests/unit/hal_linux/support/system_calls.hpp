// Failures of system calls, for tests. The linker (-Wl,--wrap) sends the calls of the code under
// test through here; the code itself knows nothing of it.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

namespace supercoil::test {

/// The calls that can be made to fail.
enum class Call {
  open,
  access,
  pread,
  pwrite,
  read,
  write,
  ioctl,
  clock_nanosleep,
  mlockall,
  set_scheduling,  ///< pthread_setschedparam
  set_affinity,    ///< pthread_setaffinity_np
};

/// What an intercepted call answers: a result of 0 or more, or an errno negated, as in the kernel.
using Answer = std::function<long()>;

/// The next call on a file whose path ends with `path` (every file: "") answers this instead of
/// doing anything; several are answered in the order in which they were made.
void next(Call call, std::string_view path, Answer answer);
/// The same, for each of the next `times` calls.
void fail_next(Call call, std::string_view path, int error, int times = 1);
/// Answers still waiting: a test that expects all of them to be used asks for 0.
std::size_t waiting();

/// Like a driver behind a file: gets every write to an attribute, and answers as the kernel does
/// (bytes, or a negated errno). Empty: files are files.
using Driver = std::function<long(const std::string& path, std::string_view text)>;
void set_driver(Driver driver);

/// Gets every ioctl: number of the request and its argument.
using Control = std::function<long(unsigned long request, void* argument)>;
void set_control(Control control);

/// Like the kernel at the other end of a netlink socket: what it answers to a message.
using Netlink = std::function<std::vector<std::byte>(const std::vector<std::byte>& question)>;
void set_netlink(Netlink netlink);

/// Every device that is looked at has these numbers; its own when both are 0.
void set_device(unsigned major, unsigned minor);

/// Forgets all of it.
void reset_calls();

}  // namespace supercoil::test
