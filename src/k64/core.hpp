#pragma once

#include <cstdint>

namespace wr {

/// @brief Priority of an interrupt or of a thread, from 0 (highest) to 15 (lowest).
using Priority = std::uint8_t;

/// @brief Priority of the interrupt that records the times of the edges of the remote control. No
/// other interrupt of the firmware may delay this interrupt: if the measured length of a pulse is
/// wrong by 1 us, the ordered steering angle is wrong by 0.06 degrees.
inline constexpr Priority kPulsePriority = 1;

/// @brief Priority of the interrupt that records the times of the Hall edges. This priority is
/// higher than kInterruptPriority. Thus interrupts with kInterruptPriority do not delay this
/// interrupt.
inline constexpr Priority kEdgePriority = 2;

/// @brief Priority of the interrupts of all devices other than the remote control and the Hall
/// sensors.
inline constexpr Priority kInterruptPriority = 3;

/// @brief Priority of the thread of the main controller.
inline constexpr Priority kMainThreadPriority = 12;

/// @brief Priority of the threads of the wheels. This priority is higher than the priority of the
/// thread of the main controller.
inline constexpr Priority kWheelThreadPriority = 8;

/// @brief Waits until all stores to memory and to registers are complete.
inline void finishStores() {
  asm volatile("dsb" ::: "memory");
}

/// @brief Waits until all stores are complete. Then discards the instructions that the core has
/// already fetched, and fetches them again.
inline void finishInstructions() {
  asm volatile("dsb\n\tisb" ::: "memory");
}

/// @brief Sleeps until an interrupt is requested. The sleep also ends if closeInterrupts() blocks
/// this interrupt.
inline void sleepUntilInterrupt() {
  asm volatile("dsb\n\twfi" ::: "memory");
}

/// @brief Blocks all interrupts and all faults except the non-maskable interrupt and the hard
/// fault.
inline void closeInterrupts() {
  asm volatile("cpsid i" ::: "memory");
}

/// @brief Enables the interrupts again.
inline void openInterrupts() {
  asm volatile("cpsie i\n\tisb" ::: "memory");
}

/// @brief Returns the number of the exception that the core is handling.
/// @return number of the exception; 0 when the core is handling no exception
inline std::uint16_t activeException() {
  std::uint32_t number = 0;  // NOLINT(misc-const-correctness): the assembler instruction writes it
  asm volatile("mrs %0, ipsr" : "=r"(number));
  return static_cast<std::uint16_t>(number);
}

/// @brief Lock that blocks all interrupts of the firmware as long as the lock object exists. Locks
/// may be nested.
/// @datatype
class InterruptLock {
 public:
  /// @brief Blocks the interrupts. If another lock already blocks them, they stay blocked.
  InterruptLock() {
    asm volatile("mrs %0, basepri" : "=r"(before_));
    constexpr std::uint32_t kMask = kPulsePriority << 4U;
    asm volatile("msr basepri_max, %0" ::"r"(kMask) : "memory");
  }
  InterruptLock(const InterruptLock&) = delete;
  InterruptLock& operator=(const InterruptLock&) = delete;

  /// @brief Restores the state before this lock. If an outer lock exists, the interrupts stay
  /// blocked.
  ~InterruptLock() { asm volatile("msr basepri, %0" ::"r"(before_) : "memory"); }

 private:
  std::uint32_t before_ = 0;
};

}  // namespace wr
