#include <cstring>

#include <linux/can/netlink.h>
#include <linux/if_link.h>
#include <linux/rtnetlink.h>
#include <net/if.h>

#include <CppUTest/TestHarness.h>

#include "supercoil/hal_linux/checks.hpp"

#include "unit/hal_linux/check/findings.hpp"
#include "unit/hal_linux/support/system_calls.hpp"
#include "unit/hal_linux/support/temporary_folder.hpp"

using namespace supercoil;
using namespace supercoil::hal_linux;
using namespace supercoil::test;

namespace {

using Bytes = std::vector<std::byte>;

template <class Value>
Bytes bytes_of(const Value& value) {
  Bytes bytes(sizeof(Value));
  std::memcpy(bytes.data(), &value, sizeof(Value));
  return bytes;
}

Bytes operator+(Bytes first, const Bytes& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

/// Padded to four bytes, as the kernel does.
Bytes attribute(unsigned kind, const Bytes& content) {
  const rtattr header{static_cast<unsigned short>(sizeof(rtattr) + content.size()),
                      static_cast<unsigned short>(kind)};
  Bytes all = bytes_of(header) + content;
  all.resize((all.size() + 3) / 4 * 4);
  return all;
}

Bytes answer(const Bytes& attributes) {
  nlmsghdr header{};
  header.nlmsg_type = RTM_NEWLINK;
  return bytes_of(header) + bytes_of(ifinfomsg{}) + attributes;
}

Bytes can_at(std::uint32_t bit_rate) {
  can_bittiming timing{};
  timing.bitrate = bit_rate;
  const Bytes name = attribute(IFLA_IFNAME, Bytes(5));
  const Bytes kind = attribute(IFLA_INFO_KIND, Bytes(4));
  const Bytes data =
      attribute(IFLA_CAN_STATE, Bytes(4)) + attribute(IFLA_CAN_BITTIMING, bytes_of(timing));
  // The kernel marks attributes that contain others.
  const Bytes info = attribute(IFLA_INFO_DATA | NLA_F_NESTED, data);
  return answer(name + attribute(IFLA_LINKINFO, kind + info));
}

}  // namespace

TEST_GROUP(CheckCanLink) {
  TemporaryFolder root;
  const Machine machine{root / "proc", root / "sys", root / "dev"};
  // No machine has this interface, so it has no bit rate either.
  const std::string folder = "sys/class/net/supercoil-no0/";

  void setup() override {
    root.write(folder + "type", "280\n");
    root.write(folder + "flags", "0x40081\n");
    root.write(folder + "carrier", "1\n");
    root.write(folder + "tx_queue_len", "1000\n");
    root.write("sys/class/net/eth0/type", "1\n");
  }
  hal::Finding found(const std::string& interface = "supercoil-no0") const {
    CollectedFindings collected;
    check_can_interface(machine, interface, collected.sink());
    LONGS_EQUAL(1, collected.findings.size());
    return collected.findings.front();
  }
};

TEST(CheckCanLink, AcceptsAGoodInterface) {
  check_finding("ok", "up, no bit rate, queue of 1000 frames", "", found());
  STRCMP_EQUAL("CAN supercoil-no0", found().what.c_str());
}

TEST(CheckCanLink, ListsTheAvailableInterfaces) {
  check_finding("problem",
                "no interface 'can0' in " + root / "sys/class/net" + ": there are eth0, supercoil",
                "load its driver", found("can0"));
  check_finding("problem", "type is 1: not CAN (280)", "name the right interface", found("eth0"));
}

TEST(CheckCanLink, SaysHowToBringItUp) {
  root.write(folder + "flags", "0x40080\n");
  check_finding("problem", "down", "ip link set supercoil-no0 up type can bitrate", found());
  root.write(folder + "flags", "0x40081\n");
  root.write(folder + "carrier", "0\n");
  check_finding("problem", "off the bus", "wires", found());
  root.remove(folder + "carrier");
  check_finding("problem", "off the bus", "wires", found());
}

TEST(CheckCanLink, WarnsOfAShortQueue) {
  root.write(folder + "tx_queue_len", "10\n");
  check_finding("warning", "queue of 10 frames", "txqueuelen 1000", found());
}

TEST(CheckCanLink, FindsTheBitRateInTheKernelsAnswer) {
  LONGS_EQUAL(500000, *bit_rate_in(can_at(500000)));
  CHECK_FALSE(bit_rate_in(can_at(0)).has_value());
  CHECK_FALSE(bit_rate_in(answer(attribute(IFLA_IFNAME, Bytes(6)))).has_value());
  // Truncated anywhere, or with a length that leads nowhere: no rate and no harm.
  const Bytes whole = can_at(500000);
  for (std::size_t size = 0; size + sizeof(can_bittiming) < whole.size(); ++size)
    CHECK_FALSE(bit_rate_in(Bytes(whole.begin(), whole.begin() + static_cast<long>(size))));
  for (std::size_t i = sizeof(nlmsghdr) + sizeof(ifinfomsg); i < whole.size(); ++i) {
    for (const int value : {0, 1, 255}) {
      Bytes damaged = whole;
      damaged[i] = static_cast<std::byte>(value);
      static_cast<void>(bit_rate_in(damaged));
    }
  }
}

TEST(CheckCanLink, RequestsTheBitRateOfThisInterface) {
  set_netlink([](const Bytes& question) {
    nlmsghdr header{};
    ifinfomsg link{};
    CHECK(question.size() >= sizeof(header) + sizeof(link));
    std::memcpy(&header, question.data(), sizeof(header));
    std::memcpy(&link, question.data() + sizeof(header), sizeof(link));
    UNSIGNED_LONGS_EQUAL(question.size(), header.nlmsg_len);
    LONGS_EQUAL(RTM_GETLINK, header.nlmsg_type);
    // Without this flag the kernel does not answer.
    CHECK((header.nlmsg_flags & NLM_F_REQUEST) != 0);
    LONGS_EQUAL(if_nametoindex("lo"), link.ifi_index);
    return can_at(250000);
  });
  // Every machine has this interface; it has a bit rate only in this test.
  const auto rate = can_bit_rate("lo");
  CHECK(rate.has_value());
  UNSIGNED_LONGS_EQUAL(250000, *rate);
  set_netlink([](const Bytes&) { return answer({}); });
  CHECK_FALSE(can_bit_rate("lo").has_value());
  reset_calls();
}
