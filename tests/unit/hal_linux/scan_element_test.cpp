#include "supercoil/hal_linux/scan_element.hpp"

#include <array>
#include <cstdint>
#include <string>

#include <CppUTest/TestHarness.h>
#include <rapidcheck.h>

using namespace supercoil::hal_linux;

namespace {

std::string as_text(const ScanType& type) {
  return std::string(type.big_endian ? "be:" : "le:") + (type.is_signed ? "s" : "u") +
         std::to_string(type.bits) + "/" + std::to_string(type.storage_bits) + ">>" +
         std::to_string(type.shift);
}

ScanType any_type() {
  ScanType type;
  type.big_endian = *rc::gen::arbitrary<bool>();
  type.is_signed = *rc::gen::arbitrary<bool>();
  type.storage_bits = *rc::gen::element(8, 16, 32, 64);
  type.bits = *rc::gen::inRange(1, type.storage_bits + 1);
  type.shift = *rc::gen::inRange(0, type.storage_bits - type.bits + 1);
  return type;
}

}  // namespace

TEST_GROUP(ScanElements){};

TEST(ScanElements, EveryTypeIsParsed) {
  CHECK(rc::check("types", [] {
    const ScanType type = any_type();
    const auto read = parse_scan_type(as_text(type));
    RC_ASSERT(read.has_value());
    RC_ASSERT(*read == type);
  }));
}

TEST(ScanElements, InvalidTypesAreRefused) {
  for (const char* text : {"",
                           "le",
                           "le:",
                           "le:s",
                           "le:s16",
                           "le:s16/",
                           "le:s16/16",
                           "le:s16/16>",
                           "le:s16/16>>",
                           "le:s16/16>>x",
                           "le:s16/16>>0 ",
                           " le:s16/16>>0",
                           "xe:s16/16>>0",
                           "le:x16/16>>0",
                           "le:s0/16>>0",
                           "le:s17/16>>0",
                           "le:s12/16>>5",
                           "le:s12/16>>16",
                           "le:s12/12>>0",
                           "le:s16/24>>0",
                           "le:s-1/16>>0",
                           "le:s16/-16>>0",
                           "le:s12/16>>-4",
                           "le:s16/16X2>>0",
                           "le:s16/16X>>0",
                           "le:s99999999999/16>>0",
                           "le:s16/128>>0",
                           "be:u16/16>>0>>0",
                           "LE:S16/16>>0"}) {
    STRCMP_EQUAL(("'" + std::string(text) + "' is not a scan type such as le:s12/16>>4").c_str(),
                 parse_scan_type(text).error().text().c_str());
  }
  CHECK(parse_scan_type("le:s16/16X1>>0").has_value());
}

TEST(ScanElements, RandomTextIsRefusedOrSane) {
  CHECK(rc::check("random types", [] {
    const auto text = *rc::gen::container<std::string>(
        rc::gen::element('l', 'b', 'e', ':', 's', 'u', '1', '2', '6', '/', '>', 'X', '-'));
    if (const auto type = parse_scan_type(text)) RC_ASSERT(as_text(*type) == text);
  }));
}

TEST(ScanElements, ValuesAreDecodedFromTheirBytes) {
  CHECK(rc::check("values", [](std::uint64_t dirt) {
    const ScanType type = any_type();
    const std::uint64_t mask =
        type.bits == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << type.bits) - 1;
    const std::uint64_t bits = *rc::gen::arbitrary<std::uint64_t>() & mask;
    // The bits around the value are undefined.
    const std::uint64_t stored = (dirt & ~(mask << type.shift)) | bits << type.shift;
    std::array<std::byte, 8> bytes{};
    for (std::size_t i = 0; i < type.bytes(); ++i) {
      const std::size_t at = type.big_endian ? type.bytes() - 1 - i : i;
      bytes[at] = static_cast<std::byte>(stored >> (8 * i));
    }
    const bool negative = type.is_signed && (bits >> (type.bits - 1) & 1) != 0;
    const auto expected = static_cast<std::int64_t>(negative ? bits | ~mask : bits);
    RC_ASSERT(value_of(type, bytes.data()) == expected);
  }));
}

TEST(ScanElements, AreLaidOutAsByTheKernel) {
  const auto type = [](const char* text) { return *parse_scan_type(text); };
  // The kernel's documentation: 2 bytes, 6 of padding, 8 of time.
  std::vector<ScanElement> one = {{1, type("le:s64/64>>0"), 0}, {0, type("le:s16/16>>0"), 0}};
  LONGS_EQUAL(16, lay_out(one));
  LONGS_EQUAL(0, one[0].offset);
  LONGS_EQUAL(0, one[0].index);
  LONGS_EQUAL(8, one[1].offset);
  std::vector<ScanElement> mixed = {
      {0, type("le:u8/8>>0"), 0}, {2, type("be:u24/32>>8"), 0}, {5, type("be:s12/16>>4"), 0}};
  LONGS_EQUAL(12, lay_out(mixed));
  LONGS_EQUAL(4, mixed[1].offset);
  LONGS_EQUAL(8, mixed[2].offset);
}
