// Why something could not be set up.
#pragma once

#include <string>
#include <utility>

#include <tl/expected.hpp>

#include "supercoil/hal/status.hpp"

namespace supercoil::hal_linux {

/// What an errno means to the firmware: EBUSY, ENOBUFS busy; ENODEV, ENXIO, ESHUTDOWN, ENETDOWN
/// gone; EAGAIN not ready; all others, EINVAL too, io_error.
hal::Status status_of(int error) noexcept;

/// A set-up that failed. Never made in a tick: it allocates.
struct Problem {
  int code = 0;      ///< errno's value; 0 when no call failed but something found was wrong
  std::string text;  ///< what was looked for, where, and what was found instead
};

template <class Value>
using Result = tl::expected<Value, Problem>;

/// A problem without an errno.
tl::unexpected<Problem> problem(std::string text);
/// "text: No such file or directory".
tl::unexpected<Problem> problem(std::string text, int error);

}  // namespace supercoil::hal_linux
