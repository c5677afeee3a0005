// How a call to a device went.
#pragma once

namespace supercoil::hal {

/// A device's answer. Errors are values: nothing in hal throws, and nothing allocates in a tick.
enum class Status {
  ok,
  not_ready,     ///< no value yet, or the last one was already taken
  busy,          ///< another program uses the device (EBUSY)
  io_error,      ///< the device answered wrongly or not at all (EIO, a short write)
  gone,          ///< the device is no longer there (ENODEV)
  out_of_range,  ///< the argument is not one that the device can take; nothing was changed
};

/// In words, for people.
constexpr const char* text(Status status) {
  switch (status) {
    case Status::ok:
      return "ok";
    case Status::not_ready:
      return "not ready";
    case Status::busy:
      return "busy";
    case Status::io_error:
      return "input/output error";
    case Status::gone:
      return "device gone";
    case Status::out_of_range:
      return "out of range";
  }
  return "?";
}

}  // namespace supercoil::hal
