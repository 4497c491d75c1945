#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

namespace wr {

/// @brief Port of the microcontroller.
/// @datatype
enum class Port : std::uint8_t { A = 0, B = 1, C = 2, D = 3, E = 4 };

/// @brief Role of a pin.
/// @datatype
enum class Role : std::uint8_t {
  LowOutput,   ///< output, safe when low
  HighOutput,  ///< output, safe when high
  LateOutput,  ///< output, safe when low; the timer drives it
  Input,       ///< input with a pull-up resistor
  PulledUp,    ///< pin of a peripheral, with a pull-up resistor because the wire may be missing
  Peripheral   ///< pin of a peripheral
};

/// @brief Internal unit to which a pin is connected: the number of the alternative function of the
/// pin.
/// @datatype
enum class Mux : std::uint8_t { Alt0 = 0, Gpio = 1, Alt3 = 3, Alt4 = 4 };

/// @brief A pin of the microcontroller.
/// @datatype
struct Pin {
  Port port;            ///< port of the pin
  std::uint8_t number;  ///< number of the pin in the port, 0 to 31
  Mux mux;              ///< connection while the firmware runs
  Role role;            ///< role of the pin

  /// @brief Returns whether the firmware drives the pin.
  /// @return true for an output
  [[nodiscard]] constexpr bool isOutput() const {
    return role == Role::LowOutput || role == Role::HighOutput || role == Role::LateOutput;
  }
};

/// @brief A row of the pin table.
/// @datatype
struct PinRow {
  Pin pin;                  ///< the pin
  std::string_view signal;  ///< name of the signal at the pin
  std::string_view header;  ///< connector of the pin on the FRDM-K64F
  std::string_view text;    ///< task of the pin
};

// The pins that the firmware uses, one pin in each source line. The signals of the peripherals have
// the names of the manual. After reset the pin of wheel_rr_orientation is the debug output SWO. No
// debug probe of this board needs SWO. The pin of emergency_stop is also connected to the
// accelerometer, which the firmware does not use. The firmware does not use the connector pin J2-2.
// Up to revision D of the board, J2-2 is PTA0, a pin of the debugger. From revision E on, J2-2 is
// PTC12. The documents may name only the pins of the table and of these comments. These comments do
// not name a pin of the table. Otherwise, after the removal of this pin from the table, no check
// would find the documents that still name the pin.
// clang-format off
inline constexpr auto kPinTable = std::to_array<PinRow>({
    {{Port::A, 4, Mux::Gpio, Role::Input}, "button", "SW3", "The button is not used. The flash configuration disables the non-maskable interrupt of this pin."},
    {{Port::A, 18, Mux::Alt0, Role::Peripheral}, "EXTAL0", "50 MHz of the Ethernet chip", "Clock of the microcontroller."},
    {{Port::B, 16, Mux::Alt3, Role::PulledUp}, "UART0_RX", "USB debug port", "Bytes from the PC."},
    {{Port::B, 17, Mux::Alt3, Role::Peripheral}, "UART0_TX", "USB debug port", "Bytes to the PC."},
    {{Port::C, 14, Mux::Alt3, Role::PulledUp}, "UART4_RX", "J199-3", "Bytes from the Bluetooth device."},
    {{Port::C, 15, Mux::Alt3, Role::Peripheral}, "UART4_TX", "J199-4", "Bytes to the Bluetooth device."},
    {{Port::B, 22, Mux::Gpio, Role::LowOutput}, "light_red", "D12 red", "A low level switches the light on. The light shows that the start has not ended. In the product weeding_robot_warning it also shows a warning."},
    {{Port::E, 26, Mux::Gpio, Role::HighOutput}, "light_green", "D12 green", "A low level switches the light on. The light shows that the start has ended."},
    {{Port::C, 1, Mux::Alt4, Role::LateOutput}, "FTM0_CH0", "J1-5", "PWM of 20 kHz, 3.3 V: its duty cycle sets the voltage of the front left wheel."},
    {{Port::C, 2, Mux::Alt4, Role::LateOutput}, "FTM0_CH1", "J1-14", "PWM of 20 kHz, 3.3 V: its duty cycle sets the voltage of the front right wheel."},
    {{Port::C, 3, Mux::Alt4, Role::LateOutput}, "FTM0_CH2", "J1-16", "PWM of 20 kHz, 3.3 V: its duty cycle sets the voltage of the rear left wheel."},
    {{Port::C, 4, Mux::Alt4, Role::LateOutput}, "FTM0_CH3", "J2-4", "PWM of 20 kHz, 3.3 V: its duty cycle sets the voltage of the rear right wheel."},
    {{Port::C, 16, Mux::Gpio, Role::LowOutput}, "wheel_fl_orientation", "J1-2", "A high level turns the front left wheel backwards."},
    {{Port::C, 17, Mux::Gpio, Role::LowOutput}, "wheel_fr_orientation", "J1-4", "A high level turns the front right wheel backwards."},
    {{Port::B, 9, Mux::Gpio, Role::LowOutput}, "wheel_rl_orientation", "J1-6", "A high level turns the rear left wheel backwards."},
    {{Port::A, 2, Mux::Gpio, Role::LowOutput}, "wheel_rr_orientation", "J1-12", "A high level turns the rear right wheel backwards."},
    {{Port::C, 5, Mux::Gpio, Role::LowOutput}, "wheel_fl_enable", "J1-15", "A high level enables the motor driver of the front left wheel."},
    {{Port::C, 7, Mux::Gpio, Role::LowOutput}, "wheel_fr_enable", "J1-13", "A high level enables the motor driver of the front right wheel."},
    {{Port::C, 11, Mux::Gpio, Role::LowOutput}, "wheel_rl_enable", "J4-10", "A high level enables the motor driver of the rear left wheel."},
    {{Port::B, 20, Mux::Gpio, Role::LowOutput}, "wheel_rr_enable", "J4-9", "A high level enables the motor driver of the rear right wheel."},
    {{Port::C, 8, Mux::Gpio, Role::LowOutput}, "steering_step", "J1-7", "Each pulse turns the steering by one step."},
    {{Port::C, 9, Mux::Gpio, Role::LowOutput}, "steering_direction", "J1-9", "A high level turns the steering to the left."},
    {{Port::C, 0, Mux::Gpio, Role::LowOutput}, "steering_enable", "J1-11", "A high level switches the steering motor on."},
    {{Port::D, 0, Mux::Gpio, Role::Input}, "wheel_fl_hall_a", "J2-6", "First Hall sensor of the front left wheel."},
    {{Port::D, 1, Mux::Gpio, Role::Input}, "wheel_fl_hall_b", "J2-12", "Second Hall sensor of the front left wheel."},
    {{Port::D, 2, Mux::Gpio, Role::Input}, "wheel_fr_hall_a", "J2-8", "First Hall sensor of the front right wheel."},
    {{Port::D, 3, Mux::Gpio, Role::Input}, "wheel_fr_hall_b", "J2-10", "Second Hall sensor of the front right wheel."},
    {{Port::D, 4, Mux::Gpio, Role::Input}, "wheel_rl_hall_a", "J6-4", "First Hall sensor of the rear left wheel."},
    {{Port::D, 5, Mux::Gpio, Role::Input}, "wheel_rl_hall_b", "J6-5", "Second Hall sensor of the rear left wheel."},
    {{Port::D, 6, Mux::Gpio, Role::Input}, "wheel_rr_hall_a", "J6-6", "First Hall sensor of the rear right wheel."},
    {{Port::D, 7, Mux::Gpio, Role::Input}, "wheel_rr_hall_b", "J6-7", "Second Hall sensor of the rear right wheel."},
    {{Port::B, 2, Mux::Alt0, Role::Peripheral}, "ADC0_SE12", "J4-2", "Current of the front left wheel."},
    {{Port::B, 3, Mux::Alt0, Role::Peripheral}, "ADC0_SE13", "J4-4", "Current of the front right wheel."},
    {{Port::B, 10, Mux::Alt0, Role::Peripheral}, "ADC1_SE14", "J4-6", "Current of the rear left wheel."},
    {{Port::B, 11, Mux::Alt0, Role::Peripheral}, "ADC1_SE15", "J4-8", "Current of the rear right wheel."},
    {{Port::C, 10, Mux::Alt0, Role::Peripheral}, "ADC1_SE6b", "J4-12", "Angle of the steering."},
    {{Port::A, 1, Mux::Gpio, Role::Input}, "steering_left_end", "J1-8", "Low while the left end stop is not reached. High when it is reached or a wire is broken."},
    {{Port::C, 18, Mux::Gpio, Role::Input}, "steering_right_end", "J6-8", "Low while the right end stop is not reached. High when it is reached or a wire is broken."},
    {{Port::B, 18, Mux::Gpio, Role::Input}, "rc_velocity", "J1-1", "Pulses of the remote control: velocity."},
    {{Port::B, 19, Mux::Gpio, Role::Input}, "rc_direction", "J1-3", "Pulses of the remote control: direction."},
    {{Port::B, 23, Mux::Gpio, Role::Input}, "rc_enable", "J1-10", "Pulses of the remote control: enable switch."},
    {{Port::E, 25, Mux::Gpio, Role::Input}, "emergency_stop", "J2-18", "Low while the emergency stop is released. High when it is pressed or a wire is broken."},
});
// clang-format on

/// @brief The pins of the table without the texts. Thus the texts need no space in flash.
inline constexpr auto kPins = [] {
  std::array<Pin, kPinTable.size()> pins{};
  std::ranges::transform(kPinTable, pins.begin(), [](const PinRow& row) { return row.pin; });
  return pins;
}();

/// @brief Returns the pin of a signal. If no pin has this signal, the compiler reports an error.
/// @param signal name of the signal
/// @return pin of the signal
consteval Pin pinOf(std::string_view signal) {
  return std::ranges::find(kPinTable, signal, &PinRow::signal)->pin;
}

namespace pin_rules {

/// @brief Returns whether all pins of the table exist in the 100-pin package of the
/// microcontroller.
consteval bool allExist() {
  constexpr std::array<std::uint32_t, 5> kExistingPins = {0x000FF03F, 0x00FF0E0F, 0x0007FFFF,
                                                          0x000000FF, 0x0700007F};
  return std::ranges::all_of(kPins, [&](const Pin& pin) {
    return pin.number < 32 &&
           ((kExistingPins[static_cast<std::size_t>(pin.port)] >> pin.number) & 1U) != 0;
  });
}

/// @brief Returns whether each pin and each signal is used only once.
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

/// @brief Returns whether each signal of a peripheral is on a pin that supports this signal.
consteval bool allMuxed() {
  struct Function {
    Port port;
    std::uint8_t number;
    Mux mux;
    std::string_view signal;
  };
  constexpr auto kFunctions = std::to_array<Function>({
      {Port::A, 18, Mux::Alt0, "EXTAL0"},
      {Port::B, 2, Mux::Alt0, "ADC0_SE12"},
      {Port::B, 3, Mux::Alt0, "ADC0_SE13"},
      {Port::B, 10, Mux::Alt0, "ADC1_SE14"},
      {Port::B, 11, Mux::Alt0, "ADC1_SE15"},
      {Port::B, 16, Mux::Alt3, "UART0_RX"},
      {Port::B, 17, Mux::Alt3, "UART0_TX"},
      {Port::C, 1, Mux::Alt4, "FTM0_CH0"},
      {Port::C, 2, Mux::Alt4, "FTM0_CH1"},
      {Port::C, 3, Mux::Alt4, "FTM0_CH2"},
      {Port::C, 4, Mux::Alt4, "FTM0_CH3"},
      {Port::C, 10, Mux::Alt0, "ADC1_SE6b"},
      {Port::C, 14, Mux::Alt3, "UART4_RX"},
      {Port::C, 15, Mux::Alt3, "UART4_TX"},
  });
  return std::ranges::all_of(kPinTable, [&](const PinRow& row) {
    const Pin& pin = row.pin;
    if (pin.role != Role::Peripheral && pin.role != Role::PulledUp &&
        pin.role != Role::LateOutput) {
      return pin.mux == Mux::Gpio;
    }
    return std::ranges::any_of(kFunctions, [&](const Function& function) {
      return function.port == pin.port && function.number == pin.number &&
             function.mux == pin.mux && function.signal == row.signal;
    });
  });
}

/// @brief Returns whether the pins of the debugger, PTA0 and PTA3, are not used.
consteval bool debuggerIsFree() {
  return std::ranges::none_of(kPins, [](const Pin& pin) {
    return pin.port == Port::A && (pin.number == 0 || pin.number == 3);
  });
}

static_assert(allExist(), "each used pin must exist on the microcontroller");
static_assert(noneTwice(), "each pin and each signal must be used only once");
static_assert(allMuxed(), "each pin must support its connection");
static_assert(debuggerIsFree(), "the pins of the debugger must not be used");

}  // namespace pin_rules

}  // namespace wr
