#include "supercoil/hal_linux/mailbox.hpp"

#include <array>
#include <atomic>
#include <cstdint>
#include <thread>

#include <CppUTest/TestHarness.h>

using supercoil::hal_linux::Mailbox;

namespace {

/// Long enough for a torn copy to show.
struct Letter {
  std::array<std::uint64_t, 32> words{};

  static Letter of(std::uint64_t number) {
    Letter letter;
    letter.words.fill(number);
    return letter;
  }
  bool whole() const {
    for (const auto word : words) {
      if (word != words.front()) return false;
    }
    return true;
  }
};

}  // namespace

TEST_GROUP(MailboxOf){};

TEST(MailboxOf, ReturnsTheInitialValueBeforeAnyPut) {
  Mailbox<int> box(7);
  LONGS_EQUAL(7, box.newest());
  LONGS_EQUAL(0, Mailbox<int>().newest());
}

TEST(MailboxOf, ReturnsTheNewestAndKeepsIt) {
  Mailbox<int> box;
  for (int i = 1; i < 20; ++i) {
    for (int j = 0; j < i; ++j)
      box.put(100 * i + j);
    LONGS_EQUAL(100 * i + i - 1, box.newest());
    LONGS_EQUAL(100 * i + i - 1, box.newest());
  }
}

TEST(MailboxOf, TwoThreadsNeverTearsGoesBackOrLosesTheLast) {
  constexpr std::uint64_t last = 200'000;
  Mailbox<Letter> box;
  std::thread writer([&] {
    for (std::uint64_t i = 1; i <= last; ++i)
      box.put(Letter::of(i));
  });
  std::uint64_t seen = 0;
  bool good = true;
  while (seen < last && good) {
    const Letter& letter = box.newest();
    good = letter.whole() && letter.words.front() >= seen;
    seen = letter.words.front();
  }
  writer.join();
  CHECK(good);
  CHECK(box.newest().words.front() == last);
}
