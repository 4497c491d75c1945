#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/k64/Nvic.hpp"
#include "sim/k64/SystemControl.hpp"

struct uc_struct;

namespace wr::k64 {

class ExecutedCode;

/// @brief A Cortex-M4F: instructions by the Unicorn engine; exceptions, interrupt controller and
/// system control by this class.
///
/// Unicorn is under the GPL. It is linked to the simulator and its tests only, never to the
/// firmware.
///
/// Time is counted in cycles: one for each instruction, 12 for the entry to an exception, 10 for
/// the return from it, 6 from one exception to the next. The same program gives the same run,
/// always.
///
/// Not modelled: bit-banding, the memory protection unit, a fault from an unaligned LDRD, LDM or
/// VLDR, lazy stacking of the floating-point registers (they are stacked at entry).
class CortexM4 {
 public:
  /// @brief What a program may do with memory.
  enum class Access { ReadWrite, ReadExecute, ReadWriteExecute };

  /// @brief What the program did that stopped it.
  struct Problem {
    std::string id;        ///< kind of finding
    std::string what;      ///< what happened, in words
    std::uint32_t pc = 0;  ///< instruction that did it
  };

  /// @brief Why run() returned.
  enum class Stop {
    Limit,    ///< the limit was reached, or stop() was called
    Sleep,    ///< the program waits for an interrupt
    Problem,  ///< problem() tells what it did
    Exit      ///< exit() was called
  };

  /// @brief Why an exception was entered or left.
  enum class Step { Entered, Left };

  using Read = std::function<std::uint32_t(std::uint32_t address, unsigned size)>;
  using Write = std::function<void(std::uint32_t address, unsigned size, std::uint32_t value)>;

  /// @brief Makes a processor without memory.
  /// @param lines number of interrupt lines, 1 to 240
  /// @param priorityBits number of bits of a priority, 3 to 8
  explicit CortexM4(unsigned lines = 110, unsigned priorityBits = 4);
  ~CortexM4();
  CortexM4(const CortexM4&) = delete;
  CortexM4& operator=(const CortexM4&) = delete;

  /// @brief Adds memory.
  /// @param address first address, a multiple of 4096
  /// @param size bytes, a multiple of 4096
  /// @param access what the program may do with it
  void mapMemory(std::uint32_t address, std::uint32_t size, Access access);

  /// @brief Adds a range of addresses whose accesses are calls.
  /// @param address first address, a multiple of 4096
  /// @param size bytes, a multiple of 4096
  /// @param read gives what the program reads
  /// @param write takes what the program writes
  void mapWindow(std::uint32_t address, std::uint32_t size, Read read, Write write);

  /// @brief Adds the last page of a memory, 4096 bytes, from which an access across its end faults.
  /// @param address the border of the two memories, at the end of the page
  void mapBorder(std::uint32_t address);

  /// @brief Writes memory from outside, also where the program may not.
  void load(std::uint32_t address, std::span<const std::uint8_t> bytes);

  /// @brief Reads a word of memory from outside.
  [[nodiscard]] std::uint32_t word(std::uint32_t address) const;

  /// @brief Resets the processor: stack pointer and start from the vectors at address 0.
  void reset();

  /// @brief Runs the program.
  /// @param limit number of cycles since construction at which to return
  /// @return why it returned
  Stop run(std::uint64_t limit);

  /// @brief Makes run() return at a cycle earlier than its limit. For calls of windows.
  void limitTo(std::uint64_t cycle);

  /// @brief Makes run() return before the next instruction. For calls of windows.
  void stop() { limitTo(0); }

  /// @brief Makes run() return Stop::Exit before the next instruction.
  void exit();

  /// @brief Lets time pass without an instruction, as in sleep.
  void skipTo(std::uint64_t cycle);

  /// @brief Cycles since construction; a reset does not clear them.
  [[nodiscard]] std::uint64_t cycles() const;

  /// @brief Instructions since construction.
  [[nodiscard]] std::uint64_t instructions() const;

  /// @brief The instruction that runs, or the next one.
  [[nodiscard]] std::uint32_t pc() const;

  /// @brief A core register, 0 to 15.
  [[nodiscard]] std::uint32_t core(unsigned number) const;
  void setCore(unsigned number, std::uint32_t value);

  /// @brief Number of the exception that runs, 0 in thread mode.
  [[nodiscard]] unsigned exception() const;

  /// @brief Sets the level of an interrupt line.
  void setLine(unsigned line, bool high);

  /// @brief Pends an exception as the hardware does; a fault is taken at the next instruction.
  /// @param exception number, 2 NMI, 3 HardFault, ... 16 interrupt line 0
  void raise(unsigned exception);

  /// @brief An access of a window gets a bus fault, or is a problem when faults are.
  /// @param id kind of finding
  /// @param what what happened, in words
  void refuse(std::uint32_t address, std::string id, std::string what);

  /// @brief Stops the program with a problem, whatever the treatment of faults.
  void report(std::string id, std::string what);

  /// @brief The problem that stopped the program.
  [[nodiscard]] const std::optional<Problem>& problem() const;

  /// @brief Faults stop the program as problems (true), or are delivered to it (false, at first).
  void setFaultsAreProblems(bool problems);

  /// @brief Sets what is called at BKPT 0xAB. The call sets register 0; the program goes on after it.
  void onSemihosting(std::function<void(CortexM4&)> call);

  /// @brief Sets what is called when an exception was entered or left.
  void onException(std::function<void(Step, unsigned exception)> call);

  /// @brief Sets what is called when the program asks for a reset.
  void onResetRequest(std::function<void()> call);

  /// @brief Sets what is called when a fault meets no handler that may run. Without it: a problem.
  void onLockup(std::function<void()> call);

  /// @brief Sets what is called at the start of each block of instructions. Set before the first run.
  void onBlock(std::function<void(std::uint32_t address)> call);

  /// @brief Notes each instruction that is executed from now on.
  /// @param code where they are noted; must outlive the processor
  void noteExecuted(ExecutedCode& code) { executed_ = &code; }

 private:
  struct Hooks;
  struct Window {
    CortexM4* owner;
    std::uint32_t address;
    Read read;
    Write write;
  };
  struct Release {
    void operator()(std::uint8_t* bytes) const { std::free(bytes); }
  };
  struct Memory {
    std::uint32_t address;
    std::uint32_t size;
    Access access;
    std::unique_ptr<std::uint8_t, Release> bytes;  // what the engine reads and writes
  };

  void mapMemory(std::uint32_t address, std::uint32_t size, std::uint32_t rights, Access access);
  [[nodiscard]] std::uint32_t reg(int id) const;
  void setReg(int id, std::uint32_t value) const;
  template <std::size_t Count>
  [[nodiscard]] std::array<std::uint32_t, Count> regs(std::array<int, Count> ids) const;
  template <std::size_t Count>
  void setRegs(std::array<int, Count> ids, std::array<std::uint32_t, Count> values) const;
  [[nodiscard]] std::uint8_t* at(std::uint32_t address, std::uint32_t size) const;
  [[nodiscard]] std::uint16_t halfword(std::uint32_t address) const;
  [[nodiscard]] std::uint8_t* stackAt(std::uint32_t address) const;
  template <typename Value>
  [[nodiscard]] Value load(std::uint32_t address) const;
  bool push(std::uint32_t address, std::span<const std::uint32_t> words) const;
  bool pop(std::uint32_t address, std::span<std::uint32_t> words) const;

  [[nodiscard]] int executionPriority(bool withPrimask = true) const;
  void reevaluate() { stopAt_ = 0; }
  void takePending();
  bool enterNext();
  void execute();
  void stopped(int error);
  void pass(std::uint64_t cycles) { skipTo(cycles_ + cycles); }
  void lookAt(uc_struct* engine);
  bool mayRun(std::uint32_t address);
  void hint(std::uint32_t past);
  void enter(unsigned exception, std::uint32_t returnsTo);
  void vector(unsigned exception, std::uint32_t link);
  [[nodiscard]] bool stack(std::uint32_t returnsTo, std::uint32_t& link);
  void exceptionReturn(std::uint32_t link);
  [[nodiscard]] bool linkIsValid(std::uint32_t link, unsigned number) const;
  void unstack(std::uint32_t link);
  void setItBits(std::uint32_t state) const;
  void fault(unsigned exception, std::uint32_t status, std::uint32_t pc, const std::string& id,
             const std::string& what);
  void deliver(unsigned exception, std::uint32_t pc);
  void supervisorCall(std::uint32_t past);
  void breakpoint(std::uint32_t at);
  void badAccess();
  void lockUp(std::uint32_t pc);

  uc_struct* engine_ = nullptr;
  Nvic nvic_;
  SystemControl system_;
  std::vector<std::unique_ptr<Window>> windows_;
  std::vector<Memory> memories_;
  std::uint64_t cycles_ = 0;
  std::uint64_t otherCycles_ = 0;  ///< those in which no instruction ran
  std::uint64_t limit_ = 0;
  std::uint64_t stopAt_ = 0;
  std::uint32_t pc_ = 0;
  unsigned exception_ = 0;
  bool running_ = false;  ///< inside the engine
  bool stoppedByHook_ = false;
  bool careful_ = false;  ///< it is asked for each instruction whether it may run
  bool looks_ = false;    ///< there is more to do for each instruction than to count it
  bool maskedPending_ = false;
  bool resumed_ = false;  ///< the next block was begun before
  bool sleeping_ = false;
  bool exit_ = false;
  bool faultsAreProblems_ = false;
  int interrupt_ = -1;  ///< exception of the engine
  std::uint32_t borderAt_ = 0;
  std::uint32_t badAddress_ = 0;
  int badAccess_ = -1;
  struct Refused {
    std::uint32_t address;
    std::string id;
    std::string what;
  };
  std::optional<Refused> refused_;
  unsigned raised_ = 0;
  std::optional<Problem> problem_;
  std::function<void(CortexM4&)> semihosting_;
  std::function<void(Step, unsigned)> exceptionCall_;
  std::function<void()> resetCall_;
  std::function<void()> lockupCall_;
  std::function<void(std::uint32_t)> blockCall_;
  ExecutedCode* executed_ = nullptr;
};

}  // namespace wr::k64
