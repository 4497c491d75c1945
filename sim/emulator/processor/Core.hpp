#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <functional>
#include <span>
#include <utility>

#include "sim/emulator/ExecutedCode.hpp"
#include "sim/emulator/Timing.hpp"
#include "sim/emulator/processor/Instruction.hpp"
#include "sim/emulator/processor/Memory.hpp"
#include "sim/emulator/processor/Registers.hpp"

namespace wr::emulator {

/// @brief An event that an instruction causes. The event is handled outside of the normal program
/// flow.
enum class Trap : std::uint8_t {
  None,
  Sleep,
  SupervisorCall,
  ExceptionReturn,  ///< trapAddress() is the EXC_RETURN value
  // The following values are faults. If an instruction causes a fault, it has no other effect.
  Breakpoint,
  Undefined,
  NoCoprocessor,
  FpuOff,
  InvalidState,
  Unaligned,
  DivideByZero,
  InstructionBus,
  InstructionViolation,
  LoadBus,  ///< trapAddress() is the address of the access; there is no memory at this address
  StoreBus,
  LoadAcross,  ///< load that crosses the border between two memories
  StoreAcross,
  FlashStore,
  Refused  ///< the owner of a window rejected the access and has stored the reason
};

/// @brief The part of the processor that executes instructions one after the other. Another class
/// handles the exceptions.
///
/// The operations of the instructions use the public members.
class Core {
 public:
  /// @brief Settings of the floating-point unit in the registers of system control.
  struct Fpu {
    bool on = false;             ///< CPACR
    bool activates = false;      ///< FPCCR.ASPEN
    std::uint32_t defaults = 0;  ///< FPDSCR
  };

  explicit Core(Timing timing)
      : memory(timing == Timing::NoWaitStates), slowFlash_(timing == Timing::SlowFlash) {}

  Registers registers;
  Memory memory;
  Fpu fpu;
  bool trapsUnaligned = false;        ///< CCR.UNALIGN_TRP
  bool trapsDivideByZero = false;     ///< CCR.DIV_0_TRP
  std::uint32_t priorityMask = 0xF0;  ///< implemented bits of a priority
  bool maskedPending = false;         ///< PRIMASK, FAULTMASK or BASEPRI blocks a pending exception
  bool exclusive = false;             ///< state of the local monitor (ARMv7-M ARM, A3.4.1)
  std::uint32_t next = 0;             ///< address of the next instruction

  /// @brief Executes instructions until the cycle of setStop() is reached or a trap occurs.
  /// @return the trap, which is then cleared
  Trap run();

  /// @brief Sets the cycle at which run() returns. At this cycle, no further instruction begins.
  void setStop(std::uint64_t cycle) { stopAt_ = cycle; }
  [[nodiscard]] std::uint64_t stop() const { return stopAt_; }

  [[nodiscard]] std::uint64_t cycles() const { return instructions_ + otherCycles_; }
  [[nodiscard]] std::uint64_t instructions() const { return instructions_; }

  /// @brief Adds the additional cycles of an instruction. Its first cycle is already counted.
  void spend(std::uint64_t cycles) { otherCycles_ += cycles; }

  /// @brief Returns the address of the running or the last instruction.
  [[nodiscard]] std::uint32_t at() const { return registers.r[Registers::kPc] - 4; }

  /// @brief Reports that an exception mask has changed. The new mask may permit the entry of a
  /// pending exception.
  void masksChanged() {
    if (maskedPending) {
      stopAt_ = 0;
    }
  }

  /// @brief Ends run() after the running instruction, with a trap.
  void trap(Trap trap, std::uint32_t address = 0) {
    trap_ = trap;
    trapAddress_ = address;
    stopAt_ = 0;
  }
  [[nodiscard]] std::uint32_t trapAddress() const { return trapAddress_; }

  /// @brief Makes the program continue at another address.
  void branch(std::uint32_t address) {
    spend(kRefillCycles);
    next = address & ~1U;
    branched_ = true;
  }

  /// @brief Makes the program continue at an address. The lowest bit of the address selects the
  /// instruction set (BXWritePC, A2.3.1).
  void branchAndExchange(std::uint32_t address);

  /// @brief Makes the program continue at an address. An EXC_RETURN value does not cause a return
  /// from an exception (BLXWritePC).
  void branchOnly(std::uint32_t address);

  /// @brief Loads a number if this is possible without a function call. A number of a signed type
  /// is sign-extended.
  /// @return false if a function call is needed
  template <typename Value>
  [[nodiscard]] bool loadDirectly(std::uint32_t address, std::uint32_t& value) const {
    const Memory::Direct& direct = memory.direct(address);
    const std::uint32_t offset = address - direct.address;
    if (offset >= direct.loads || (address & (sizeof(Value) - 1)) != 0) [[unlikely]] {
      return false;
    }
    Value loaded{};
    std::memcpy(&loaded, direct.bytes + offset, sizeof loaded);
    value = static_cast<std::uint32_t>(std::int32_t{0} + loaded);
    return true;
  }

  /// @brief Loads a number from any address, also from a peripheral.
  /// @return false in case of a trap
  template <typename Value>
  [[nodiscard]] bool load(std::uint32_t address, std::uint32_t& value) {
    if (loadDirectly<Value>(address, value)) [[likely]] {
      return true;
    }
    if (!loadElsewhere(address, sizeof(Value), value)) {
      return false;
    }
    value = static_cast<std::uint32_t>(std::int32_t{0} + static_cast<Value>(value));
    return true;
  }

  /// @brief Stores a number if this is possible without a function call.
  /// @return false if a function call is needed
  template <typename Value>
  [[nodiscard]] bool storeDirectly(std::uint32_t address, std::uint32_t value) const {
    const Memory::Direct& direct = memory.direct(address);
    const std::uint32_t offset = address - direct.address;
    if (offset >= direct.stores || (address & (sizeof(Value) - 1)) != 0) [[unlikely]] {
      return false;
    }
    const auto stored = static_cast<Value>(value);
    std::memcpy(direct.bytes + offset, &stored, sizeof stored);
    return true;
  }

  /// @brief Stores a number at any address, also in a peripheral.
  /// @return false in case of a trap
  template <typename Value>
  [[nodiscard]] bool store(std::uint32_t address, std::uint32_t value) {
    return storeDirectly<Value>(address, value) || storeElsewhere(address, sizeof(Value), value);
  }

  /// @brief Loads a word for LDRD and similar instructions. The address must be aligned.
  [[nodiscard]] bool loadAligned(std::uint32_t address, std::uint32_t& value);
  [[nodiscard]] bool storeAligned(std::uint32_t address, std::uint32_t value);

  /// @brief Loads successive words for LDM and VLDM. If a trap ends the loads, the words that were
  /// already loaded stay in `words`.
  [[nodiscard]] bool loadWords(std::uint32_t address, std::span<std::uint32_t> words);
  [[nodiscard]] bool storeWords(std::uint32_t address, std::span<const std::uint32_t> words);

  /// @brief Begins a floating-point instruction (ExecuteFPCheck, ARMv7-M ARM, A2.5.4).
  /// @return false in case of a trap
  [[nodiscard]] bool beginFp();

  /// @brief Adds the cycles of a read from flash, for example of a vector. This function is not for
  /// fetches of instructions.
  void spendForRead(std::uint32_t address);

  /// @brief Records that the next instruction does not begin a block, for example after the entry
  /// of an exception.
  void continueBlock() { branched_ = false; }
  void beginBlock() { branched_ = true; }
  [[nodiscard]] bool beginsBlock() const { return branched_; }

  void noteExecuted(ExecutedCode& code) { executed_ = &code; }
  void noteStack(std::uint32_t& lowest) { lowestStack_ = &lowest; }
  void onBlock(std::function<void(std::uint32_t)> call) { blockCall_ = std::move(call); }

  /// @brief Sets the callback that runs before each instruction. The callback may change registers,
  /// memory and `next`.
  void onInstruction(std::function<void()> call) { instructionCall_ = std::move(call); }

 private:
  template <bool kSlowFlash, bool kLooks>
  void runInstructions();
  void execute(const Instruction& instruction);
  void executeInBlock(const Instruction& instruction);
  [[nodiscard]] const Instruction* placeOf(std::uint32_t address) const;
  [[nodiscard]] const Instruction* decodeAt(std::uint32_t address);
  [[nodiscard]] bool fetchHalf(std::uint32_t address, std::uint32_t& half);
  void fetchSlowly(std::uint32_t address, std::uint32_t size);
  void note(std::uint32_t address);
  [[nodiscard]] bool loadElsewhere(std::uint32_t address, std::uint32_t size, std::uint32_t& value);
  [[nodiscard]] bool storeElsewhere(std::uint32_t address, std::uint32_t size, std::uint32_t value);
  [[nodiscard]] bool unalignedIsFine(const Memory::Area* area, std::uint32_t address,
                                     std::uint32_t size);

  std::uint64_t instructions_ = 0;
  std::uint64_t otherCycles_ = 0;
  std::uint64_t stopAt_ = 0;
  std::uint32_t codeAddress_ = 0;  ///< first address of the memory that is executed at present
  std::uint32_t codeSize_ = 0;
  Instruction* code_ = nullptr;
  std::uint32_t phrase_ =
      1;  ///< the phrase that was last read from the flash; 1 (no phrase) at the start
  std::uint32_t trapAddress_ = 0;
  Trap trap_ = Trap::None;
  bool slowFlash_;
  bool codeIsSlow_ = false;  ///< the executed memory is flash
  bool branched_ = false;
  Instruction none_{};  ///< not decoded; the entry of each address outside of the executed memory
  ExecutedCode* executed_ = nullptr;
  std::uint32_t* lowestStack_ = nullptr;
  std::function<void(std::uint32_t)> blockCall_;
  std::function<void()> instructionCall_;
};

}  // namespace wr::emulator
