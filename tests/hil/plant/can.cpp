// supercoil-rig-can: the firmware's CAN bus on the emulated board, by hand.
//   supercoil-rig-can INTERFACE SEND_EVERY_MS SEND_ID LISTEN_ID...    (identifiers in hex; 0 ms:
//   never)
// Prints "frame INTERFACE ID BYTES SECONDS" (SECONDS: when it was received) and "state INTERFACE
// STATE SECONDS", on the clock of /proc/uptime; at SIGTERM "sent INTERFACE OK BUSY GONE".
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "supercoil/hal_linux/monotonic_clock.hpp"
#include "supercoil/hal_linux/socket_can.hpp"

namespace {

using namespace supercoil;

constexpr std::array<const char*, 4> state_names{"active", "error_passive", "bus_off", "down"};

void print_frame(const char* interface, const hal::CanFrame& frame) {
  std::printf("frame %s %x ", interface, unsigned{frame.id});
  for (std::size_t i = 0; i < frame.length; ++i)
    std::printf("%02x", unsigned{frame.data[i]});
  std::printf("%s %.6f\n", frame.length == 0 ? "-" : "", hal::seconds(frame.received));
}

struct Sent {
  long ok = 0;
  long busy = 0;
  long gone = 0;

  void add(hal::Status status) {
    if (status == hal::Status::ok) ++ok;
    if (status == hal::Status::busy) ++busy;
    if (status == hal::Status::gone) ++gone;
  }
};

void run(hal_linux::SocketCan& can, const char* interface, long every_ms, hal::CanFrame frame) {
  sigset_t ending;
  sigemptyset(&ending);
  sigaddset(&ending, SIGTERM);
  sigprocmask(SIG_BLOCK, &ending, nullptr);
  const timespec millisecond{0, 1'000'000};
  auto state = static_cast<hal::CanState>(-1);
  Sent sent;
  for (long ms = 1; sigtimedwait(&ending, nullptr, &millisecond) < 0; ++ms) {
    for (hal::CanFrame received; can.receive(received) == hal::Status::ok;)
      print_frame(interface, received);
    if (every_ms > 0 && ms % every_ms == 0) {
      ++frame.data[0];
      sent.add(can.send(frame));
    }
    if (can.state() == state) continue;
    state = can.state();
    std::printf("state %s %s %.6f\n", interface, state_names.at(static_cast<std::size_t>(state)),
                hal::seconds(hal_linux::MonotonicClock::time()));
  }
  std::printf("sent %s %ld %ld %ld\n", interface, sent.ok, sent.busy, sent.gone);
}

std::uint16_t identifier(const char* hex) {
  return static_cast<std::uint16_t>(std::strtoul(hex, nullptr, 16));
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 4) {
    std::fputs("supercoil-rig-can INTERFACE SEND_EVERY_MS SEND_ID LISTEN_ID...\n", stderr);
    return 2;
  }
  hal_linux::CanLocation place{arguments[1], {}};
  for (int i = 4; i < count; ++i)
    place.listen.push_back(identifier(arguments[i]));
  auto can = hal_linux::SocketCan::open(place);
  if (!can) {
    std::fprintf(stderr, "supercoil-rig-can: %s\n", can.error().text().c_str());
    return 1;
  }
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  run(**can, arguments[1], std::atol(arguments[2]), {identifier(arguments[3]), 2, {}, {}});
  return 0;
}
