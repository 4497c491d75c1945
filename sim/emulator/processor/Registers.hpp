#pragma once

#include <array>
#include <cstdint>
#include <utility>

namespace wr::emulator {

/// @brief The registers of a Cortex-M4F (ARMv7-M ARM, B1.4 and A2.5).
struct Registers {
  static constexpr unsigned kStack = 13;
  static constexpr unsigned kLink = 14;
  static constexpr unsigned kPc = 15;

  // Bits of CONTROL, B1.4.4.
  static constexpr std::uint32_t kUnprivileged = 1;
  static constexpr std::uint32_t kProcessStack = 2;
  static constexpr std::uint32_t kFpActive = 4;

  /// The core registers. Register 13 is the stack pointer in use. Register 15 is the address of the
  /// instruction plus 4.
  std::array<std::uint32_t, 16> r{};
  std::uint32_t otherStack = 0;  ///< the stack pointer that is not in use
  bool onProcessStack = false;   ///< the process stack is in use

  // The flags are not stored. Instead, the results that determine the flags are stored. A flag is
  // computed only when it is read, because flags are seldom read.
  std::uint32_t n = 0;  ///< bit 31
  std::uint32_t z = 1;  ///< Z is set when this word is 0
  std::uint32_t c = 0;  ///< 0 or 1
  std::uint32_t v = 0;  ///< bit 31
  bool q = false;
  std::uint8_t ge = 0;  ///< 4 bits
  std::uint8_t it = 0;  ///< ITSTATE; 0 outside of an IT block
  bool thumb = true;

  unsigned exception = 0;  ///< IPSR
  std::uint32_t primask = 0;
  std::uint32_t faultmask = 0;
  std::uint32_t basepri = 0;
  std::uint32_t control = 0;

  std::array<std::uint32_t, 32> s{};
  std::uint32_t fpscr = 0;

  /// @brief Returns true if a condition is met (A7.3).
  [[nodiscard]] bool passes(unsigned condition) const {
    const bool holds = passesFirst(condition >> 1);
    return (condition & 1U) != 0 && condition != 15 ? !holds : holds;
  }

  /// @brief Returns the flags of APSR.
  [[nodiscard]] std::uint32_t flags() const {
    return (n & 1U << 31) | (z == 0 ? 1U << 30 : 0) | c << 29 | (v >> 31) << 28 |
           (q ? 1U << 27 : 0) | std::uint32_t{ge} << 16;
  }

  /// @brief Sets N, Z, C, V and Q.
  void setFlags(std::uint32_t apsr) {
    n = apsr;
    z = (apsr >> 30 & 1U) ^ 1U;
    c = apsr >> 29 & 1U;
    v = apsr << 3;
    q = (apsr >> 27 & 1U) != 0;
  }

  /// @brief Sets GE.
  void setGe(std::uint32_t apsr) { ge = static_cast<std::uint8_t>(apsr >> 16 & 0xFU); }

  /// @brief Returns the flags, the exception, the IT block and the Thumb bit, as in a stack frame
  /// (B1.4.2).
  [[nodiscard]] std::uint32_t state() const {
    return flags() | exception | (thumb ? 1U << 24 : 0) | (std::uint32_t{it} & 3U) << 25 |
           (std::uint32_t{it} >> 2) << 10;
  }

  /// @brief Sets the values that state() returns.
  void setState(std::uint32_t xpsr) {
    setFlags(xpsr);
    setGe(xpsr);
    exception = xpsr & 0x1FFU;
    thumb = (xpsr >> 24 & 1U) != 0;
    it = static_cast<std::uint8_t>((xpsr >> 25 & 3U) | (xpsr >> 10 & 0x3FU) << 2);
  }

  [[nodiscard]] bool privileged() const { return exception != 0 || (control & kUnprivileged) == 0; }

  /// @brief Selects the main or the process stack.
  void useStack(bool process) {
    if (process != onProcessStack) {
      std::swap(r[kStack], otherStack);
      onProcessStack = process;
    }
  }

  [[nodiscard]] std::uint32_t& mainStack() { return onProcessStack ? otherStack : r[kStack]; }
  [[nodiscard]] std::uint32_t& processStack() { return onProcessStack ? r[kStack] : otherStack; }

  /// @brief Advances to the next instruction of an IT block (A7.3.3, ITAdvance).
  void advanceIt() {
    const std::uint32_t now = it;
    it = static_cast<std::uint8_t>((now & 7U) == 0 ? 0U : (now & 0xE0U) | (now << 1U & 0x1FU));
  }

 private:
  [[nodiscard]] bool passesFirst(unsigned condition) const {
    const bool negative = n >> 31 != 0;
    const bool overflow = v >> 31 != 0;
    switch (condition) {
      case 0:
        return z == 0;
      case 1:
        return c != 0;
      case 2:
        return negative;
      case 3:
        return overflow;
      case 4:
        return c != 0 && z != 0;
      case 5:
        return negative == overflow;
      case 6:
        return negative == overflow && z != 0;
      default:
        return true;
    }
  }
};

}  // namespace wr::emulator
