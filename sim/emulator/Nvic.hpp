#pragma once

#include <array>
#include <bitset>
#include <cstdint>

namespace wr::emulator {

/// @brief The priorities of the exceptions, and their states: enabled, pending and active. The
/// registers and the order of the exceptions follow ARMv7-M ARM, B1.5 and B3.4.
///
/// Exceptions have the numbers of the architecture. For example, NMI has number 2, HardFault has
/// number 3, and interrupt line 0 has number 16.
class Nvic {
 public:
  /// @brief A priority that is lower than the priority of each exception.
  static constexpr int kThreadPriority = 256;

  Nvic(unsigned lines, unsigned priorityBits);

  /// @brief Sets the state after a reset: the interrupts and the exceptions 4 to 6 are disabled, no
  /// exception is pending or active, and each priority that can be set is 0. The levels of the
  /// interrupt lines do not change.
  void reset();

  void pend(unsigned exception) { pending_.set(exception); }
  void unpend(unsigned exception);
  [[nodiscard]] bool isPending(unsigned exception) const { return pending_[exception]; }
  [[nodiscard]] bool isActive(unsigned exception) const { return active_[exception]; }
  /// @brief Returns the number of active exceptions.
  [[nodiscard]] unsigned activeCount() const { return activeCount_; }

  /// @brief Makes a pending exception active.
  void activate(unsigned exception);

  /// @brief Ends an active exception. If its interrupt line is still high, the line triggers the
  /// exception again.
  void deactivate(unsigned exception);

  /// @brief Sets the level of an interrupt line. A rising edge triggers the exception of the line.
  /// @return true when the exception was triggered.
  bool setLine(unsigned line, bool high);

  /// @brief Returns the number of entries of an interrupt since the last rise of its interrupt
  /// line.
  [[nodiscard]] unsigned entriesOfHighLine(unsigned exception) const;

  /// @brief Returns the pending and enabled exception with the highest priority; 0 when no
  /// exception is pending and enabled.
  [[nodiscard]] unsigned first() const { return (pending_ & enabled_).any() ? search() : 0; }

  /// @brief Returns the priority of an exception, -3 to 255.
  [[nodiscard]] int priority(unsigned exception) const {
    return exception < 4 ? static_cast<int>(exception) - 4 : priorities_[exception];
  }

  /// @brief Returns the part of a priority that determines preemption.
  [[nodiscard]] int group(int priority) const {
    return priority < 0 ? priority : priority & ~((2 << priorityGroup_) - 1);
  }

  /// @brief Returns the priority of the running code, which the active exceptions determine.
  [[nodiscard]] int activePriority() const;

  void setPriority(unsigned exception, std::uint8_t value);
  [[nodiscard]] std::uint8_t priorityByte(unsigned exception) const;
  void setPriorityGroup(unsigned group) { priorityGroup_ = group; }
  [[nodiscard]] unsigned priorityGroup() const { return priorityGroup_; }

  /// @brief Enables or disables an exception. The exceptions below 16, except 4, 5 and 6, are
  /// always enabled.
  void enable(unsigned exception, bool enabled) { enabled_.set(exception, enabled); }
  [[nodiscard]] bool isEnabled(unsigned exception) const { return enabled_[exception]; }

  [[nodiscard]] unsigned lines() const { return lines_; }

  /// @brief Returns true if an offset from 0xE000E000 belongs to a register of the interrupt lines.
  [[nodiscard]] static bool owns(std::uint32_t offset);

  /// @brief Reads a word of the registers at 0xE000E000.
  [[nodiscard]] std::uint32_t read(std::uint32_t offset) const;

  /// @brief Writes the registers at 0xE000E000.
  /// @return false when the register cannot be written with this size.
  bool write(std::uint32_t offset, unsigned size, std::uint32_t value);

 private:
  using Bits = std::bitset<256>;

  [[nodiscard]] unsigned search() const;
  [[nodiscard]] std::uint32_t wordOf(const Bits& bits, std::uint32_t offset) const;
  template <typename Call>
  void forEachLine(std::uint32_t offset, std::uint32_t value, Call call);

  unsigned lines_;
  std::uint8_t priorityMask_;
  unsigned priorityGroup_ = 0;
  Bits enabled_;
  Bits pending_;
  Bits active_;
  unsigned activeCount_ = 0;
  Bits level_;
  std::array<std::uint8_t, 256> priorities_{};
  std::array<unsigned, 256> entries_{};
};

}  // namespace wr::emulator
