// Functions that all guest programs use. These functions access registers directly by address,
// without the drivers. Therefore they do not repeat a mistake of the drivers or of the register
// models.

#pragma once

#include <cstdint>
#include <initializer_list>

inline volatile std::uint8_t& byteAt(std::uint32_t address) {
  return *reinterpret_cast<volatile std::uint8_t*>(address);
}

inline volatile std::uint16_t& halfAt(std::uint32_t address) {
  return *reinterpret_cast<volatile std::uint16_t*>(address);
}

inline volatile std::uint32_t& wordAt(std::uint32_t address) {
  return *reinterpret_cast<volatile std::uint32_t*>(address);
}

/// Results that a program reports to its test.
inline volatile std::uint32_t& reported(std::uint32_t number) {
  return wordAt(0x20000000 + 4 * number);
}

/// Appends a number to the recorded numbers. The word before these numbers is their count.
inline void note(std::uint32_t number) {
  const std::uint32_t count = wordAt(0x20000100);
  wordAt(0x20000104 + 4 * count) = number;
  wordAt(0x20000100) = count + 1;
}

inline void forgetNotes() {
  wordAt(0x20000100) = 0;
}

inline void unlockWatchdog() {
  halfAt(0x4005200E) = 0xC520;
  halfAt(0x4005200E) = 0xD928;
  asm volatile("nop\n\tnop\n\tnop");
}

inline void stopWatchdog() {
  unlockWatchdog();
  halfAt(0x40052000) = 0x01D2;
}

inline void enableInterrupt(std::uint32_t line) {
  wordAt(0xE000E100 + 4 * (line / 32)) = 1U << line % 32;
}

inline void setPriority(std::uint32_t line, std::uint8_t priority) {
  byteAt(0xE000E400 + line) = static_cast<std::uint8_t>(priority << 4);
}

inline void pend(std::uint32_t line) {
  wordAt(0xE000E200 + 4 * (line / 32)) = 1U << line % 32;
}

inline void switchFpuOn() {
  wordAt(0xE000ED88) = 0x00F00000;
  asm volatile("dsb\n\tisb");
}

[[noreturn]] inline void sleepForever() {
  while (true) {
    asm volatile("wfi");
  }
}

/// Opens the clock gates of ports A to E.
inline void openPorts() {
  wordAt(0x40048038) |= 0x3E00;
}

/// Opens the clock gate of the PIT and starts its timers.
inline void openPit() {
  wordAt(0x4004803C) |= 1U << 23;
  [[maybe_unused]] const std::uint32_t control = wordAt(0x40037000);
  wordAt(0x40037000) = 0;
}

/// Sets UART0 to 115200 baud at a core clock of 20.97 MHz, and connects it to PTB16 and PTB17.
inline void openUart() {
  openPorts();
  wordAt(0x40048034) |= 1U << 10;
  wordAt(0x4004A040) = 0x300;
  wordAt(0x4004A044) = 0x300;
  byteAt(0x4006A000) = 0;
  byteAt(0x4006A001) = 11;
  byteAt(0x4006A00A) = 12;
}

/// Opens the clock gate of FTM0 and connects its channel 0 to PTC1.
inline void openTimer() {
  openPorts();
  wordAt(0x4004803C) |= 1U << 24;
  wordAt(0x4004B004) = 0x400;
}

/// Starts pulses at channel 0 of FTM0. The channel is high for `width` of the 1000 bus clock cycles
/// of each period.
inline void startPulses(std::uint32_t width) {
  openTimer();
  wordAt(0x40038008) = 999;
  wordAt(0x4003800C) = 0x28;
  wordAt(0x40038010) = width;
  wordAt(0x40038000) = 0x08;
}

/// Opens the clock gate of ADC0. Sets ADC0 to 12 bits and to an eighth of the bus clock of 20.97
/// MHz.
inline void openConverter() {
  openPorts();
  wordAt(0x4004803C) |= 1U << 27;
  wordAt(0x4003B008) = 0x64;
}

/// Calibrates ADC0 and sets its gains from the results.
/// @return true if the calibration succeeded
inline bool calibrateConverter() {
  wordAt(0x4003B024) = 0x87;
  while ((wordAt(0x4003B024) & 0x80) != 0) {
  }
  for (const std::uint32_t side : {0U, 1U}) {
    std::uint32_t sum = 0;
    for (std::uint32_t i = 0; i < 6; ++i) {
      sum += wordAt(0x4003B038 + 0x20 * side + 4 * i);
    }
    wordAt(0x4003B02C + 4 * side) = sum / 2 | 0x8000;
  }
  const bool good = (wordAt(0x4003B024) & 0x40) == 0;
  wordAt(0x4003B024) = 0x40;
  return good;
}

/// Converts the voltage of a channel of ADC0, and returns the result.
inline std::uint32_t convert(std::uint32_t channel) {
  wordAt(0x4003B000) = channel;
  while ((wordAt(0x4003B000) & 0x80) == 0) {
  }
  return wordAt(0x4003B010);
}

/// Sets UART4 to 115200 baud at a bus clock of 20.97 MHz, and connects it to PTC14 and PTC15.
inline void openSecondUart() {
  openPorts();
  wordAt(0x40048028) |= 1U << 10;
  wordAt(0x4004B038) = 0x300;
  wordAt(0x4004B03C) = 0x300;
  byteAt(0x400EA000) = 0;
  byteAt(0x400EA001) = 11;
  byteAt(0x400EA00A) = 12;
}

#define PROGRAM extern "C" [[gnu::used]] void
