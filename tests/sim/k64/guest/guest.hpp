// What the programs share. They name registers by their addresses, so that they share no mistake
// with the drivers or with the models of the registers.

#pragma once

#include <cstdint>

inline volatile std::uint8_t& byteAt(std::uint32_t address) {
  return *reinterpret_cast<volatile std::uint8_t*>(address);
}

inline volatile std::uint16_t& halfAt(std::uint32_t address) {
  return *reinterpret_cast<volatile std::uint16_t*>(address);
}

inline volatile std::uint32_t& wordAt(std::uint32_t address) {
  return *reinterpret_cast<volatile std::uint32_t*>(address);
}

/// What a program tells its test.
inline volatile std::uint32_t& told(std::uint32_t number) {
  return wordAt(0x20000000 + 4 * number);
}

/// Notes a number behind those noted before; their count stands first.
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

/// Opens the gates of ports A to E.
inline void openPorts() {
  wordAt(0x40048038) |= 0x3E00;
}

/// Opens the gate of the PIT and lets its timers run.
inline void openPit() {
  wordAt(0x4004803C) |= 1U << 23;
  [[maybe_unused]] const std::uint32_t control = wordAt(0x40037000);
  wordAt(0x40037000) = 0;
}

/// Sets UART0 to 115200 baud from a core clock of 20.97 MHz, on PTB16 and PTB17.
inline void openUart() {
  openPorts();
  wordAt(0x40048034) |= 1U << 10;
  wordAt(0x4004A040) = 0x300;
  wordAt(0x4004A044) = 0x300;
  byteAt(0x4006A000) = 0;
  byteAt(0x4006A001) = 11;
  byteAt(0x4006A00A) = 12;
}

#define PROGRAM extern "C" [[gnu::used]] void
