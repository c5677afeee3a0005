// Elements are found in any stream, and frames are read back from their text.
#include "can_client/socketcand.hpp"

#include <string>
#include <vector>

#include <CppUTest/TestHarness.h>
#include <rapidcheck.h>

#include "unit/firmware/io/can/support/any_frame.hpp"

using namespace supercoil;
using namespace supercoil::can_client;
using namespace supercoil::test;
using namespace std::chrono_literals;

namespace {

using Elements = std::vector<std::string>;

void take_all(ElementReader& reader, Elements& elements) {
  while (const auto element = reader.take())
    elements.push_back(*element);
}

Elements elements_of(std::string_view stream) {
  ElementReader reader;
  Elements elements;
  reader.put(stream);
  take_all(reader, elements);
  return elements;
}

/// Text with many of the characters that matter to a reader, and sometimes something long.
std::string any_stream() {
  std::string stream;
  for (int piece : *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 300))) {
    constexpr std::string_view characters = "<> a";
    stream += piece < 280
                  ? std::string(1, characters[static_cast<std::size_t>(piece) % characters.size()])
                  : std::string(static_cast<std::size_t>(piece - 45), 'x');
  }
  return stream;
}

/// The part of a frame that its "send" element carries.
hal::CanFrame without_time(hal::CanFrame frame) {
  frame.received = {};
  return frame;
}

/// The element in a text, as a reader returns it.
std::string inside(const std::string& text) {
  const Elements found = elements_of(text);
  return found.size() == 1 ? found[0] : "";
}

}  // namespace

TEST_GROUP(Socketcand){};

TEST(Socketcand, ElementsAreExtractedFromTheStream) {
  CHECK(elements_of("< hi >< ok >") == (Elements{"hi", "ok"}));
  CHECK(elements_of("noise > < open  can0 > noise <rawmode>< half") ==
        (Elements{"open  can0", "rawmode"}));
  CHECK(elements_of("<><   >") == (Elements{"", ""}));
  CHECK(elements_of(std::string("< a\0b >", 7)) == (Elements{std::string("a\0b", 3)}));
}

TEST(Socketcand, TheSplitOfTheStreamDoesNotMatter) {
  CHECK(rc::check("splits", [] {
    const std::string stream = any_stream();
    const auto max_length = *rc::gen::inRange<std::size_t>(1, 400);
    ElementReader reader;
    Elements elements;
    for (std::size_t at = 0; at < stream.size();) {
      const auto length = *rc::gen::inRange<std::size_t>(1, max_length + 1);
      reader.put(std::string_view(stream).substr(at, length));
      take_all(reader, elements);
      at += length;
    }
    RC_ASSERT(elements == elements_of(stream));
  }));
}

TEST(Socketcand, TooLongAnElementIsSkipped) {
  CHECK(elements_of("<" + std::string(256, 'x') + ">< ok >") ==
        (Elements{std::string(256, 'x'), "ok"}));
  CHECK(elements_of("<" + std::string(257, 'x') + ">< ok >") == (Elements{"ok"}));
  ElementReader reader;
  for (int i = 0; i < 1000; ++i) {
    reader.put(i == 0 ? "<" : std::string(1000, 'x'));
    CHECK_FALSE(reader.take().has_value());
  }
  reader.put("< ok >");
  CHECK(reader.take() == "ok");
}

TEST(Socketcand, TextFollowsTheProtocol) {
  hal::CanFrame frame;
  frame.id = 0x123;
  frame.length = 2;
  frame.data = {0xAA, 0x00};
  STRCMP_EQUAL("< send 123 2 AA 00 >", send_text(frame).c_str());
  STRCMP_EQUAL("< frame 123 0000000023.424242 AA00 >", frame_text(frame, 23424242us).c_str());
}

TEST(Socketcand, EveryFrameRoundTrips) {
  CHECK(rc::check("send and frame", [] {
    hal::CanFrame frame = any_frame();
    const std::int64_t time_us = *rc::gen::inRange<std::int64_t>(0, 4294967295'000000);
    frame.received = std::chrono::microseconds(time_us);
    const auto sent = parse_send(inside(send_text(frame)));
    RC_ASSERT(sent.has_value());
    RC_ASSERT(same(*sent, without_time(frame)));
    const auto parsed = parse_frame(inside(frame_text(frame, frame.received)));
    RC_ASSERT(parsed.has_value());
    RC_ASSERT(same(*parsed, frame));
  }));
}

TEST(Socketcand, ReadsOutputOfOtherPrograms) {
  const auto sent = parse_send("send 7ff 3 a 0 0B");  // as python-can sends it
  CHECK(sent.has_value());
  LONGS_EQUAL(0x7FF, sent->id);
  LONGS_EQUAL(0x0B, sent->data[2]);
  const auto parsed = parse_frame("frame 7ff 1.5 a00B");
  CHECK(parsed.has_value());
  LONGS_EQUAL(2, parsed->length);
  CHECK(parsed->received == 1500ms);
}

TEST(Socketcand, AnInvalidFrameIsRefused) {
  for (const char* element :
       {"", "send", "send 123", "sendx 123 0", "send 800 0", "send 00000123 0", "send 0123 0",
        "send -1 0", "send 12G 0", "send 123 9 1 1 1 1 1 1 1 1 1", "send 123 -1", "send 123 2 1",
        "send 123 1 1 1", "send 123 1 100", "send 123 1 x", "send 123 1 -1", "send 123 8",
        "frame 123 1.0 00"}) {
    CHECK_FALSE_TEXT(parse_send(element).has_value(), element);
  }
  for (const char* element :
       {"", "frame", "frame 123", "frame 123 x", "frame 123 1 00", "frame 00000123 1.0 00",
        "frame 800 1.0 00", "frame 123 1.0 0", "frame 123 1.0 0G", "frame 123 1.0 00 00",
        "frame 123 1.0 001122334455667788", "frame 123 -1.0 00", "send 123 0"}) {
    CHECK_FALSE_TEXT(parse_frame(element).has_value(), element);
  }
}

TEST(Socketcand, AnyChangedElementIsReadOrRefused) {
  CHECK(rc::check("changed elements", [] {
    std::string text = *rc::gen::arbitrary<bool>() ? send_text(any_frame())
                                                   : frame_text(any_frame(), 1436509052249713us);
    text[*rc::gen::inRange<std::size_t>(0, text.size())] = *rc::gen::arbitrary<char>();
    for (const std::string& element : elements_of(text)) {
      for (const auto& frame : {parse_send(element), parse_frame(element)}) {
        // RC_ASSERT evaluates both sides of its own ||.
        const bool within = !frame || (frame->length <= 8 && frame->id < 0x800);
        RC_ASSERT(within);
      }
    }
  }));
}
