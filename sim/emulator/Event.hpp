#pragma once

#include <chrono>
#include <cstdint>

namespace wr::emulator {

/// @brief Cause of a reset of the board.
enum class Reset { PowerOn, LowVoltage, Pin, Watchdog, ClockLost, Lockup, Software, LockLost };

/// @brief An event on the board.
struct Event {
  enum class Kind {
    ExceptionEntered,  ///< number: number of the exception
    ExceptionLeft,     ///< number: number of the exception
    Reset,             ///< number: value of Reset
    PinChanged,        ///< number: 32 * port + pin; value: level that the program outputs
    ByteSent,          ///< end of a stop bit; number: number of the UART; value: the byte
    PwmChanged,        ///< number: 8 * FTM + channel; value: duty cycle in millionths
    LineRaised,        ///< number: number of the exception; a device has raised its interrupt line
    ByteReceived       ///< end of a stop bit; number: number of the UART; value: the byte
  };
  Kind kind;
  std::chrono::nanoseconds at;
  std::uint32_t number = 0;
  std::uint32_t value = 0;
};

}  // namespace wr::emulator
