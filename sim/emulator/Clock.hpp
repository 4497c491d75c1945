#pragma once

#include <chrono>
#include <cstdint>
#include <numeric>

namespace wr::emulator {

/// @brief Time on the board. Its resolution of 1 ps is fine enough to distinguish the edges of each
/// clock.
using Time = std::chrono::duration<std::int64_t, std::pico>;

/// @brief A time that is never reached.
inline constexpr Time kNever = Time::max();

/// @brief A clock signal whose frequency can change. The object counts the edges since the board
/// was switched on.
class Clock {
 public:
  /// @brief Changes the frequency. The count continues.
  /// @param now time of the change
  /// @param hz new frequency; 0 stops the clock
  void set(Time now, std::uint64_t hz) {
    count_ = count(now);
    from_ = now;
    hz_ = hz;
    const std::uint64_t common = std::gcd(kSecond, hz);
    edges_ = hz / common;
    picoseconds_ = kSecond / common;
  }

  [[nodiscard]] std::uint64_t hz() const { return hz_; }

  /// @brief Returns the number of edges up to a time. The time must not be before the last change
  /// of the frequency.
  [[nodiscard]] std::uint64_t count(Time time) const {
    return count_ +
           scale(static_cast<std::uint64_t>((time - from_).count()), edges_, 0, picoseconds_);
  }

  /// @brief Returns the earliest time at which a count is reached.
  [[nodiscard]] Time at(std::uint64_t count) const {
    if (count <= count_) {
      return from_;
    }
    if (hz_ == 0) {
      return kNever;
    }
    const std::uint64_t passed = scale(count - count_, picoseconds_, edges_ - 1, edges_);
    const auto most = static_cast<std::uint64_t>((kNever - from_).count());
    return passed >= most ? kNever : from_ + Time(static_cast<std::int64_t>(passed));
  }

  /// @brief Returns the smallest count that is reached at or after the given time.
  [[nodiscard]] std::uint64_t reach(Time time) const {
    if (time <= from_) {
      return count_;
    }
    const std::uint64_t before = count(time);
    return at(before) >= time ? before : before + 1;
  }

 private:
  __extension__ using Wide = unsigned __int128;
  static constexpr std::uint64_t kSecond = 1'000'000'000'000;

  // Returns (value * factor + more) / divisor. If the dividend fits into 64 bits, the division uses
  // 64-bit arithmetic, which is much faster.
  static std::uint64_t scale(std::uint64_t value, std::uint64_t factor, std::uint64_t more,
                             std::uint64_t divisor) {
    std::uint64_t product = 0;
    if (!__builtin_mul_overflow(value, factor, &product) &&
        !__builtin_add_overflow(product, more, &product)) {
      return product / divisor;
    }
    const Wide wide = (static_cast<Wide>(value) * factor + more) / divisor;
    constexpr std::uint64_t kMost = ~std::uint64_t{0};
    return wide > kMost ? kMost : static_cast<std::uint64_t>(wide);
  }

  Time from_{0};
  std::uint64_t count_ = 0;
  std::uint64_t hz_ = 0;
  // The frequency as a reduced fraction. The fraction is a number of edges in a number of
  // picoseconds.
  std::uint64_t edges_ = 0;
  std::uint64_t picoseconds_ = 1;
};

}  // namespace wr::emulator
