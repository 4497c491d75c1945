#pragma once

#include <cstdint>

namespace wr {

/// @brief Priority of an interrupt or a thread, 0 to 15; 0 is the highest.
using Priority = std::uint8_t;

/// @brief Priority of the interrupt that records the time of an edge of the remote control. A
/// microsecond of a pulse is 0.06 degrees, so no other interrupt of the firmware may delay it.
inline constexpr Priority kPulsePriority = 1;

/// @brief Priority of the interrupt that records the time of a Hall edge: above the other devices,
/// so that they do not delay the time.
inline constexpr Priority kEdgePriority = 2;

/// @brief Priority of the other interrupts of the devices.
inline constexpr Priority kInterruptPriority = 3;

/// @brief Priority of the thread of the main controller.
inline constexpr Priority kMainThreadPriority = 12;

/// @brief Priority of the threads of the wheels: above the priority of the main controller.
inline constexpr Priority kWheelThreadPriority = 8;

/// @brief Waits until all stores have reached memory and the registers.
inline void finishStores() {
  asm volatile("dsb" ::: "memory");
}

/// @brief Waits until all stores are done, and fetches the following instructions again.
inline void finishInstructions() {
  asm volatile("dsb\n\tisb" ::: "memory");
}

/// @brief Sleeps until an interrupt comes, also an interrupt that closeInterrupts() blocks.
inline void sleepUntilInterrupt() {
  asm volatile("dsb\n\twfi" ::: "memory");
}

/// @brief Blocks all interrupts and faults that can be blocked.
inline void closeInterrupts() {
  asm volatile("cpsid i" ::: "memory");
}

/// @brief Enables the interrupts again.
inline void openInterrupts() {
  asm volatile("cpsie i\n\tisb" ::: "memory");
}

/// @brief Returns the exception that is being handled.
/// @return number of the exception, 0 for none
inline std::uint16_t activeException() {
  std::uint32_t number = 0;  // NOLINT(misc-const-correctness): the instruction writes it
  asm volatile("mrs %0, ipsr" : "=r"(number));
  return static_cast<std::uint16_t>(number);
}

/// @brief Blocks the interrupts of the firmware as long as the object exists. Locks may be nested.
/// @datatype
class InterruptLock {
 public:
  /// @brief Blocks the interrupts. Interrupts that an outer lock blocks stay blocked.
  InterruptLock() {
    asm volatile("mrs %0, basepri" : "=r"(before_));
    constexpr std::uint32_t kMask = kPulsePriority << 4U;
    asm volatile("msr basepri_max, %0" ::"r"(kMask) : "memory");
  }
  InterruptLock(const InterruptLock&) = delete;
  InterruptLock& operator=(const InterruptLock&) = delete;

  /// @brief Restores the previous priority.
  ~InterruptLock() { asm volatile("msr basepri, %0" ::"r"(before_) : "memory"); }

 private:
  std::uint32_t before_ = 0;
};

}  // namespace wr
