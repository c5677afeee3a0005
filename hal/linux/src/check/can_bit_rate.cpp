// The bit rate of a CAN interface: sysfs does not show it, so the kernel is asked by rtnetlink(7).
#include <cstring>

#include <linux/can/netlink.h>
#include <linux/if_link.h>
#include <linux/rtnetlink.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include "supercoil/hal_linux/checks.hpp"
#include "supercoil/hal_linux/descriptor.hpp"

namespace supercoil::hal_linux {

namespace {

/// Part of an answer.
struct Bytes {
  const std::byte* begin;
  std::size_t size;
};

template <class Value>
std::optional<Value> value_at(Bytes bytes, std::size_t offset) {
  if (offset > bytes.size || bytes.size - offset < sizeof(Value)) return {};
  Value value{};
  std::memcpy(&value, bytes.begin + offset, sizeof(Value));
  return value;
}

/// The contents of the first attribute of this kind.
std::optional<Bytes> attribute(Bytes all, unsigned kind) {
  constexpr std::size_t aligned = 3;
  for (std::size_t offset = 0; const auto header = value_at<rtattr>(all, offset);) {
    if (header->rta_len < sizeof(rtattr) || header->rta_len > all.size - offset) return {};
    if ((header->rta_type & NLA_TYPE_MASK) == kind) {
      return Bytes{all.begin + offset + sizeof(rtattr), header->rta_len - sizeof(rtattr)};
    }
    offset += (header->rta_len + aligned) & ~aligned;
  }
  return {};
}

struct Question {
  nlmsghdr header{};
  ifinfomsg link{};
};

}  // namespace

std::optional<std::uint32_t> bit_rate_in(const std::vector<std::byte>& answer) {
  const Bytes all{answer.data(), answer.size()};
  const auto header = value_at<nlmsghdr>(all, 0);
  constexpr std::size_t before = sizeof(nlmsghdr) + sizeof(ifinfomsg);
  if (!header || header->nlmsg_type != RTM_NEWLINK || answer.size() < before) return {};
  std::optional<Bytes> part = Bytes{all.begin + before, all.size - before};
  for (const unsigned kind :
       {static_cast<unsigned>(IFLA_LINKINFO), static_cast<unsigned>(IFLA_INFO_DATA),
        static_cast<unsigned>(IFLA_CAN_BITTIMING)}) {
    part = attribute(*part, kind);
    if (!part) return {};
  }
  const auto timing = value_at<can_bittiming>(*part, 0);
  if (!timing || timing->bitrate == 0) return {};
  return timing->bitrate;
}

std::optional<std::uint32_t> can_bit_rate(const std::string& interface) {
  constexpr std::size_t max_answer = 32768;
  Question question;
  question.header.nlmsg_len = sizeof(Question);
  question.header.nlmsg_type = RTM_GETLINK;
  question.header.nlmsg_flags = NLM_F_REQUEST;
  question.link.ifi_family = AF_UNSPEC;
  question.link.ifi_index = static_cast<int>(::if_nametoindex(interface.c_str()));
  if (question.link.ifi_index == 0) return {};
  const Descriptor socket(::socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE));
  if (!socket.is_open()) return {};
  if (::send(socket.number(), &question, sizeof(question), 0) != sizeof(question)) return {};
  std::vector<std::byte> answer(max_answer);
  const ssize_t size = ::recv(socket.number(), answer.data(), answer.size(), 0);
  if (size < 0) return {};
  answer.resize(static_cast<std::size_t>(size));
  return bit_rate_in(answer);
}

}  // namespace supercoil::hal_linux
