// What an errno means to the loop.
#pragma once

#include "supercoil/hal/status.hpp"

namespace supercoil::hal_linux {

/// EBUSY, ENOBUFS busy; ENODEV, ENXIO, ESHUTDOWN, ENETDOWN gone; EAGAIN not ready; all others,
/// EINVAL too, io_error.
hal::Status status_of(int error) noexcept;

}  // namespace supercoil::hal_linux
