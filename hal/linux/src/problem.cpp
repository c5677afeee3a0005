#include "supercoil/hal_linux/problem.hpp"

#include <cerrno>
#include <system_error>

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

tl::unexpected<Problem> problem(std::string text) {
  return tl::unexpected<Problem>(Problem{0, std::move(text)});
}

tl::unexpected<Problem> problem(std::string text, int error) {
  text += ": " + std::generic_category().message(error);
  return tl::unexpected<Problem>(Problem{error, std::move(text)});
}

}  // namespace supercoil::hal_linux
