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

/// @brief A Cortex-M4F: the core that executes the instructions, with its exceptions, interrupt
/// controller and system control.
///
/// Time is counted in cycles, according to Timing. All runs of a program are equal.
///
/// Not modelled: bit-banding, the memory protection unit, lazy stacking of the floating-point
/// registers (they are stacked at entry), and interrupts during LDM and STM.
class CortexM4 {
 public:
  using Access = Memory::Access;
  using Read = Memory::Read;
  using Write = Memory::Write;

  /// @brief Action of the program that stopped the processor.
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

  /// @brief Reason for the entry or the exit of an exception.
  enum class Step { Entered, Left };

  /// @brief Constructs a processor without memory.
  /// @param lines number of interrupt lines, 1 to 240
  /// @param priorityBits number of bits of a priority, 3 to 8
  /// @param timing cost of instructions
  explicit CortexM4(unsigned lines = 110, unsigned priorityBits = 4,
                    Timing timing = Timing::NoWaitStates);
  CortexM4(const CortexM4&) = delete;
  CortexM4& operator=(const CortexM4&) = delete;

  /// @brief Adds memory.
  /// @param address first address, a multiple of 4096
  /// @param size bytes, a multiple of 4096
  /// @param access access of the program
  void mapMemory(std::uint32_t address, std::uint32_t size, Access access);

  /// @brief Adds a range of addresses whose accesses are calls.
  /// @param address first address, a multiple of 4096
  /// @param size bytes, a multiple of 4096
  /// @param read returns the value that the program reads
  /// @param write receives the value that the program writes
  void mapWindow(std::uint32_t address, std::uint32_t size, Read read, Write write);

  /// @brief Writes memory from outside, even where the program may not write.
  void load(std::uint32_t address, std::span<const std::uint8_t> bytes);

  /// @brief Reads a word of memory from outside.
  [[nodiscard]] std::uint32_t word(std::uint32_t address) const {
    return core_.memory.read<std::uint32_t>(address);
  }

  /// @brief Resets the processor: stack pointer and start from the vectors at address 0.
  void reset();

  /// @brief Runs the program.
  /// @param limit number of cycles since construction at which to return
  /// @return reason of the return
  Stop run(std::uint64_t limit);

  /// @brief Makes run() return at a cycle earlier than its limit. The calls of windows use it.
  void limitTo(std::uint64_t cycle);

  /// @brief Makes run() return before the next instruction. The calls of windows use it.
  void stop() { limitTo(0); }

  /// @brief Makes run() return Stop::Exit before the next instruction.
  void exit();

  /// @brief Lets time pass without an instruction, as during sleep.
  void skipTo(std::uint64_t cycle);

  /// @brief Returns the cycles since construction; a reset does not clear them.
  [[nodiscard]] std::uint64_t cycles() const { return core_.cycles(); }

  /// @brief Returns the instructions since construction.
  [[nodiscard]] std::uint64_t instructions() const { return core_.instructions(); }

  /// @brief Returns the instruction that runs, or the next instruction.
  [[nodiscard]] std::uint32_t pc() const;

  /// @brief Returns a core register, 0 to 15.
  [[nodiscard]] std::uint32_t core(unsigned number) const;
  void setCore(unsigned number, std::uint32_t value);

  /// @brief Returns the number of the exception that runs, 0 in thread mode.
  [[nodiscard]] unsigned exception() const { return core_.registers.exception; }

  /// @brief Returns the priority of an exception, as in its register.
  [[nodiscard]] int priority(unsigned exception) const { return nvic_.priority(exception); }

  /// @brief Sets the level of an interrupt line.
  void setLine(unsigned line, bool high);

  /// @brief Triggers an exception as the hardware does; a fault is entered at the next instruction.
  /// @param exception number, 2 NMI, 3 HardFault, ... 16 interrupt line 0
  void raise(unsigned exception);

  /// @brief Rejects the present access to a window with a bus fault, or with a problem if faults
  /// are problems.
  /// @param id kind of finding
  /// @param event description
  void refuse(std::uint32_t address, std::string id, std::string event);

  /// @brief Stops the program with a problem, independent of the handling of faults.
  void report(std::string id, std::string what);

  /// @brief Returns the problem that stopped the program.
  [[nodiscard]] const std::optional<Problem>& problem() const;

  /// @brief Sets whether faults stop the program as problems (true), or are passed to its handlers
  /// (false, at first).
  void setFaultsAreProblems(bool problems);

  /// @brief Sets the callback at BKPT 0xAB. The call sets register 0, and the program continues
  /// after it.
  void onSemihosting(std::function<void(CortexM4&)> call);

  /// @brief Sets the callback for each exception that was entered or left.
  void onException(std::function<void(Step, unsigned exception)> call);

  /// @brief Sets the callback for reset requests of the program.
  void onResetRequest(std::function<void()> call);

  /// @brief Sets the callback for a fault whose handler cannot run. Without a callback the fault is
  /// a problem.
  void onLockup(std::function<void()> call);

  /// @brief Sets the callback for an access that is not modelled. Without a callback the access is
  /// a problem.
  /// @param call gets a description of the access; returns true if the program continues: a load
  /// then returns 0, a store has no effect
  void onUnmodelled(std::function<bool(const std::string& what)> call);

  /// @brief Sets the callback that runs after a reset and after each branch, before the next
  /// instruction.
  void onBlock(std::function<void(std::uint32_t address)> call);

  /// @brief Sets the callback that runs before each instruction. A debugger uses it. The callback
  /// may change the registers, and memory with load().
  void onInstruction(std::function<void()> call) { core_.onInstruction(std::move(call)); }

  /// @brief Sets the callback that runs after each load and store of the program; empty: none.
  void onAccess(std::function<void(std::uint32_t address, std::uint32_t size, bool store)> call) {
    core_.memory.observe(std::move(call));
  }

  /// @brief Returns all registers, for a debugger. The address of the next instruction is core(15).
  [[nodiscard]] Registers& registers() { return core_.registers; }

  /// @brief Returns the memory, for a debugger.
  [[nodiscard]] const Memory& memory() const { return core_.memory; }

  /// @brief Reads a register of system control without an effect.
  /// @param address a multiple of 4
  /// @param value receives the content
  /// @return false if there is no register, or if reading has an effect
  [[nodiscard]] bool inspectSystem(std::uint32_t address, std::uint32_t& value);

  /// @brief Records each instruction that is executed from now on.
  /// @param code receives the records; must outlive the processor
  void noteExecuted(ExecutedCode& code) { core_.noteExecuted(code); }

  /// @brief Records the lowest stack pointer from now on.
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
  std::vector<bool> blockWaits_;  ///< for each entered exception: true if it came first in a block
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
