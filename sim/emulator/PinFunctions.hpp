#pragma once

#include <array>

namespace wr::emulator {

/// @brief A pin that can be connected to a channel of a peripheral.
struct PinFunction {
  char port;
  unsigned pin;
  unsigned function;  ///< field MUX of the pin's PCR
  unsigned instance;
  unsigned channel;
};

/// @brief The pins of the timer channels (K64P144M120SF5RM, Signal Multiplexing, and data sheet
/// K64P144M120SF5, pinouts).
inline constexpr std::array<PinFunction, 31> kFtmPins{{
    {'A', 3, 3, 0, 0},  {'A', 4, 3, 0, 1},  {'A', 5, 3, 0, 2},  {'A', 0, 3, 0, 5},
    {'A', 1, 3, 0, 6},  {'A', 2, 3, 0, 7},  {'C', 1, 4, 0, 0},  {'C', 2, 4, 0, 1},
    {'C', 3, 4, 0, 2},  {'C', 4, 4, 0, 3},  {'C', 5, 7, 0, 2},  {'D', 4, 4, 0, 4},
    {'D', 5, 4, 0, 5},  {'D', 6, 4, 0, 6},  {'D', 7, 4, 0, 7},  {'A', 12, 3, 1, 0},
    {'A', 13, 3, 1, 1}, {'B', 0, 3, 1, 0},  {'B', 1, 3, 1, 1},  {'B', 18, 3, 2, 0},
    {'B', 19, 3, 2, 1}, {'D', 0, 4, 3, 0},  {'D', 1, 4, 3, 1},  {'D', 2, 4, 3, 2},
    {'D', 3, 4, 3, 3},  {'E', 5, 6, 3, 0},  {'E', 6, 6, 3, 1},  {'C', 8, 3, 3, 4},
    {'C', 9, 3, 3, 5},  {'C', 10, 3, 3, 6}, {'C', 11, 3, 3, 7},
}};

/// @brief The values of PinFunction::channel in kUartPins and kCanPins.
inline constexpr unsigned kReceive = 0;
inline constexpr unsigned kSend = 1;

/// @brief The pins of UART0 and UART4, from the same tables as kFtmPins.
inline constexpr std::array<PinFunction, 12> kUartPins{{
    {'A', 1, 2, 0, kReceive},
    {'A', 2, 2, 0, kSend},
    {'A', 15, 3, 0, kReceive},
    {'A', 14, 3, 0, kSend},
    {'B', 16, 3, 0, kReceive},
    {'B', 17, 3, 0, kSend},
    {'D', 6, 3, 0, kReceive},
    {'D', 7, 3, 0, kSend},
    {'C', 14, 3, 4, kReceive},
    {'C', 15, 3, 4, kSend},
    {'E', 25, 3, 4, kReceive},
    {'E', 24, 3, 4, kSend},
}};

/// @brief The pins of CAN0, from the same tables as kFtmPins.
inline constexpr std::array<PinFunction, 4> kCanPins{{
    {'A', 12, 2, 0, kSend},
    {'A', 13, 2, 0, kReceive},
    {'B', 18, 2, 0, kSend},
    {'B', 19, 2, 0, kReceive},
}};

/// @brief The single-ended inputs of the converters, from the same tables as kFtmPins. Channels 4
/// to 7 are the inputs with the suffix b.
inline constexpr std::array<PinFunction, 21> kAdcPins{{
    {'C', 2, 0, 0, 4},   {'D', 1, 0, 0, 5},  {'D', 5, 0, 0, 6},   {'D', 6, 0, 0, 7},
    {'B', 0, 0, 0, 8},   {'B', 1, 0, 0, 9},  {'B', 2, 0, 0, 12},  {'B', 3, 0, 0, 13},
    {'C', 0, 0, 0, 14},  {'C', 1, 0, 0, 15}, {'E', 24, 0, 0, 17}, {'E', 25, 0, 0, 18},
    {'C', 8, 0, 1, 4},   {'C', 9, 0, 1, 5},  {'C', 10, 0, 1, 6},  {'C', 11, 0, 1, 7},
    {'B', 0, 0, 1, 8},   {'B', 1, 0, 1, 9},  {'B', 10, 0, 1, 14}, {'B', 11, 0, 1, 15},
    {'A', 17, 0, 1, 17},
}};

}  // namespace wr::emulator
