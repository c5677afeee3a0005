#include "supercoil/hal_linux/status_of.hpp"

#include <cerrno>

namespace supercoil::hal_linux {

hal::Status status_of(int error) noexcept {
  switch (error) {
    case 0:
      return hal::Status::ok;
    case EBUSY:
    case ENOBUFS:
      return hal::Status::busy;
    case ENETDOWN:
    case ENODEV:
    case ENXIO:
    case ESHUTDOWN:
      return hal::Status::gone;
    case EAGAIN:
      return hal::Status::not_ready;
    default:
      return hal::Status::io_error;
  }
}

}  // namespace supercoil::hal_linux
