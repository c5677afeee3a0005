// The stream of a socketcand connection, whoever is at the other end.
#include <string>
#include <vector>

#include "can_client/socketcand.hpp"
#include "fuzz/fuzz.hpp"

using namespace supercoil;
using namespace supercoil::can_client;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // The stream comes in two parts; its first byte says where it is cut.
  if (size == 0) return 0;
  const std::string_view stream = fuzz::text(data + 1, size - 1);
  const std::size_t cut = stream.empty() ? 0 : data[0] % stream.size();
  ElementReader whole;
  ElementReader parts;
  whole.put(stream);
  std::vector<std::string> elements;
  while (const auto element = whole.take())
    elements.push_back(*element);
  std::size_t next = 0;
  for (const std::string_view part : {stream.substr(0, cut), stream.substr(cut)}) {
    parts.put(part);
    while (const auto element = parts.take()) {
      fuzz::require(next < elements.size() && *element == elements[next],
                    "elements do not depend on how the stream is cut");
      ++next;
    }
  }
  fuzz::require(next == elements.size(), "none is lost");
  for (const std::string& element : elements) {
    if (const auto frame = parse_send(element)) {
      fuzz::require(frame->id < 0x800 && frame->length <= 8, "a frame that is sent is classical");
      ElementReader reader;
      reader.put(send_text(*frame));
      const auto again = parse_send(reader.take().value());
      fuzz::require(again && again->id == frame->id && again->length == frame->length &&
                        again->data == frame->data,
                    "a frame that is sent is read as it was written");
    }
    if (const auto frame = parse_frame(element)) {
      fuzz::require(frame->id < 0x800 && frame->length <= 8, "a frame that is heard is classical");
      fuzz::require(frame->received >= hal::Time::zero(), "its time is not before 1970");
    }
  }
  return 0;
}
