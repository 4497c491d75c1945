#pragma once

#include <array>
#include <cstdint>
#include <limits>

namespace wr::emulator {

class Nvic;

/// @brief The system control space with the system control block, SysTick and the cycle counter.
/// See ARMv7-M ARM, B3.2 (SCB), B3.3 (SysTick), C1.6.5 (DEMCR) and C1.8 (DWT).
class SystemControl {
 public:
  static constexpr std::uint64_t kNever = std::numeric_limits<std::uint64_t>::max();

  /// @brief Effect of a write.
  enum class Written { Done, ResetRequested, Unknown, Misused };

  // Bits of CFSR, ARMv7-M ARM, B3.2.15.
  static constexpr std::uint32_t kInstructionViolation = 1U << 0;
  static constexpr std::uint32_t kInstructionBus = 1U << 8;
  static constexpr std::uint32_t kPreciseBus = 1U << 9;
  static constexpr std::uint32_t kImpreciseBus = 1U << 10;
  static constexpr std::uint32_t kUnstackingBus = 1U << 11;
  static constexpr std::uint32_t kStackingBus = 1U << 12;
  static constexpr std::uint32_t kUndefined = 1U << 16;
  static constexpr std::uint32_t kInvalidState = 1U << 17;
  static constexpr std::uint32_t kInvalidPc = 1U << 18;
  static constexpr std::uint32_t kNoCoprocessor = 1U << 19;
  static constexpr std::uint32_t kUnaligned = 1U << 24;
  static constexpr std::uint32_t kDivideByZero = 1U << 25;
  // Bits of HFSR, B3.2.16.
  static constexpr std::uint32_t kVectorTable = 1U << 1;
  static constexpr std::uint32_t kForced = 1U << 30;
  static constexpr std::uint32_t kDebugEvent = 1U << 31;

  explicit SystemControl(Nvic& nvic) : nvic_(nvic) {}

  void reset(std::uint64_t cycle);

  /// @brief Reads a word.
  /// @param address address of the word, at least 0xE0000000
  /// @param value receives the value
  /// @return false when there is no such register.
  [[nodiscard]] bool read(std::uint32_t address, std::uint64_t cycle, unsigned running,
                          std::uint32_t& value);

  [[nodiscard]] Written write(std::uint32_t address, unsigned size, std::uint32_t value,
                              std::uint64_t cycle);

  /// @brief Returns the cycle at which SysTick triggers its exception.
  [[nodiscard]] std::uint64_t nextEvent() const;

  /// @brief Advances SysTick to a cycle.
  void advance(std::uint64_t cycle);

  /// @brief Records the address of a bus fault, and marks this address as valid.
  void noteBusAddress(std::uint32_t address);
  void noteFault(std::uint32_t status) { faultStatus_ |= status; }
  void noteHardFault(std::uint32_t status) { hardFaultStatus_ |= status; }

  [[nodiscard]] std::uint32_t vectors() const { return vectors_; }
  [[nodiscard]] bool fpuOn() const { return (coprocessors_ >> 20 & 0xFU) == 0xFU; }
  [[nodiscard]] bool fpuStacks() const { return (fpContext_ & 1U << 31) != 0; }
  [[nodiscard]] std::uint32_t fpDefaults() const { return fpDefaults_; }
  [[nodiscard]] bool sleepsOnExit() const { return (control_ & 2U) != 0; }
  [[nodiscard]] bool sleepsDeep() const { return (control_ & 4U) != 0; }
  [[nodiscard]] bool alignsStack() const { return (configuration_ & 0x200U) != 0; }
  [[nodiscard]] bool trapsUnaligned() const { return (configuration_ & 8U) != 0; }
  [[nodiscard]] bool trapsDivideByZero() const { return (configuration_ & 0x10U) != 0; }
  [[nodiscard]] bool threadFromAnyLevel() const { return (configuration_ & 1U) != 0; }

 private:
  [[nodiscard]] std::uint32_t interruptState(unsigned running) const;
  [[nodiscard]] std::uint32_t handlerState() const;
  [[nodiscard]] std::uint32_t readSysTick(std::uint32_t offset, std::uint64_t cycle);
  void writeSysTick(std::uint32_t offset, std::uint32_t value, std::uint64_t cycle);
  void writeInterruptState(std::uint32_t value);
  void writeHandlerState(std::uint32_t value);
  [[nodiscard]] Written writeBlock(std::uint32_t offset, unsigned size, std::uint32_t value);

  Nvic& nvic_;
  std::uint32_t vectors_ = 0;
  std::uint32_t control_ = 0;
  std::uint32_t configuration_ = 0;
  std::uint32_t auxiliary_ = 0;
  std::uint32_t faultStatus_ = 0;
  std::uint32_t hardFaultStatus_ = 0;
  std::uint32_t busAddress_ = 0;
  std::uint32_t coprocessors_ = 0;
  std::uint32_t fpContext_ = 0;
  std::uint32_t fpDefaults_ = 0;
  std::uint32_t debug_ = 0;
  std::uint32_t tickControl_ = 0;
  std::uint32_t tickReload_ = 0;
  std::uint64_t tickZeroAt_ = 0;  ///< cycle at which SysTick reaches 0
  std::uint32_t tickValue_ = 0;   ///< value of SysTick while it is stopped
  std::uint32_t traceControl_ = 0;
  std::uint64_t cyclesFrom_ = 0;  ///< cycle at which a running CYCCNT was 0
  std::uint32_t cyclesHeld_ = 0;  ///< value of CYCCNT while it is stopped
};

}  // namespace wr::emulator
