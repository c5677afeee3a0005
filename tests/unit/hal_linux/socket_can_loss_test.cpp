// An interface that goes down, vanishes, and comes back.
#include <cerrno>
#include <thread>

#include <CppUTest/TestHarness.h>

#include "supercoil/hal_linux/monotonic_clock.hpp"
#include "supercoil/hal_linux/socket_can.hpp"

#include "unit/hal_linux/support/can_kernel.hpp"
#include "unit/hal_linux/support/system_calls.hpp"

using namespace supercoil;
using namespace supercoil::hal_linux;
using namespace supercoil::test;
using namespace std::chrono_literals;

TEST_GROUP(SocketCanLoss) {
  CanKernel kernel;
  CanLocation place{"can0", {0x201}, kernel.net.path()};
  hal::CanFrame frame;
  std::unique_ptr<SocketCan> can;

  void setup() override {
    kernel.plug("can0", 3);
    open();
  }
  void teardown() override {
    reset_calls();
  }
  void open() {
    auto opened = SocketCan::open(place);
    if (!opened) FAIL(opened.error().text().c_str());
    can = std::move(*opened);
  }
  static void check(hal::Status expected, hal::Status status) {
    STRCMP_EQUAL(hal::text(expected), hal::text(status));
  }
  void check_gone() {
    check(hal::Status::gone, can->receive(frame));
    check(hal::Status::gone, can->send({0x201, 0, {}, {}}));
    CHECK(can->state() == hal::CanState::down);
  }
  void wait_for_next_retry() const {
    std::this_thread::sleep_for(110ms);
  }
  void check_receives() {
    check(hal::Status::not_ready, can->receive(frame));
    CHECK(can->state() == hal::CanState::active);
    kernel.deliver(0x201, {5});
    check(hal::Status::ok, can->receive(frame));
    LONGS_EQUAL(5, frame.data[0]);
  }
};

TEST(SocketCanLoss, InterfaceThatComesUpAgainIsReceivedAgain) {
  kernel.set_down("can0");
  check_gone();
  kernel.set_up("can0");
  wait_for_next_retry();
  check_receives();
}

TEST(SocketCanLoss, InterfaceThatVanishedComesBackUnderAnotherNumber) {
  kernel.unplug("can0");
  check_gone();
  wait_for_next_retry();
  check_gone();
  kernel.plug("can0", 9);
  wait_for_next_retry();
  check_receives();
  LONGS_EQUAL(9, kernel.bound_to);
  LONGS_EQUAL(1, kernel.filters.size());  // set on the new socket too
}

TEST(SocketCanLoss, IsDetectedBySendingToo) {
  for (const int error : {ENETDOWN, ENXIO, ENODEV}) {
    fail_next(Call::write, "", error);
    check(hal::Status::gone, can->send({0x201, 0, {}, {}}));
    CHECK(can->state() == hal::CanState::down);
    wait_for_next_retry();
    check(hal::Status::ok, can->send({0x201, 0, {}, {}}));
    CHECK(can->state() == hal::CanState::active);
  }
}

TEST(SocketCanLoss, RetriesRarely) {
  kernel.set_down("can0");
  check_gone();
  kernel.set_up("can0");
  kernel.option_error = ENOMEM;  // every attempt opens a socket in vain
  const int before = kernel.sockets;
  const hal::Time begin = MonotonicClock::time();
  long calls = 0;
  while (MonotonicClock::time() - begin < 350ms) {
    check(hal::Status::gone, can->receive(frame));
    ++calls;
  }
  const auto max_looks = (MonotonicClock::time() - begin) / 100ms + 1;
  CHECK(calls > 10 * max_looks);
  CHECK(kernel.sockets - before <= max_looks);
  CHECK(kernel.sockets - before >= 1);
}

TEST(SocketCanLoss, InterfaceThatIsDownAtFirstMayComeUpLater) {
  kernel.set_down("can0");
  kernel.receive_errors.clear();  // no socket is open that could receive it
  open();
  check_gone();
  kernel.set_up("can0");
  wait_for_next_retry();
  check_receives();
}

TEST(SocketCanLoss, ControllerAlreadyBusOffIsReported) {
  kernel.lose_carrier("can0");
  open();
  check(hal::Status::not_ready, can->receive(frame));
  CHECK(can->state() == hal::CanState::bus_off);
}

TEST(SocketCanLoss, FailuresDuringRecoveryAreRetried) {
  kernel.set_down("can0");
  check_gone();
  kernel.set_up("can0");
  kernel.option_error = ENOMEM;
  wait_for_next_retry();
  check_gone();
  kernel.option_error = 0;
  wait_for_next_retry();
  check_receives();
}
