#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/emulator/Nvic.hpp"
#include "sim/emulator/SystemControl.hpp"
#include "sim/emulator/Timing.hpp"
#include "sim/emulator/processor/Core.hpp"

namespace wr::emulator {

/// @brief A Cortex-M4F with its core, exceptions, interrupt controller and system control.
///
/// Time is counted in cycles, according to Timing. With the same inputs, a program always runs in
/// the same way.
///
/// The model has no bit-banding, no memory protection unit and no interrupts during LDM and STM.
/// The floating-point registers are stacked at the entry of an exception. There is no lazy
/// stacking.
class CortexM4 {
 public:
  using Access = Memory::Access;
  using Read = Memory::Read;
  using Write = Memory::Write;

  /// @brief A problem that stopped the processor. Its cause is an action of the program.
  struct Problem {
    std::string id;        ///< kind of finding
    std::string what;      ///< description
    std::uint32_t pc = 0;  ///< instruction that caused the problem
  };

  /// @brief Reason for the return of run().
  enum class Stop {
    Limit,    ///< the limit was reached, or stop() was called
    Sleep,    ///< the program waits for an interrupt
    Problem,  ///< problem() returns the reason
    Exit      ///< exit() was called
  };

  /// @brief Entry or exit of an exception.
  enum class Step { Entered, Left };

  /// @brief Constructs a processor without memory.
  /// @param lines number of interrupt lines, 1 to 240
  /// @param priorityBits number of bits of a priority, 3 to 8
  /// @param timing model of the duration of instructions
  explicit CortexM4(unsigned lines = 110, unsigned priorityBits = 4,
                    Timing timing = Timing::NoWaitStates);
  CortexM4(const CortexM4&) = delete;
  CortexM4& operator=(const CortexM4&) = delete;

  /// @brief Adds memory.
  /// @param address first address, a multiple of 4096
  /// @param size number of bytes, a multiple of 4096
  /// @param access accesses that the program may make
  void mapMemory(std::uint32_t address, std::uint32_t size, Access access);

  /// @brief Adds a range of addresses. Each access to this range calls a function.
  /// @param address first address, a multiple of 4096
  /// @param size number of bytes, a multiple of 4096
  /// @param read returns the value that the program reads
  /// @param write receives the value that the program writes
  void mapWindow(std::uint32_t address, std::uint32_t size, Read read, Write write);

  /// @brief Writes memory for the caller, even memory that the program must not write.
  void load(std::uint32_t address, std::span<const std::uint8_t> bytes);

  /// @brief Reads a word of memory for the caller.
  [[nodiscard]] std::uint32_t word(std::uint32_t address) const {
    return core_.memory.read<std::uint32_t>(address);
  }

  /// @brief Resets the processor. The stack pointer and the start address are read from the vectors
  /// at address 0.
  void reset();

  /// @brief Runs the program.
  /// @param limit run() returns when this many cycles have passed since construction
  /// @return reason of the return
  Stop run(std::uint64_t limit);

  /// @brief Makes run() return at a given cycle, if this cycle is before the limit of run(). The
  /// functions that were passed to mapWindow() may call this function.
  void limitTo(std::uint64_t cycle);

  /// @brief Makes run() return before the next instruction. The functions that were passed to
  /// mapWindow() may call this function.
  void stop() { limitTo(0); }

  /// @brief Makes run() return Stop::Exit before the next instruction.
  void exit();

  /// @brief Advances the time without executing an instruction, as during sleep.
  void skipTo(std::uint64_t cycle);

  /// @brief Returns the number of cycles since construction. A reset does not clear this number.
  [[nodiscard]] std::uint64_t cycles() const { return core_.cycles(); }

  /// @brief Returns the number of instructions since construction.
  [[nodiscard]] std::uint64_t instructions() const { return core_.instructions(); }

  /// @brief Returns the address of the running instruction. Between two instructions, returns the
  /// address of the next instruction.
  [[nodiscard]] std::uint32_t pc() const;

  /// @brief Returns a core register, 0 to 15.
  [[nodiscard]] std::uint32_t core(unsigned number) const;
  void setCore(unsigned number, std::uint32_t value);

  /// @brief Returns the number of the running exception; 0 in thread mode.
  [[nodiscard]] unsigned exception() const { return core_.registers.exception; }

  /// @brief Returns the priority of an exception, in the form of the priority registers.
  [[nodiscard]] int priority(unsigned exception) const { return nvic_.priority(exception); }

  /// @brief Sets the level of an interrupt line.
  void setLine(unsigned line, bool high);

  /// @brief Triggers an exception as the hardware does. A fault is entered before the next
  /// instruction.
  /// @param exception number of the exception, e.g. 2 for NMI, 3 for HardFault, 16 for interrupt
  /// line 0
  void raise(unsigned exception);

  /// @brief Rejects the present access to a range of mapWindow(). The access causes a bus fault.
  /// After setFaultsAreProblems(true), it causes a problem instead.
  /// @param id kind of finding
  /// @param event description
  void refuse(std::uint32_t address, std::string id, std::string event);

  /// @brief Stops the program with a problem, also when faults are passed to handlers.
  void report(std::string id, std::string what);

  /// @brief Returns the problem that stopped the program.
  [[nodiscard]] const std::optional<Problem>& problem() const;

  /// @brief Sets the handling of faults. true: a fault stops the program as a problem. false, the
  /// initial setting: a fault is passed to its handler.
  void setFaultsAreProblems(bool problems);

  /// @brief Sets the callback for BKPT 0xAB. The callback sets register 0. Then the program
  /// continues.
  void onSemihosting(std::function<void(CortexM4&)> call);

  /// @brief Sets the callback for each entry and each exit of an exception.
  void onException(std::function<void(Step, unsigned exception)> call);

  /// @brief Sets the callback for reset requests of the program.
  void onResetRequest(std::function<void()> call);

  /// @brief Sets the callback for a fault whose handler cannot run. Without a callback the fault is
  /// a problem.
  void onLockup(std::function<void()> call);

  /// @brief Sets the callback for an access that is not modelled. Without a callback the access is
  /// a problem.
  /// @param call gets a description of the access. If it returns true, the program continues: a
  /// load returns 0, and a store has no effect
  void onUnmodelled(std::function<bool(const std::string& what)> call);

  /// @brief Sets the callback that runs at the start of each block. A block begins with the first
  /// instruction after a reset or after a branch.
  void onBlock(std::function<void(std::uint32_t address)> call);

  /// @brief Sets the callback that runs before each instruction, for a debugger. The callback may
  /// change the registers. It may change memory with load().
  void onInstruction(std::function<void()> call) { core_.onInstruction(std::move(call)); }

  /// @brief Sets the callback that runs after each load and store of the program. An empty function
  /// removes the callback.
  void onAccess(std::function<void(std::uint32_t address, std::uint32_t size, bool store)> call) {
    core_.memory.observe(std::move(call));
  }

  /// @brief Returns all registers, for a debugger. The address of the next instruction is core(15).
  [[nodiscard]] Registers& registers() { return core_.registers; }

  /// @brief Returns the memory, for a debugger.
  [[nodiscard]] const Memory& memory() const { return core_.memory; }

  /// @brief Reads a register of system control without a side effect.
  /// @param address a multiple of 4
  /// @param value receives the content
  /// @return false if there is no register, or if reading it has a side effect
  [[nodiscard]] bool inspectSystem(std::uint32_t address, std::uint32_t& value);

  /// @brief Starts to record each executed instruction.
  /// @param code receives the records; must outlive the processor
  void noteExecuted(ExecutedCode& code) { core_.noteExecuted(code); }

  /// @brief Starts to record the lowest stack pointer.
  /// @param lowest receives the lowest value; must outlive the processor
  void noteStack(std::uint32_t& lowest) { core_.noteStack(lowest); }

 private:
  [[nodiscard]] std::uint32_t readSystem(std::uint32_t address, unsigned size);
  void writeSystem(std::uint32_t address, unsigned size, std::uint32_t value);
  void systemChanged();
  void unmodelled(std::uint32_t address, const std::string& what);
  [[nodiscard]] bool isTolerated(const std::string& what) const;

  [[nodiscard]] int executionPriority(bool withPrimask = true) const;
  void reevaluate() { core_.setStop(0); }
  void takePending();
  bool enterNext();
  void execute();
  void serve(Trap trap);
  void sleep();
  void supervisorCall();
  void breakpoint();
  void enter(unsigned exception, std::uint32_t returnsTo);
  void vector(unsigned exception, std::uint32_t link);
  [[nodiscard]] bool stack(std::uint32_t returnsTo, std::uint32_t& link);
  void exceptionReturn(std::uint32_t link);
  [[nodiscard]] bool linkIsValid(std::uint32_t link, unsigned number) const;
  void unstack(std::uint32_t link);
  void instructionFault(Trap trap);
  void accessFault(Trap trap);
  void fault(unsigned exception, std::uint32_t status, std::uint32_t pc, const std::string& id,
             const std::string& what);
  void deliver(unsigned exception, std::uint32_t pc);
  void lockUp(std::uint32_t pc);

  struct Refused {
    std::uint32_t address;
    std::string id;
    std::string what;
  };

  Core core_;
  Nvic nvic_;
  SystemControl system_;
  std::uint64_t limit_ = 0;
  bool running_ = false;  ///< the core executes instructions
  bool sleeping_ = false;
  std::vector<bool>
      blockWaits_;  ///< for each entered exception: true if it was entered at the start of a block
  bool exit_ = false;
  bool faultsAreProblems_ = false;
  unsigned raised_ = 0;
  std::optional<Refused> refused_;
  std::optional<Problem> problem_;
  std::function<void(CortexM4&)> semihosting_;
  std::function<void(Step, unsigned)> exceptionCall_;
  std::function<void()> resetCall_;
  std::function<void()> lockupCall_;
  std::function<bool(const std::string&)> unmodelledCall_;
};

}  // namespace wr::emulator
