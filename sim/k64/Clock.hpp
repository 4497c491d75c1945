#pragma once

#include <chrono>
#include <cstdint>

namespace wr::k64 {

/// @brief Time on the board. A picosecond is fine enough to tell the edges of each clock apart.
using Time = std::chrono::duration<std::int64_t, std::pico>;

/// @brief A time that does not come.
inline constexpr Time kNever = Time::max();

/// @brief A clock signal whose frequency can change; it counts its edges since the board was
/// switched on.
class Clock {
 public:
  /// @brief Changes the frequency. The count goes on.
  /// @param now when it changes
  /// @param hz new frequency; 0 stops the clock
  void set(Time now, std::uint64_t hz) {
    count_ = count(now);
    from_ = now;
    hz_ = hz;
  }

  [[nodiscard]] std::uint64_t hz() const { return hz_; }

  /// @brief Edges up to a time that is not before the last change.
  [[nodiscard]] std::uint64_t count(Time time) const {
    const auto passed = static_cast<Wide>((time - from_).count());
    return count_ + static_cast<std::uint64_t>(passed * hz_ / kSecond);
  }

  /// @brief The first time at which a count has been reached.
  [[nodiscard]] Time at(std::uint64_t count) const {
    if (count <= count_) {
      return from_;
    }
    if (hz_ == 0) {
      return kNever;
    }
    const Wide passed = (static_cast<Wide>(count - count_) * kSecond + hz_ - 1) / hz_;
    const auto most = static_cast<Wide>((kNever - from_).count());
    return passed >= most ? kNever : from_ + Time(static_cast<std::int64_t>(passed));
  }

  /// @brief The first count whose time is not before a time.
  [[nodiscard]] std::uint64_t reach(Time time) const {
    if (time <= from_) {
      return count_;
    }
    const std::uint64_t before = count(time);
    return at(before) >= time ? before : before + 1;
  }

 private:
  __extension__ using Wide = unsigned __int128;
  static constexpr Wide kSecond = 1'000'000'000'000;

  Time from_{0};
  std::uint64_t count_ = 0;
  std::uint64_t hz_ = 0;
};

}  // namespace wr::k64
