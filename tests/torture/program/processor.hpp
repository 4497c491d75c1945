#pragma once

#include <cstdint>

namespace wr::torture {

/// @brief Returns a register of the system control space, ARMv7-M ARM, B3.2.2 and B3.4.3.
template <class T>
[[nodiscard]] inline volatile T& at(std::uint32_t address) {
  return *reinterpret_cast<volatile T*>(address);
}

inline constexpr std::uint32_t kSetEnable = 0xE000E100;
inline constexpr std::uint32_t kClearEnable = 0xE000E180;
inline constexpr std::uint32_t kSetPending = 0xE000E200;
inline constexpr std::uint32_t kClearPending = 0xE000E280;
inline constexpr std::uint32_t kActive = 0xE000E300;
inline constexpr std::uint32_t kPriority = 0xE000E400;
inline constexpr std::uint32_t kInterruptControl = 0xE000ED04;
inline constexpr std::uint32_t kReset = 0xE000ED0C;
inline constexpr std::uint32_t kSystemPriority = 0xE000ED18;
inline constexpr std::uint32_t kSystemHandlers = 0xE000ED24;
inline constexpr std::uint32_t kFaultStatus = 0xE000ED28;
inline constexpr std::uint32_t kHardFaultStatus = 0xE000ED2C;
inline constexpr std::uint32_t kBusFaultAddress = 0xE000ED38;
inline constexpr std::uint32_t kTrigger = 0xE000EF00;

/// @brief Waits until all writes have taken effect.
inline void synchronize() {
  asm volatile("dsb\n\tisb" ::: "memory");
}

inline void write(std::uint32_t address, std::uint32_t value) {
  at<std::uint32_t>(address) = value;
  synchronize();
}

[[nodiscard]] inline std::uint32_t read(std::uint32_t address) {
  return at<std::uint32_t>(address);
}

/// @brief The exception masks BASEPRI, PRIMASK and FAULTMASK.
struct Masks {
  std::uint32_t basePriority;
  std::uint32_t interrupts;
  std::uint32_t faults;
};

[[nodiscard]] inline Masks masks() {
  Masks now{};
  asm volatile("mrs %0, basepri" : "=r"(now.basePriority));
  asm volatile("mrs %0, primask" : "=r"(now.interrupts));
  asm volatile("mrs %0, faultmask" : "=r"(now.faults));
  return now;
}

inline void setBasePriority(std::uint32_t value) {
  asm volatile("msr basepri, %0\n\tisb" ::"r"(value) : "memory");
}

/// @brief Changes the base priority, but only to a more urgent priority.
inline void raiseBasePriority(std::uint32_t value) {
  asm volatile("msr basepri_max, %0\n\tisb" ::"r"(value) : "memory");
}

inline void setInterruptMask(std::uint32_t value) {
  asm volatile("msr primask, %0\n\tisb" ::"r"(value) : "memory");
}

inline void setFaultMask(std::uint32_t value) {
  asm volatile("msr faultmask, %0\n\tisb" ::"r"(value) : "memory");
}

[[nodiscard]] inline std::uint32_t control() {
  std::uint32_t value{};
  asm volatile("mrs %0, control" : "=r"(value));
  return value;
}

inline void setControl(std::uint32_t value) {
  asm volatile("msr control, %0\n\tisb" ::"r"(value) : "memory");
}

[[nodiscard]] inline std::uint32_t exceptionNumber() {
  std::uint32_t value{};
  asm volatile("mrs %0, ipsr" : "=r"(value));
  return value;
}

inline void waitForInterrupt() {
  asm volatile("dsb\n\twfi\n\tisb" ::: "memory");
}

/// @brief Requests a service from the emulator, as the semihosting specification of Arm defines.
inline std::uint32_t semihosting(std::uint32_t operation, const void* parameters) {
  register std::uint32_t r0 asm("r0") = operation;
  register const void* r1 asm("r1") = parameters;
  asm volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
  return r0;
}

}  // namespace wr::torture
