// Programs that use pulse-width modulation, the converter and the edges of pins.

#include "guest.hpp"

PROGRAM pulses() {
  stopWatchdog();
  startPulses(250);
  sleepForever();
}

PROGRAM pulsesWithLowTruth() {
  stopWatchdog();
  startPulses(250);
  wordAt(0x4003800C) = 0x24;
  sleepForever();
}

PROGRAM pulsesWithoutEnd() {
  stopWatchdog();
  startPulses(1000);
  sleepForever();
}

PROGRAM changesWidthInThePeriod() {
  stopWatchdog();
  startPulses(250);
  wordAt(0x40038010) = 500;
  reported(0) = wordAt(0x40038010);
  while (wordAt(0x40038010) == 250) {
  }
  reported(1) = wordAt(0x40038010);
  sleepForever();
}

PROGRAM changesPeriodWithWidth() {
  stopWatchdog();
  startPulses(250);
  wordAt(0x40038008) = 499;
  wordAt(0x40038010) = 100;
  reported(0) = wordAt(0x40038008);
  while (wordAt(0x40038008) == 999) {
  }
  reported(1) = wordAt(0x40038010);
  sleepForever();
}

PROGRAM stopsPulses() {
  stopWatchdog();
  startPulses(250);
  wordAt(0x40038000) = 0;
  reported(0) = wordAt(0x40038004);
  reported(1) = wordAt(0x40038004);
  sleepForever();
}

PROGRAM takesPinFromTimer() {
  stopWatchdog();
  startPulses(250);
  wordAt(0x4004B004) = 0x100;
  sleepForever();
}

PROGRAM countsPeriods() {
  stopWatchdog();
  openTimer();
  wordAt(0x40038084) = 0xC0;
  wordAt(0x40038058) = 0;
  wordAt(0x40038008) = 99;
  wordAt(0x40038000) = 0x0A;
  reported(0) = wordAt(0x40038000);
  while ((wordAt(0x40038000) & 0x80) == 0) {
  }
  reported(1) = wordAt(0x40038004);
  wordAt(0x40038000) = 0x0A;
  reported(2) = wordAt(0x40038000);
  while ((wordAt(0x40038000) & 0x80) == 0) {
  }
  reported(3) = wordAt(0x40038004);
  for (int i = 0; i < 100; ++i) {
    asm volatile("nop");
  }
  reported(4) = wordAt(0x40038004);
  wordAt(0x40038004) = 1;
  reported(5) = wordAt(0x40038004);
  reported(6) = wordAt(0x40038084);
  sleepForever();
}

PROGRAM unprotectsTimer() {
  stopWatchdog();
  openTimer();
  wordAt(0x40038074) = 0x40;
  reported(0) = wordAt(0x40038054);
  wordAt(0x40038054) = 0x04;
  reported(1) = wordAt(0x40038074);
  wordAt(0x40038054) = 0x04;
  reported(2) = wordAt(0x40038054);
  wordAt(0x4003800C) = 0x28;
  reported(3) = wordAt(0x4003800C);
  sleepForever();
}

PROGRAM convertsInputs() {
  stopWatchdog();
  openConverter();
  reported(0) = calibrateConverter() ? 1 : 2;
  reported(1) = convert(12);
  reported(2) = convert(29);
  reported(3) = convert(30);
  wordAt(0x4003B008) = 0x60;
  reported(4) = convert(12);
  wordAt(0x4003B008) = 0x68;
  reported(5) = convert(12);
  wordAt(0x4003B008) = 0x6C;
  reported(6) = convert(12);
  wordAt(0x4003B00C) = 0x10;
  reported(7) = convert(4);
  sleepForever();
}

PROGRAM notesConversion() {
  reported(1) = wordAt(0x4003B010);
  reported(2) = wordAt(0x4003B000);
  reported(3) = reported(3) + 1;
}

static void convertOnceWith(std::uint32_t configuration1, std::uint32_t configuration2,
                            std::uint32_t averaging) {
  stopWatchdog();
  openConverter();
  reported(0) = calibrateConverter() ? 1 : 2;
  reported(3) = 0;
  wordAt(0x4003B008) = configuration1;
  wordAt(0x4003B00C) = configuration2;
  wordAt(0x4003B024) = averaging;
  enableInterrupt(39);
  enableInterrupt(40);
  pend(40);
  wordAt(0x4003B000) = 0x40 | 12;
  reported(4) = wordAt(0x4003B020);
  sleepForever();
}

PROGRAM convertsOnce() {
  convertOnceWith(0x64, 0, 0);
}

PROGRAM convertsWithLongSample() {
  convertOnceWith(0x74, 0x04, 0);
}

PROGRAM convertsFourTimes() {
  convertOnceWith(0x64, 0, 0x04);
}

PROGRAM convertsAnew() {
  stopWatchdog();
  openConverter();
  calibrateConverter();
  reported(3) = 0;
  enableInterrupt(39);
  wordAt(0x4003B000) = 0x40 | 13;
  wordAt(0x4003B000) = 0x40 | 12;
  sleepForever();
}

PROGRAM echoesByteOfSecondUart() {
  reported(0) = byteAt(0x400EA004);
  byteAt(0x400EA007) = static_cast<std::uint8_t>(byteAt(0x400EA007) + 1);
}

PROGRAM echoesAtSecondUart() {
  stopWatchdog();
  openSecondUart();
  byteAt(0x400EA010) = 0x88;
  reported(1) = byteAt(0x400EA010);
  byteAt(0x400EA003) = 0x2C;
  enableInterrupt(66);
  sleepForever();
}

PROGRAM notesEdge() {
  note(wordAt(0x4004C0A0) | wordAt(0x400FF0D0) << 16);
  wordAt(0x4004C0A0) = wordAt(0x4004C0A0);
}

// The pin PTD0 causes an interrupt at both edges, PTD1 at rising edges, and PTD2 at falling edges.
// PTD3 is configured for both edges, but has no digital function.
PROGRAM watchesEdges() {
  stopWatchdog();
  openPorts();
  forgetNotes();
  wordAt(0x4004C000) = 0x000B0100;
  wordAt(0x4004C004) = 0x00090100;
  wordAt(0x4004C008) = 0x000A0100;
  wordAt(0x4004C00C) = 0x000B0000;
  enableInterrupt(62);
  sleepForever();
}

PROGRAM watchesLevel() {
  stopWatchdog();
  openPorts();
  forgetNotes();
  wordAt(0x4004C000) = 0x00080103;
  enableInterrupt(62);
  sleepForever();
}

// A timer of 1 kHz starts one conversion at each of two converters. The interrupt of a conversion
// starts the next conversion of the same converter, until ADC0 has ended two conversions and ADC1
// has ended three. In each millisecond, the test changes the level of one pin of each wheel.
static void workFor(std::uint32_t turns) {
  for (std::uint32_t i = 0; i < turns; ++i) {
    reported(11) = i;
    asm volatile("nop\n\tnop\n\tnop");
  }
}

PROGRAM startsConversions() {
  wordAt(0x4003710C) = 1;
  reported(0) = reported(0) + 1;
  wordAt(0x4003B000) = 0x40 | 12;
  wordAt(0x400BB000) = 0x40 | 14;
  wordAt(0x40038010) = reported(0) % 1000;
  workFor(100);
}

PROGRAM takesConversion0() {
  reported(1) = reported(1) + 1;
  reported(8) = reported(8) + wordAt(0x4003B010);
  reported(3) = reported(3) + 1;
  if (reported(3) % 2 != 0) {
    wordAt(0x4003B000) = 0x40 | 13;
  }
  workFor(20);
}

PROGRAM takesConversion1() {
  reported(1) = reported(1) + 1;
  reported(9) = reported(9) + wordAt(0x400BB010);
  reported(4) = reported(4) + 1;
  if (reported(4) % 3 != 0) {
    wordAt(0x400BB000) = 0x40 | (reported(4) % 3 == 1 ? 15 : 6);
  }
  workFor(20);
}

PROGRAM countsEdges() {
  wordAt(0x4004C0A0) = wordAt(0x4004C0A0);
  reported(2) = reported(2) + 1;
  reported(10) = reported(10) + wordAt(0x400FF0D0);
  workFor(20);
}

static void calibrate(std::uint32_t base) {
  wordAt(base + 0x24) = 0x87;
  while ((wordAt(base + 0x24) & 0x80) != 0) {
  }
  wordAt(base + 0x2C) = 0x8202;
  wordAt(base + 0x30) = 0x8201;
  wordAt(base + 0x24) = 0;
}

PROGRAM drivesFourWheels() {
  stopWatchdog();
  switchFpuOn();
  startPulses(250);
  openConverter();
  wordAt(0x40048030) |= 1U << 27;
  wordAt(0x400BB008) = 0x64;
  wordAt(0x400BB00C) = 0x10;
  calibrate(0x4003B000);
  calibrate(0x400BB000);
  for (std::uint32_t pin = 0; pin < 8; ++pin) {
    wordAt(0x4004C000 + 4 * pin) = 0x000B0100;
  }
  for (std::uint32_t i = 0; i < 12; ++i) {
    reported(i) = 0;
  }
  openPit();
  wordAt(0x40037100) = 20971;
  wordAt(0x40037108) = 3;
  enableInterrupt(48);
  enableInterrupt(39);
  enableInterrupt(73);
  enableInterrupt(62);
  sleepForever();
}
