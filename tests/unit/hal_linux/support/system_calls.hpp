// Failures of system calls, for tests. The linker (-Wl,--wrap) routes the calls of the code under
// test through here; the code itself does not know.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

namespace supercoil::test {

/// The calls that can be intercepted.
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

/// The result of an intercepted call: 0 or more, or a negated errno, as in the kernel.
using Answer = std::function<long()>;

/// The next call on a file whose path ends with `path` (any file: "") returns this instead of doing
/// anything; several answers are used in the order in which they were set.
void next(Call call, std::string_view path, Answer answer);
/// The same, with an error for each of the next `times` calls.
void fail_next(Call call, std::string_view path, int error, int times = 1);
/// The number of pending answers; a test that expects all of them to be used checks for 0.
std::size_t waiting();

/// Like a driver behind a file: gets every write to an attribute and answers as the kernel does
/// (bytes, or a negated errno). Empty: files are plain files.
using Driver = std::function<long(const std::string& path, std::string_view text)>;
void set_driver(Driver driver);

/// Gets every ioctl: the request's number and its argument.
using Control = std::function<long(unsigned long request, void* argument)>;
void set_control(Control control);

/// Like the kernel at the other end of a netlink socket: returns the answer to a message.
using Netlink = std::function<std::vector<std::byte>(const std::vector<std::byte>& question)>;
void set_netlink(Netlink netlink);

/// Every device that is looked up has these numbers; its own when both are 0.
void set_device(unsigned major, unsigned minor);

/// Removes all of the above.
void reset_calls();

}  // namespace supercoil::test
