// The newest value from one thread to another, without waiting.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace supercoil::hal_linux {

/// One thread puts, one other takes; either may be stopped at any point and never holds up the
/// other. Three slots: one is the writer's, one the reader's, and the third changes hands in one
/// atomic exchange. A value that is not taken in time is overwritten by a newer one.
template <class Value>
class Mailbox {
  static_assert(std::is_trivially_copyable_v<Value>);

 public:
  Mailbox() = default;
  explicit Mailbox(const Value& first) {
    for (Slot& slot : slots_)
      slot.value = first;
  }

  /// Called by the writer.
  void put(const Value& value) noexcept {
    slots_[writers_].value = value;
    writers_ = static_cast<std::uint8_t>(
        between_.exchange(static_cast<std::uint8_t>(writers_ | fresh), std::memory_order_acq_rel) &
        index);
  }

  /// Called by the reader: the last value put, else the first one. Valid until the next call.
  const Value& newest() noexcept {
    if ((between_.load(std::memory_order_relaxed) & fresh) != 0) {
      readers_ =
          static_cast<std::uint8_t>(between_.exchange(readers_, std::memory_order_acq_rel) & index);
    }
    return slots_[readers_].value;
  }

 private:
  static constexpr std::uint8_t index = 3;
  static constexpr std::uint8_t fresh = 4;
  static constexpr std::size_t cache_line = 64;

  // Each on a cache line of its own: one thread's writing must not slow down the other.
  struct alignas(cache_line) Slot {
    Value value{};
  };
  std::array<Slot, 3> slots_{};
  alignas(cache_line) std::uint8_t writers_ = 0;
  alignas(cache_line) std::uint8_t readers_ = 1;
  alignas(cache_line) std::atomic<std::uint8_t> between_{2};
};

}  // namespace supercoil::hal_linux
