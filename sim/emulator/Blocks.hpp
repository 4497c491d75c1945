#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace wr::emulator {

/// @brief A block of peripheral registers and its clock gate.
struct Block {
  std::string_view name;
  std::uint32_t base;
  unsigned gateGroup;  ///< number of the register SCGC; 0 if the block has no gate
  unsigned gateBit;
};

inline constexpr std::uint32_t kBlockSize = 0x1000;

/// @brief The blocks of the K64. See K64P144M120SF5RM, chapters Memory Map (peripheral bridge
/// memory maps) and SIM (SCGC1 to SCGC7). The second half of SIM and the GPIO ports are not in this
/// table.
inline constexpr auto kBlocks = std::to_array<Block>({
    {"DMA", 0x40008000, 7, 1},    {"DMA_TCD", 0x40009000, 7, 1}, {"FB", 0x4000C000, 7, 0},
    {"SYSMPU", 0x4000D000, 7, 2}, {"FMC", 0x4001F000, 6, 0},     {"FTFE", 0x40020000, 6, 0},
    {"DMAMUX", 0x40021000, 6, 1}, {"CAN0", 0x40024000, 6, 4},    {"RNG", 0x40029000, 6, 9},
    {"SPI0", 0x4002C000, 6, 12},  {"SPI1", 0x4002D000, 6, 13},   {"I2S0", 0x4002F000, 6, 15},
    {"CRC", 0x40032000, 6, 18},   {"USBDCD", 0x40035000, 6, 21}, {"PDB0", 0x40036000, 6, 22},
    {"PIT", 0x40037000, 6, 23},   {"FTM0", 0x40038000, 6, 24},   {"FTM1", 0x40039000, 6, 25},
    {"FTM2", 0x4003A000, 6, 26},  {"ADC0", 0x4003B000, 6, 27},   {"RTC", 0x4003D000, 6, 29},
    {"LPTMR0", 0x40040000, 5, 0}, {"SIM", 0x40047000, 0, 0},     {"PORTA", 0x40049000, 5, 9},
    {"PORTB", 0x4004A000, 5, 10}, {"PORTC", 0x4004B000, 5, 11},  {"PORTD", 0x4004C000, 5, 12},
    {"PORTE", 0x4004D000, 5, 13}, {"WDOG", 0x40052000, 0, 0},    {"EWM", 0x40061000, 4, 1},
    {"MCG", 0x40064000, 0, 0},    {"OSC", 0x40065000, 0, 0},     {"UART0", 0x4006A000, 4, 10},
    {"UART1", 0x4006B000, 4, 11}, {"UART2", 0x4006C000, 4, 12},  {"UART3", 0x4006D000, 4, 13},
    {"LLWU", 0x4007C000, 0, 0},   {"PMC", 0x4007D000, 0, 0},     {"SMC", 0x4007E000, 0, 0},
    {"RCM", 0x4007F000, 0, 0},    {"FTM3", 0x400B9000, 3, 25},   {"ADC1", 0x400BB000, 3, 27},
    {"UART4", 0x400EA000, 1, 10}, {"UART5", 0x400EB000, 1, 11},  {"DAC0", 0x400CC000, 2, 12},
    {"DAC1", 0x400CD000, 2, 13},  {"AIPS0", 0x40000000, 0, 0},   {"AXBS", 0x40004000, 0, 0},
    {"RFVBAT", 0x4003E000, 0, 0}, {"RFSYS", 0x40041000, 0, 0},   {"CMT", 0x40062000, 4, 2},
    {"I2C0", 0x40066000, 4, 6},   {"I2C1", 0x40067000, 4, 7},    {"USB0", 0x40072000, 4, 18},
    {"CMP", 0x40073000, 4, 19},   {"VREF", 0x40074000, 4, 20},   {"AIPS1", 0x40080000, 0, 0},
    {"SPI2", 0x400AC000, 3, 12},  {"SDHC", 0x400B1000, 3, 17},   {"ENET", 0x400C0000, 2, 0},
    {"I2C2", 0x400E6000, 1, 6},
});

}  // namespace wr::emulator
