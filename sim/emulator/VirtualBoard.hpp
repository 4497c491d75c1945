#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "sim/emulator/CanFrame.hpp"
#include "sim/emulator/Event.hpp"
#include "sim/emulator/Finding.hpp"
#include "sim/emulator/Timing.hpp"

namespace wr::emulator {

class CallRecorder;
class DebugPort;
class ExecutedCode;

/// @brief Options of a virtual board.
struct Options {
  std::filesystem::path elf{};  ///< ELF file with the function names for findings; may be empty
  bool externalClock = true;    ///< the clock of 50 MHz is present
  unsigned failingClockStep =
      0;  ///< step that the clock generator never completes. 0: no step; 2: the change to the
          ///< external clock; 3: the lock of the PLL; 4: the change to the PLL
  std::array<bool, 2> calibrates{true, true};  ///< for each converter: the calibration succeeds
  bool resetsAreFindings = true;               ///< the run stops when the program causes a reset
  Timing timing = Timing::NoWaitStates;        ///< model of the duration of instructions
  bool faultsAreFindings = true;  ///< a fault stops the run; false: the program handles it
  bool unmodelledIsFinding =
      true;  ///< the run stops at an access that is not modelled. false: the access causes a
             ///< warning, a load returns 0, and a store has no effect
};

/// @brief A simulated board with a K64 microcontroller, its external clock and a serial line to a
/// PC. It runs the same firmware image as a real board.
class VirtualBoard {
 public:
  using nanoseconds = std::chrono::nanoseconds;

  /// @brief Switches the board on.
  /// @param image firmware image, which is the content of the flash from address 0; the rest of the
  /// flash is erased
  /// @param options options of the board
  explicit VirtualBoard(std::vector<std::uint8_t> image, Options options = {});
  ~VirtualBoard();
  VirtualBoard(const VirtualBoard&) = delete;
  VirtualBoard& operator=(const VirtualBoard&) = delete;

  /// @brief Runs to a time.
  /// @return true when the time was reached; false when a finding stopped the run.
  bool runUntil(nanoseconds time);

  /// @brief Runs until an interrupt is entered.
  /// @param irq interrupt line
  /// @param limit time at which the run ends at the latest
  /// @return true when the interrupt was entered; false when a finding stopped the run or the limit
  /// was reached.
  bool runToInterrupt(int irq, nanoseconds limit);

  /// @brief Runs until the program waits for an interrupt.
  /// @param limit time at which the run ends at the latest
  /// @return true when the program waits; false when a finding stopped the run or the limit was
  /// reached.
  bool runToSleep(nanoseconds limit);

  /// @brief Returns the time since the board was switched on.
  [[nodiscard]] nanoseconds now() const;

  /// @brief Returns the finding that stopped the run. The run cannot continue after a finding.
  [[nodiscard]] const std::optional<Finding>& finding() const;

  /// @brief Returns the warnings about accesses that are not modelled, since the last call. Only the
  /// first access of each kind causes a warning.
  [[nodiscard]] std::vector<Finding> takeWarnings();

  /// @brief Sends bytes from the PC, after the bytes that are still being sent.
  void receive(std::span<const std::uint8_t> bytes);

  /// @brief Sends bytes from the PC. The first bit begins at a given time. In successive calls, the
  /// time must not decrease.
  void receiveAt(nanoseconds time, std::span<const std::uint8_t> bytes);

  /// @brief Sends one byte from the PC with a wrong stop bit.
  void receiveBroken(std::uint8_t byte);

  /// @brief Sets the baud rate of the PC, in both directions. The initial baud rate is 115200.
  void setLineBaud(std::uint32_t baud);

  /// @brief Returns the bytes that the board has sent since the last call.
  [[nodiscard]] std::vector<std::uint8_t> takeSent();

  /// @brief Sends bytes to a serial port of the board, after the bytes that are still being sent.
  /// @param uart number of the UART: 0 (the serial line to the PC) or 4
  /// @param bytes the bytes
  void receiveOn(int uart, std::span<const std::uint8_t> bytes);

  /// @brief Returns the bytes that the board has sent at a serial port since the last call.
  /// @param uart number of the UART: 0 (the serial line to the PC) or 4
  [[nodiscard]] std::vector<std::uint8_t> takeSentOn(int uart);

  /// @brief Sets the baud rate of the device at a serial port. The initial baud rate is 115200.
  void setLineBaudOn(int uart, std::uint32_t baud);

  /// @brief Makes another node of the bus at CAN0 send a frame as soon as the bus is free.
  void receiveCan(CanFrame frame);

  /// @brief Returns the frames that the board has sent at CAN0 since the last call.
  [[nodiscard]] std::vector<CanFrame> takeSentCan();

  /// @brief Returns true when no frame is on the bus at CAN0 and no frame waits for this bus.
  [[nodiscard]] bool canIdle() const;

  /// @brief Returns true if no byte is being transferred to or from the PC.
  [[nodiscard]] bool lineIdle() const;

  /// @brief Returns the level of a pin, e.g. ('B', 22).
  [[nodiscard]] bool pin(char port, int number) const;

  /// @brief Puts a level on a pin from outside.
  void drive(char port, int number, bool level);

  /// @brief Puts a level on a pin from outside at a given time. If the time has passed, the pin
  /// gets the level immediately. Levels with the same time are applied in the order of the calls.
  void driveAt(nanoseconds time, char port, int number, bool level);

  /// @brief Returns true if the program drives the pin as a digital output.
  [[nodiscard]] bool isOutput(char port, int number) const;

  /// @brief Returns the duty cycle at the pin of a timer's channel, as a fraction of the period.
  /// @param ftm 0 to 3
  /// @param channel 0 to 7
  /// @return 0 to 1; 0 while the timer is stopped or no pin is connected to the channel.
  [[nodiscard]] double pwmDuty(int ftm, int channel) const;

  /// @brief Puts a voltage on an input of an analog-to-digital converter. The initial voltage is 0
  /// V.
  /// @param converter 0 or 1
  /// @param channel 0 to 23, as in field ADCH of SC1; 4 to 7 are the inputs with the suffix b
  /// @param volts voltage relative to ground
  void setAnalog(int converter, int channel, double volts);

  /// @brief Opens an input of an analog-to-digital converter. An open input has no source and no
  /// resistor. Each conversion of the input returns the voltage of the previous conversion.
  void openAnalog(int converter, int channel);

  /// @brief Sets a callback that runs at each multiple of a period of board time. The first call is
  /// at the next multiple. The callback runs before the instructions and events of its time. A
  /// callback may call the functions of the board, except the functions that run the board.
  /// Callbacks with the same time run in the order in which they were set.
  void onTime(nanoseconds period, std::function<void()> call);

  /// @brief Triggers an exception before the next instruction, as the hardware does. For example, 3
  /// is a HardFault.
  void raise(int exception);

  /// @brief Inverts a bit of flash or RAM. Throws std::invalid_argument if the address is neither
  /// in flash nor in RAM.
  /// @param address address of the byte
  /// @param bit 0 to 7
  void flipBit(std::uint32_t address, unsigned bit);

  /// @brief Returns a core register of the processor. Registers 13, 14 and 15 are the stack
  /// pointer, the link register and the address of the next instruction.
  [[nodiscard]] std::uint32_t core(unsigned number) const;

  /// @brief Sets a core register of the processor.
  void setCore(unsigned number, std::uint32_t value);

  /// @brief Hides an interrupt line from the processor, or connects it again.
  /// @param irq number of the interrupt line
  /// @param held true: the processor reads the interrupt line as low
  void holdInterrupt(int irq, bool held);

  /// @brief Starts or stops the external clock of 50 MHz.
  void setExternalClock(bool present);

  /// @brief Makes the PLL lose its lock and lock again.
  void loseLock();

  /// @brief Ends the failure that Options::failingClockStep selects.
  void endClockFailure();

  /// @brief Resets the board. RAM keeps its content, except with PowerOn.
  void reset(Reset cause);

  /// @brief Returns the number of resets since the board was switched on. Switching on is not
  /// counted.
  [[nodiscard]] int resets() const;

  [[nodiscard]] std::uint64_t instructions() const;
  [[nodiscard]] std::uint64_t cycles() const;

  /// @brief Returns the number of processor cycles in which the program waited for an interrupt.
  [[nodiscard]] std::uint64_t sleptCycles() const;

  /// @brief Returns the priority of an interrupt, 0 to 15. Priority 0 is the highest. The number of
  /// the exception must be 16 or more.
  [[nodiscard]] unsigned priority(unsigned exception) const;

  /// @brief Returns the frequency of the core clock [Hz].
  [[nodiscard]] std::uint32_t clockHz() const;

  /// @brief Returns a word of flash or RAM.
  [[nodiscard]] std::uint32_t word(std::uint32_t address) const;

  /// @brief Sets the callback for each event.
  void onEvent(std::function<void(const Event&)> call);

  /// @brief Sets the callback for each write to a peripheral. The callback runs before the write
  /// takes effect.
  void onWrite(std::function<void(std::uint32_t address, unsigned size, std::uint32_t value)> call);

  /// @brief Returns the port through which a debugger accesses the board.
  [[nodiscard]] DebugPort& debugPort();

  /// @brief Starts to record calls. This function must be called before the first run.
  void record(CallRecorder& recorder);

  /// @brief Starts to record each executed instruction.
  /// @param code receives the records; must outlive the board
  void noteExecuted(ExecutedCode& code);

  /// @brief Starts to record the lowest stack pointer.
  /// @param lowest receives the lowest value; must outlive the board
  void noteStack(std::uint32_t& lowest);

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace wr::emulator
