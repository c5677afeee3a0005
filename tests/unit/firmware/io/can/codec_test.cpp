// The protocol's table decodes every frame as the codec that cantools generated does.
#include "can/codec.hpp"

#include <bit>
#include <stdexcept>
#include <string>

#include <CppUTest/TestHarness.h>
#include <rapidcheck.h>

#include "can/generated/messages.hpp"
#include "unit/firmware/io/can/support/any_frame.hpp"
#include "unit/firmware/io/can/support/by_codec.hpp"

using namespace supercoil;
using namespace supercoil::can;
using namespace supercoil::test;

namespace {

hal::CanFrame empty_frame(const CodecMessage& message, std::uint16_t node = 1) {
  hal::CanFrame frame;
  frame.id = static_cast<std::uint16_t>(message.id - 1 + node);
  frame.length = message.length;
  return frame;
}

bool same(const Values& a, const Values& b) {
  return std::equal(a.begin(), a.end(), b.begin(),
                    [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

bool is_right(const CodecMessage& message, const hal::CanFrame& frame) {
  const auto decoded = decode(frame);
  return decoded && decoded->message->name == message.name &&
         same(decoded->values, message.read(frame));
}

/// Puts a signal's raw value, modulo its length, into a frame.
void put_raw(hal::CanFrame& frame, const SignalInfo& signal, std::int64_t raw) {
  for (unsigned bit = 0; bit < signal.length; ++bit) {
    const unsigned at = signal.start + bit;
    const auto value = static_cast<std::uint8_t>(static_cast<std::uint64_t>(raw) >> bit & 1U);
    frame.data.at(at / 8) = static_cast<std::uint8_t>(frame.data.at(at / 8) | value << at % 8);
  }
}

double value(const hal::CanFrame& frame, std::string_view signal) {
  const auto decoded = decode(frame);
  CHECK(decoded.has_value());
  return decoded->values.at(signal_index(*decoded->message, signal));
}

}  // namespace

TEST_GROUP(Codec){};

TEST(Codec, TableListsTheMessagesOfTheCodec) {
  LONGS_EQUAL(codec_messages.size(), all_messages.size());
}

TEST(Codec, EveryFrameDecodesAsTheCodecDecodesIt) {
  for (const CodecMessage& message : codec_messages) {
    const bool holds = rc::check(std::string(message.name), [&] {
      hal::CanFrame frame = empty_frame(message, *rc::gen::inRange<std::uint16_t>(1, 64));
      for (std::size_t i = 0; i < frame.length; ++i)
        frame.data.at(i) = *extreme_byte();
      RC_ASSERT(is_right(message, frame));
    });
    CHECK_TEXT(holds, message.name.data());
  }
}

TEST(Codec, RawValuesAtRangeLimitsDecodeAsTheCodecDecodesThem) {
  for (const CodecMessage& message : codec_messages) {
    for (const SignalInfo& signal : find_message(message.name)->signals) {
      const std::int64_t sign = std::int64_t{1} << (signal.length - 1U);
      for (const std::int64_t raw : {std::int64_t{0}, std::int64_t{1}, sign - 1, sign, sign + 1,
                                     2 * sign - 2, 2 * sign - 1}) {
        hal::CanFrame frame = empty_frame(message);
        put_raw(frame, signal, raw);
        CHECK_TEXT(is_right(message, frame), signal.name.data());
      }
    }
  }
}

TEST(Codec, RawValuesRoundTrip) {
  for (const CodecMessage& message : codec_messages) {
    for (const SignalInfo& signal : find_message(message.name)->signals) {
      const std::int64_t sign = std::int64_t{1} << (signal.length - 1U);
      for (const std::int64_t raw : {std::int64_t{0}, std::int64_t{1}, sign / 3, sign - 1, sign,
                                     sign + 1, 2 * sign - 2, 2 * sign - 1}) {
        hal::CanFrame frame = empty_frame(message);
        put_raw(frame, signal, raw);
        hal::CanFrame again = empty_frame(message);
        again.data.fill(0xA5);
        put(again, signal, get(frame, signal));
        const double read = get(frame, signal);
        const double read_again = get(again, signal);
        CHECK_TEXT(read == read_again || (std::isnan(read) && std::isnan(read_again)),
                   (std::string(message.name) + "." + std::string(signal.name)).c_str());
        // The bits outside the signal are unchanged.
        hal::CanFrame cleared = again;
        hal::CanFrame untouched = empty_frame(message);
        untouched.data.fill(0xA5);
        put(cleared, signal, 0.0);
        put(untouched, signal, 0.0);
        CHECK(cleared.data == untouched.data);
      }
    }
  }
}

TEST(Codec, ValuesOutOfRangeSaturateAndNeverBecomeNotAvailable) {
  for (const CodecMessage& message : codec_messages) {
    for (const SignalInfo& signal : find_message(message.name)->signals) {
      if (signal.raw == Raw::floating) continue;
      const bool is_signed = signal.raw == Raw::signed_integer;
      const double half = std::ldexp(1.0, signal.length - 1);
      const double top = signal.reserved != no_value && !is_signed ? 2.0 * half - 2.0
                         : is_signed                               ? half - 1.0
                                                                   : 2.0 * half - 1.0;
      const double bottom = is_signed ? 1.0 - half : 0.0;
      hal::CanFrame frame = empty_frame(message);
      for (const double beyond : {1e18, static_cast<double>(INFINITY)}) {
        put(frame, signal, beyond);
        DOUBLES_EQUAL(top * signal.scale, get(frame, signal), 1e-9 * top * signal.scale);
        put(frame, signal, -beyond);
        DOUBLES_EQUAL(bottom * signal.scale, get(frame, signal), 1e-9 * top * signal.scale);
      }
    }
  }
}

TEST(Codec, TheReservedRawValueIsNaN) {
  int reserved = 0;
  for (const CodecMessage& message : codec_messages) {
    for (const SignalInfo& signal : find_message(message.name)->signals) {
      hal::CanFrame frame = empty_frame(message);
      if (signal.reserved == no_value) continue;
      put_raw(frame, signal, signal.reserved);
      CHECK_TEXT(std::isnan(value(frame, signal.name)), signal.name.data());
      hal::CanFrame without = empty_frame(message);
      put(without, signal, NAN);
      CHECK(without.data == frame.data);
      ++reserved;
    }
  }
  LONGS_EQUAL(35, reserved);
}

TEST(Codec, AnEstimateDecodesOnlyTheParameterThatItCarries) {
  const CodecMessage& message = codec_messages[13];
  constexpr std::size_t first = 4;  // after parameter, trusted, identify_notes, error_bound
  for (std::uint8_t parameter = 0; parameter < 16; ++parameter) {
    hal::CanFrame frame = empty_frame(message);
    frame.data[0] = parameter;
    put_raw(frame, find_message("Estimate")->signals[first], std::bit_cast<std::uint32_t>(1.5F));
    const auto decoded = decode(frame);
    for (std::size_t i = first; i < first + 14; ++i) {
      const double shown = decoded->values.at(i);
      CHECK(i - first == parameter ? shown == 1.5 : std::isnan(shown));
    }
  }
}

TEST(Codec, OnlyIdentifiersAndLengthsOfTheProtocolAreFrames) {
  for (int id = 0; id < 0x10000; ++id) {
    for (std::uint8_t length = 0; length <= 9; ++length) {
      hal::CanFrame frame;
      frame.id = static_cast<std::uint16_t>(id);
      frame.length = length;
      const bool ours = std::any_of(
          codec_messages.begin(), codec_messages.end(), [&](const CodecMessage& message) {
            return id >= message.id && id < message.id + max_nodes && length == message.length;
          });
      const auto decoded = decode(frame);
      CHECK_EQUAL(ours, decoded.has_value());
      if (decoded) LONGS_EQUAL(id - decoded->message->base, decoded->node);
    }
  }
}

TEST(Codec, KnownNamesAreFoundAndUnknownOnesRejected) {
  CHECK(find_message("Nonsense") == nullptr);
  const MessageInfo& status = *find_message("Status");
  LONGS_EQUAL(10, signal_index(status, "counter"));
  CHECK_THROWS(std::out_of_range, signal_index(status, "nonsense"));
  const SignalInfo& fault = status.signals[signal_index(status, "fault")];
  CHECK(value_name(fault, 60.0) == "command_timeout");
  CHECK(value_name(fault, 1.0).empty());
  CHECK(value_name(fault, NAN).empty());
}
