#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

namespace wr {

/// @brief Port of the microcontroller.
/// @datatype
enum class Port : std::uint8_t { A = 0, B = 1, C = 2, D = 3, E = 4 };

/// @brief What a pin is for.
/// @datatype
enum class Role : std::uint8_t {
  LowOutput,   ///< output, safe when low
  HighOutput,  ///< output, safe when high
  Input,       ///< input, pulled up
  Peripheral   ///< belongs to a peripheral
};

/// @brief What a pin is connected to: the number of its alternative.
/// @datatype
enum class Mux : std::uint8_t { Alt0 = 0, Gpio = 1, Alt3 = 3 };

/// @brief A pin of the microcontroller.
/// @datatype
struct Pin {
  Port port;            ///< its port
  std::uint8_t number;  ///< its number in the port, 0 to 31
  Mux mux;              ///< what it is connected to
  Role role;            ///< what it is for

  /// @brief Tells whether the firmware drives the pin.
  /// @return true for an output
  [[nodiscard]] constexpr bool isOutput() const {
    return role == Role::LowOutput || role == Role::HighOutput;
  }
};

/// @brief A line of the pin table.
/// @datatype
struct PinRow {
  Pin pin;                  ///< the pin
  std::string_view signal;  ///< name of the signal on it
  std::string_view header;  ///< where it is on the FRDM-K64F
  std::string_view text;    ///< what it does
};

// The pins that the firmware uses, one on a line. Left for inputs to come: the Hall sensors
// PTD0-PTD7 (J2 and J6), the currents of the wheels PTB2, PTB3, PTB10, PTB11 and the steering angle
// PTC10 (J4), the end stops PTA1 (J1) and PTC18 (J6), the remote control PTB18 and PTB19 (J1), a
// second serial port PTC14 and PTC15 (J199). Left alone: J2-2, which is PTC12 from revision E of
// the board on only; before, it is PTA0, a pin of the debugger.
// clang-format off
inline constexpr auto kPinTable = std::to_array<PinRow>({
    {{Port::A, 4, Mux::Gpio, Role::Input}, "button", "SW3", "After reset it is the NMI; as an input it is none."},
    {{Port::A, 18, Mux::Alt0, Role::Peripheral}, "EXTAL0", "50 MHz of the Ethernet chip", "Clock of the microcontroller."},
    {{Port::B, 16, Mux::Alt3, Role::Peripheral}, "UART0_RX", "USB debug port", "Bytes from the PC."},
    {{Port::B, 17, Mux::Alt3, Role::Peripheral}, "UART0_TX", "USB debug port", "Bytes to the PC."},
    {{Port::B, 22, Mux::Gpio, Role::LowOutput}, "light_red", "D12 red", "Low lights it: no control cycles run."},
    {{Port::E, 26, Mux::Gpio, Role::HighOutput}, "light_green", "D12 green", "Low lights it: control cycles run."},
    {{Port::C, 1, Mux::Gpio, Role::LowOutput}, "wheel_fl_pwm", "J1-5", "Tension of the front left wheel, FTM0_CH0."},
    {{Port::C, 2, Mux::Gpio, Role::LowOutput}, "wheel_fr_pwm", "J1-14", "Tension of the front right wheel, FTM0_CH1."},
    {{Port::C, 3, Mux::Gpio, Role::LowOutput}, "wheel_rl_pwm", "J1-16", "Tension of the rear left wheel, FTM0_CH2."},
    {{Port::C, 4, Mux::Gpio, Role::LowOutput}, "wheel_rr_pwm", "J2-4", "Tension of the rear right wheel, FTM0_CH3."},
    {{Port::C, 16, Mux::Gpio, Role::LowOutput}, "wheel_fl_orientation", "J1-2", "High turns the front left wheel backwards."},
    {{Port::C, 17, Mux::Gpio, Role::LowOutput}, "wheel_fr_orientation", "J1-4", "High turns the front right wheel backwards."},
    {{Port::B, 9, Mux::Gpio, Role::LowOutput}, "wheel_rl_orientation", "J1-6", "High turns the rear left wheel backwards."},
    {{Port::B, 23, Mux::Gpio, Role::LowOutput}, "wheel_rr_orientation", "J1-10", "High turns the rear right wheel backwards."},
    {{Port::C, 5, Mux::Gpio, Role::LowOutput}, "wheel_fl_enable", "J1-15", "High lets current into the front left wheel."},
    {{Port::C, 7, Mux::Gpio, Role::LowOutput}, "wheel_fr_enable", "J1-13", "High lets current into the front right wheel."},
    {{Port::C, 11, Mux::Gpio, Role::LowOutput}, "wheel_rl_enable", "J4-10", "High lets current into the rear left wheel."},
    {{Port::B, 20, Mux::Gpio, Role::LowOutput}, "wheel_rr_enable", "J4-9", "High lets current into the rear right wheel."},
    {{Port::C, 8, Mux::Gpio, Role::LowOutput}, "steering_step", "J1-7", "Each pulse turns the steering by one step, FTM3_CH4."},
    {{Port::C, 9, Mux::Gpio, Role::LowOutput}, "steering_direction", "J1-9", "High turns the steering to the left."},
    {{Port::C, 0, Mux::Gpio, Role::LowOutput}, "steering_enable", "J1-11", "High switches the steering motor on."},
});
// clang-format on

/// @brief The pins of the table without its texts, so that the texts take no flash.
inline constexpr auto kPins = [] {
  std::array<Pin, kPinTable.size()> pins{};
  std::transform(kPinTable.begin(), kPinTable.end(), pins.begin(),
                 [](const PinRow& row) { return row.pin; });
  return pins;
}();

/// @brief Finds the pin of a signal; a signal that no pin has does not compile.
/// @param signal name of the signal
/// @return its pin
consteval Pin pinOf(std::string_view signal) {
  return std::find_if(kPinTable.begin(), kPinTable.end(),
                      [signal](const PinRow& row) { return row.signal == signal; })
      ->pin;
}

namespace pin_rules {

/// @brief Tells whether the part, in its package with 100 pins, has all pins.
consteval bool allExist() {
  constexpr std::array<std::uint32_t, 5> kExisting = {0x000FF03F, 0x00FF0E0F, 0x0007FFFF,
                                                      0x000000FF, 0x0700007F};
  return std::all_of(kPins.begin(), kPins.end(), [&](const Pin& pin) {
    return pin.number < 32 &&
           ((kExisting[static_cast<std::size_t>(pin.port)] >> pin.number) & 1U) != 0;
  });
}

/// @brief Tells whether no pin and no signal is used twice.
consteval bool noneTwice() {
  for (const PinRow& a : kPinTable) {
    for (const PinRow& b : kPinTable) {
      if (&a != &b &&
          ((a.pin.port == b.pin.port && a.pin.number == b.pin.number) || a.signal == b.signal)) {
        return false;
      }
    }
  }
  return true;
}

/// @brief Tells whether each signal of a peripheral is on a pin that can have it.
consteval bool allMuxed() {
  struct Function {
    Port port;
    std::uint8_t number;
    Mux mux;
    std::string_view signal;
  };
  constexpr auto kFunctions = std::to_array<Function>({
      {Port::A, 18, Mux::Alt0, "EXTAL0"},
      {Port::B, 16, Mux::Alt3, "UART0_RX"},
      {Port::B, 17, Mux::Alt3, "UART0_TX"},
  });
  return std::all_of(kPinTable.begin(), kPinTable.end(), [&](const PinRow& row) {
    const Pin& pin = row.pin;
    if (pin.role != Role::Peripheral) {
      return pin.mux == Mux::Gpio;
    }
    return std::any_of(kFunctions.begin(), kFunctions.end(), [&](const Function& function) {
      return function.port == pin.port && function.number == pin.number &&
             function.mux == pin.mux && function.signal == row.signal;
    });
  });
}

/// @brief Tells whether the pins of the debugger, PTA0 and PTA3, are left alone.
consteval bool debuggerIsFree() {
  return std::none_of(kPins.begin(), kPins.end(), [](const Pin& pin) {
    return pin.port == Port::A && (pin.number == 0 || pin.number == 3);
  });
}

static_assert(allExist(), "a pin is used that the part does not have");
static_assert(noneTwice(), "a pin or a signal is used twice");
static_assert(allMuxed(), "a pin is connected to something that it cannot have");
static_assert(debuggerIsFree(), "a pin of the debugger is used");

}  // namespace pin_rules

}  // namespace wr
