// A log of CAN frames, and what is decoded from those frames.
#include <algorithm>
#include <cmath>

#include "can/codec.hpp"
#include "can_client/candump.hpp"
#include "fuzz/fuzz.hpp"

using namespace supercoil;
using namespace supercoil::can;
using namespace supercoil::can_client;

namespace {

void check(const LogLine& line) {
  const auto again = parse_candump_line(candump_line(line.frame, line.frame.received, "can0"));
  fuzz::require(again.has_value() && again->is_standard, "what is written can be read");
  fuzz::require(again->frame.id == line.frame.id && again->frame.data == line.frame.data,
                "and is the same");
  const auto decoded = decode(line.frame);
  if (!decoded) return;
  fuzz::require(decoded->node >= 1 && decoded->node < 64, "a node is one of 63");
  for (std::size_t i = 0; i < decoded->message->signals.size(); ++i) {
    const SignalInfo& signal = decoded->message->signals[i];
    const double value = decoded->values.at(i);
    const bool bounded = signal.raw == Raw::floating || std::isnan(value) ||
                         std::abs(value) <= signal.scale * std::ldexp(1.0, signal.length);
    fuzz::require(bounded, "a value is within what its bits can say");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view rest = fuzz::text(data, size);
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const auto line = parse_candump_line(rest.substr(0, end));
    if (!line) {
      fuzz::require(!line.error().text().empty(), "what is refused is refused with a reason");
    } else if (line->is_standard) {
      check(*line);
    }
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return 0;
}
