#include "supercoil/hal_linux/socket_can.hpp"

#include <cerrno>
#include <ctime>
#include <thread>

#include <linux/can/error.h>
#include <linux/can/raw.h>

#include <CppUTest/TestHarness.h>

#include "supercoil/hal_linux/monotonic_clock.hpp"

#include "unit/hal_linux/support/can_kernel.hpp"
#include "unit/hal_linux/support/system_calls.hpp"

using namespace supercoil;
using namespace supercoil::hal_linux;
using namespace supercoil::test;
using namespace std::chrono_literals;

TEST_GROUP(SocketCan) {
  CanKernel kernel;
  CanLocation place{"can0", {0x201, 0x202}, kernel.net.path()};
  hal::CanFrame frame;

  void setup() override {
    kernel.plug("can0", 3);
  }
  void teardown() override {
    reset_calls();
  }
  std::unique_ptr<SocketCan> opened() const {
    auto can = SocketCan::open(place);
    if (!can) FAIL(can.error().text().c_str());
    return std::move(*can);
  }
  std::string problem_of_opening() const {
    const auto can = SocketCan::open(place);
    return can ? "" : can.error().text();
  }
  static void check(hal::Status expected, hal::Status status) {
    STRCMP_EQUAL(hal::text(expected), hal::text(status));
  }
};

TEST(SocketCan, ReceivesOnlyItsIdentifiersAndControllerErrors) {
  const auto can = opened();
  LONGS_EQUAL(2, kernel.filters.size());
  LONGS_EQUAL(0x202, kernel.filters[1].can_id);
  UNSIGNED_LONGS_EQUAL(CAN_EFF_FLAG | CAN_RTR_FLAG | 0x7FF, kernel.filters[1].can_mask);
  UNSIGNED_LONGS_EQUAL(CAN_ERR_CRTL | CAN_ERR_BUSOFF | CAN_ERR_RESTARTED, kernel.reported_errors);
  LONGS_EQUAL(3, kernel.bound_to);
  CHECK(can->state() == hal::CanState::active);
}

TEST(SocketCan, ReceivesNothingOrEverythingWithoutAList) {
  place.listen.clear();
  static_cast<void>(opened());
  LONGS_EQUAL(0, kernel.filters.size());
  place.listen_to_all = true;
  static_cast<void>(opened());
  LONGS_EQUAL(1, kernel.filters.size());
  LONGS_EQUAL(0, kernel.filters[0].can_id);
  UNSIGNED_LONGS_EQUAL(CAN_EFF_FLAG | CAN_RTR_FLAG, kernel.filters[0].can_mask);
}

TEST(SocketCan, ReturnsFramesInOrderAndThenNothing) {
  const auto can = opened();
  kernel.deliver(0x201, {1, 2, 3});
  kernel.deliver(0x202);
  check(hal::Status::ok, can->receive(frame));
  LONGS_EQUAL(0x201, frame.id);
  LONGS_EQUAL(3, frame.length);
  CHECK((frame.data == std::array<std::uint8_t, 8>{1, 2, 3}));
  check(hal::Status::ok, can->receive(frame));
  LONGS_EQUAL(0x202, frame.id);
  LONGS_EQUAL(0, frame.length);
  CHECK((frame.data == std::array<std::uint8_t, 8>{}));  // nothing is left of the previous frame
  check(hal::Status::not_ready, can->receive(frame));
}

TEST(SocketCan, FrameKeepsItsTimeOfArrival) {
  const auto can = opened();
  const hal::Time before = MonotonicClock::time();
  kernel.deliver(0x201, {1});
  const hal::Time after = MonotonicClock::time();
  std::this_thread::sleep_for(200ms);
  check(hal::Status::ok, can->receive(frame));
  // The two clocks are read one after the other, and a busy machine may delay in between.
  CHECK(frame.received > before - 100ms);
  CHECK(frame.received < after + 100ms);
}

TEST(SocketCan, SendsAFrameUnchanged) {
  const auto can = opened();
  check(hal::Status::ok, can->send({0x7FF, 8, {1, 2, 3, 4, 5, 6, 7, 8}, {}}));
  check(hal::Status::ok, can->send({0, 1, {9, 9, 9}, {}}));
  const auto first = kernel.sent();
  UNSIGNED_LONGS_EQUAL(0x7FF, first->can_id);
  LONGS_EQUAL(8, first->len);
  LONGS_EQUAL(8, first->data[7]);
  const auto second = kernel.sent();
  LONGS_EQUAL(1, second->len);
  LONGS_EQUAL(0, second->data[1]);  // bytes beyond the length are not sent
}

TEST(SocketCan, RefusesInvalidFrames) {
  const auto can = opened();
  check(hal::Status::out_of_range, can->send({0x800, 0, {}, {}}));
  check(hal::Status::out_of_range, can->send({0x201, 9, {}, {}}));
  CHECK_FALSE(kernel.sent().has_value());
}

TEST(SocketCan, FullQueueIsBusyAndNothingElseChanges) {
  const auto can = opened();
  for (const int error : {ENOBUFS, EAGAIN}) {
    fail_next(Call::write, "", error);
    check(hal::Status::busy, can->send({0x201, 0, {}, {}}));
  }
  check(hal::Status::ok, can->send({0x201, 0, {}, {}}));
  LONGS_EQUAL(1, kernel.sockets);
  CHECK(can->state() == hal::CanState::active);
}

TEST(SocketCan, SkipsFramesOfOtherKinds) {
  const auto can = opened();
  kernel.deliver(0x201 | CAN_EFF_FLAG, {1});
  kernel.deliver(0x201 | CAN_RTR_FLAG);
  canfd_frame fd{};
  fd.can_id = 0x201;
  fd.len = 8;  // the packet itself is longer
  kernel.deliver(&fd, sizeof(fd));
  kernel.deliver(&fd, 7);  // part of a frame
  kernel.deliver(&fd, 0);
  can_frame too_long{};
  too_long.can_id = 0x201;
  too_long.len = 255;
  kernel.deliver(&too_long, sizeof(too_long));
  kernel.deliver(0x202, {7});
  check(hal::Status::ok, can->receive(frame));
  LONGS_EQUAL(0x202, frame.id);
  LONGS_EQUAL(7, frame.data[0]);
}

TEST(SocketCan, IsNotBlockedByAFloodOfThem) {
  const auto can = opened();
  kernel.flood = 1000;
  check(hal::Status::not_ready, can->receive(frame));
  LONGS_EQUAL(1000 - 64, kernel.flood);
}

TEST(SocketCan, FollowsTheControllersErrorFrames) {
  const auto can = opened();
  const auto state_after = [&](std::uint32_t kind, std::uint8_t detail) {
    kernel.deliver(CAN_ERR_FLAG | kind, {0, detail, 0, 0, 0, 0, 0, 0});
    check(hal::Status::not_ready, can->receive(frame));
    return can->state();
  };
  CHECK(hal::CanState::active == state_after(CAN_ERR_CRTL, CAN_ERR_CRTL_TX_WARNING));
  CHECK(hal::CanState::error_passive == state_after(CAN_ERR_CRTL, CAN_ERR_CRTL_RX_PASSIVE));
  CHECK(hal::CanState::error_passive == state_after(CAN_ERR_CRTL, CAN_ERR_CRTL_RX_OVERFLOW));
  CHECK(hal::CanState::active == state_after(CAN_ERR_CRTL, CAN_ERR_CRTL_ACTIVE));
  for (const std::uint8_t warning :
       {std::uint8_t{CAN_ERR_CRTL_RX_WARNING}, std::uint8_t{CAN_ERR_CRTL_TX_WARNING}}) {
    CHECK(hal::CanState::error_passive == state_after(CAN_ERR_CRTL, CAN_ERR_CRTL_TX_PASSIVE));
    CHECK(hal::CanState::active == state_after(CAN_ERR_CRTL, warning));
  }
  CHECK(hal::CanState::bus_off == state_after(CAN_ERR_BUSOFF, 0));
  CHECK(hal::CanState::bus_off == state_after(CAN_ERR_TX_TIMEOUT, 0));
  CHECK(hal::CanState::active == state_after(CAN_ERR_RESTARTED, 0));
}

TEST(SocketCan, ReceptionProvesThatBusOffHasPassed) {
  const auto can = opened();
  kernel.deliver(CAN_ERR_FLAG | CAN_ERR_BUSOFF, {0, 0, 0, 0, 0, 0, 0, 0});
  kernel.from_this_machine = true;
  kernel.deliver(0x201);
  check(hal::Status::ok, can->receive(frame));
  CHECK(can->state() == hal::CanState::bus_off);  // a frame from this machine is no proof
  kernel.from_this_machine = false;
  kernel.deliver(0x201);
  check(hal::Status::ok, can->receive(frame));
  CHECK(can->state() == hal::CanState::active);
}

TEST(SocketCan, OtherErrorsOfTheSocketAreReported) {
  const auto can = opened();
  kernel.receive_errors = {EIO};
  check(hal::Status::io_error, can->receive(frame));
  fail_next(Call::write, "", EINVAL);
  check(hal::Status::io_error, can->send({0x201, 0, {}, {}}));
  kernel.receive_errors = {EINTR, EINTR};
  kernel.deliver(0x201);
  check(hal::Status::ok, can->receive(frame));
  LONGS_EQUAL(1, kernel.sockets);
}

TEST(SocketCan, ListsTheAvailableInterfaces) {
  kernel.plug("can1", 4);
  kernel.plug("eth0", 2, 1);
  place.interface = "can7";
  STRCMP_EQUAL("no CAN interface 'can7': there are can0, can1", problem_of_opening().c_str());
  place.interface = "eth0";
  STRCMP_EQUAL("no CAN interface 'eth0': there are can0, can1", problem_of_opening().c_str());
  kernel.unplug("can0");
  kernel.unplug("can1");
  STRCMP_EQUAL("no CAN interface 'eth0': there is none", problem_of_opening().c_str());
}

TEST(SocketCan, ReportsWhatCannotBeSetUp) {
  kernel.socket_error = EAFNOSUPPORT;
  STRCMP_CONTAINS("no CAN sockets (kernel modules can, can-raw): Address family",
                  problem_of_opening().c_str());
  kernel.socket_error = 0;
  kernel.option_error = EPERM;
  STRCMP_CONTAINS("cannot set up a CAN socket: receive filters: ", problem_of_opening().c_str());
}

TEST(SocketCan, RefusesInvalidPlaces) {
  place.listen = {0x800};
  STRCMP_EQUAL("can0: 2048 is not an 11-bit identifier (0 to 2047)", problem_of_opening().c_str());
  place.listen.assign(513, 1);
  STRCMP_EQUAL("can0: listens to 513 identifiers; the maximum is 512",
               problem_of_opening().c_str());
  for (const char* name : {"", "../can0", "sixteen_letters_"}) {
    place = {name, {}, kernel.net.path()};
    STRCMP_CONTAINS("is not a network interface name", problem_of_opening().c_str());
  }
  LONGS_EQUAL(0, kernel.sockets);
}
