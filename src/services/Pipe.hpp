#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>

#include "units/quantities.hpp"

namespace wr {

/// @brief A value and its time stamp.
/// @datatype
template <class T>
struct Stamped {
  T value{};     ///< the value
  Instant at{};  ///< time stamp that the writer has set for the value
};

/// @brief Transfers the newest value from one writer to one reader.
/// @function Connects a writer and a reader that run at different priorities and do not depend on
/// each other. Neither of them waits. The pipe stores the time of each value, so that the reader
/// can detect a stale value.
/// @secret The exchange of three slots between writer and reader by means of one atomic operation.
template <class T>
class Pipe {
 public:
  /// @brief Constructs a pipe without a value.
  Pipe() = default;

  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  /// @brief Writes a value to the pipe. The value replaces the previous value.
  /// @param value the value
  /// @param at time stamp of the value
  /// @pre No other write is active.
  /// @isr{yes}
  /// @satisfies FR-173
  void write(const T& value, Instant at) {
    Stamped<T>& slot = slots_[written_];
    slot.value = value;
    slot.at = at;
    written_ = shared_.exchange(written_ | kNew, std::memory_order_acq_rel) & kSlot;
  }

  /// @brief Returns a copy of the newest value. The value stays in the pipe.
  /// @return the newest value and its time; nothing before the first write
  /// @pre No other read is active.
  /// @isr{yes}
  /// @satisfies FR-173
  [[nodiscard]] std::optional<Stamped<T>> read() {
    const Stamped<T>* const value = newest();
    return value != nullptr ? std::optional(*value) : std::nullopt;
  }

  /// @brief Returns the address of the newest value. Thus a reader can use a part of the value,
  /// without a copy of the whole value. The address is valid until the next call of this method or
  /// of read().
  /// @return address of the newest value and its time; null before the first write
  /// @pre No other read is active.
  /// @isr{yes}
  /// @satisfies FR-173
  [[nodiscard]] const Stamped<T>* newest() {
    if ((shared_.load(std::memory_order_relaxed) & kNew) != 0U) {
      read_ = shared_.exchange(read_, std::memory_order_acq_rel) & kSlot;
      filled_ = true;
    }
    return filled_ ? &slots_[read_] : nullptr;
  }

 private:
  static constexpr std::uint32_t kSlot = 3;  // bits that contain the number of a slot
  static constexpr std::uint32_t kNew = 4;   // bit: the shared slot has a value that was not read

  std::array<Stamped<T>, 3> slots_{};
  std::uint32_t written_ = 0;             // number of the slot that only the writer uses
  std::atomic<std::uint32_t> shared_{1};  // number of the shared slot, and the bit of a new value
  std::uint32_t read_ = 2;                // number of the slot that only the reader uses
  bool filled_ = false;

  static_assert(std::atomic<std::uint32_t>::is_always_lock_free,
                "an interrupt must not wait for a lock");
};

}  // namespace wr
