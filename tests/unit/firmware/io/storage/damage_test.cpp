// A file is read only if it is exactly as it was written.
#include <algorithm>
#include <functional>
#include <string>

#include <CppUTest/TestHarness.h>
#include <rapidcheck.h>

#include "storage/codec.hpp"
#include "storage/envelope.hpp"
#include "unit/firmware/io/storage/support/sets.hpp"

using namespace supercoil;
using namespace supercoil::storage;
using supercoil::test::answer;
using supercoil::test::learned_sets;
using supercoil::test::nth_set;

namespace {

std::string replaced(std::string text, const std::string& what, const std::string& instead) {
  return text.replace(text.find(what), what.size(), instead);
}

/// A position in a text, including its end.
std::size_t place(const std::string& text) {
  return *rc::gen::inRange<std::size_t>(0, text.size() + 1);
}

/// Flips one to eight random bits.
std::string with_flipped_bits(std::string text) {
  const int count = *rc::gen::inRange(1, 9);
  for (int i = 0; i < count; ++i) {
    const auto at = *rc::gen::inRange<std::size_t>(0, text.size());
    text[at] = static_cast<char>(text[at] ^ (1 << *rc::gen::inRange(0, 8)));
  }
  return text;
}

std::string with_a_part_twice(const std::string& text) {
  const std::size_t from = place(text);
  const std::size_t bytes = place(text);
  return replaced(text, text.substr(0, from), text.substr(0, from) + text.substr(from, bytes));
}

std::string without_a_part(std::string text) {
  return text.erase(place(text), *rc::gen::inRange<std::size_t>(1, 100));
}

std::string with_a_burst(std::string text) {
  const std::size_t from = place(text);
  const std::size_t end = std::min(text.size(), from + *rc::gen::inRange<std::size_t>(1, 600));
  const auto with = *rc::gen::element('\0', '\xff', ' ', '0', '\n');
  std::fill(text.begin() + static_cast<std::ptrdiff_t>(from),
            text.begin() + static_cast<std::ptrdiff_t>(end), with);
  return text;
}

/// The start of one version and the rest of another, like a file overwritten in place.
std::string mixed(const std::string& text) {
  const std::string other = encode(*learned_sets());
  return text.substr(0, place(text)) + other.substr(place(other));
}

bool all_detected(const char* name, const std::function<std::string(const std::string&)>& damage) {
  return rc::check(name, [&] {
    const board::Learned set = *learned_sets();
    const std::string text = encode(set);
    const std::string damaged = damage(text);
    RC_PRE(damaged != text);
    const auto read = decode(damaged);
    // Two versions may be mixed so that one of them results unchanged.
    // RC_ASSERT would evaluate both sides of its own ||.
    const bool noticed = !read || (name == std::string("mixed") && encode(*read) == damaged);
    RC_ASSERT(noticed);
  });
}

}  // namespace

TEST_GROUP(Damage){};

TEST(Damage, OfRandomKindsIsDetected) {
  CHECK(all_detected("flipped bits", with_flipped_bits));
  CHECK(
      all_detected("cut off", [](const std::string& text) { return text.substr(0, place(text)); }));
  CHECK(all_detected("a part twice", with_a_part_twice));
  CHECK(all_detected("a part lost", without_a_part));
  CHECK(all_detected("a burst", with_a_burst));
  CHECK(all_detected("mixed", mixed));
}

TEST(Damage, OfEveryBitAndAtEveryLengthIsDetected) {
  const std::string text = encode(nth_set(5));
  for (std::size_t bit = 0; bit < 8 * text.size(); ++bit) {
    std::string damaged = text;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << (bit % 8)));
    CHECK_FALSE(decode(damaged).has_value());
  }
  for (std::size_t bytes = 0; bytes < text.size(); ++bytes) {
    CHECK_FALSE(decode(text.substr(0, bytes)).has_value());
  }
}

TEST(Damage, IsDescribedInWords) {
  const std::string text = encode(board::Learned{});
  STRCMP_EQUAL("is empty", answer("").c_str());
  STRCMP_EQUAL("is cut off in its first line", answer(text.substr(0, 10)).c_str());
  STRCMP_EQUAL("is cut off in its first line", answer(text.substr(0, 40)).c_str());
  STRCMP_EQUAL("is cut off: 100 of 347 bytes after its first line",
               answer(text.substr(0, text.find('\n') + 101)).c_str());
  STRCMP_EQUAL("has 4 bytes more than were written", answer(text + "abc\n").c_str());
  STRCMP_EQUAL("is not text: byte 0x00 at offset 0", answer(std::string(500, '\0')).c_str());
  STRCMP_EQUAL("is not text: byte 0xff at offset 3", answer("# s\xff").c_str());
  STRCMP_EQUAL("is not a stored set: it does not start with '# supercoil learned, format '",
               answer("[plant]\nstiffness_N_per_m = 12.0\n").c_str());
  STRCMP_CONTAINS("is damaged: its content and its first line do not match (CRC-32 of ",
                  answer(replaced(text, "0.162", "0.163")).c_str());
  STRCMP_EQUAL("is damaged: its first line is not as it was written",
               answer(replaced(text, "format 2", "format x")).c_str());
  STRCMP_EQUAL("is damaged: its first line is not as it was written",
               answer(replaced(text, "2, 347", "2; 347")).c_str());
}

TEST(Damage, AFileOfANewerFirmwareIsNotCalledDamaged) {
  STRCMP_EQUAL(
      "is of format 3, written by a newer firmware; this one reads formats 1 to 2",
      answer("# supercoil learned, format 3, sealed in another way\nversion = 1\n").c_str());
}

TEST(Damage, AFileOfMoreThan64KiBIsRefusedWhateverItsContent) {
  const std::string comment = "#" + std::string(max_file_bytes, ' ') + "\n";
  STRCMP_EQUAL("is larger than the limit of 64 KiB",
               answer(seal("version = 1\n" + comment)).c_str());
}
