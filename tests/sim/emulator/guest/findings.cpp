// Programs with mistakes that would be faults on a real board.

#include "guest.hpp"

PROGRAM emptyProgram() {
  stopWatchdog();
  sleepForever();
}

PROGRAM usesPortBehindClosedGate() {
  stopWatchdog();
  wordAt(0x40049000) = 0x100;
  sleepForever();
}

PROGRAM usesDac() {
  stopWatchdog();
  wordAt(0x4004802C) |= 1U << 12;
  byteAt(0x400CC000) = 0;
  sleepForever();
}

PROGRAM loadsWhereNothingIs() {
  stopWatchdog();
  reported(0) = wordAt(0x30000000);
  sleepForever();
}

PROGRAM loadsAcrossTheBorderOfTheMemories() {
  stopWatchdog();
  reported(0) = wordAt(0x1FFFFFFE);
  sleepForever();
}

PROGRAM storesAcrossTheBorderOfTheMemories() {
  stopWatchdog();
  halfAt(0x1FFFFFFF) = 1;
  sleepForever();
}

PROGRAM usesMemoryUpToTheBorder() {
  stopWatchdog();
  wordAt(0x1FFFFFFC) = 0x12345678;
  halfAt(0x1FFFFFFA) = 0xABCD;
  reported(0) = wordAt(0x1FFFFFFC);
  reported(1) = wordAt(0x1FFFFFF9);
  reported(2) = byteAt(0x1FFFFFFF);
  sleepForever();
}

PROGRAM storesToFlash() {
  stopWatchdog();
  wordAt(0x00001000) = 1;
  sleepForever();
}

PROGRAM configuresNoWatchdog() {
  sleepForever();
}

PROGRAM unlocksTooLate() {
  for (int i = 0; i < 300; ++i) {
    asm volatile("nop");
  }
  stopWatchdog();
  sleepForever();
}

PROGRAM givesSecondKeyTooLate() {
  halfAt(0x4005200E) = 0xC520;
  for (int i = 0; i < 10; ++i) {
    asm volatile("nop");
  }
  halfAt(0x4005200E) = 0xD928;
  sleepForever();
}

PROGRAM givesWrongKey() {
  halfAt(0x4005200E) = 0xC521;
  sleepForever();
}

PROGRAM configuresInTheNextClock() {
  wordAt(0x40048044) = 0x03330000;  // a cycle of the bus clock takes four cycles of the core clock
  asm volatile(
      "ldr r0, =0x40052000\n\t"
      "ldr r1, =0xC520\n\t"
      "ldr r2, =0xD928\n\t"
      "ldr r3, =0x01D2\n\t"
      "strh r1, [r0, #14]\n\t"
      "strh r2, [r0, #14]\n\t"
      "strh r3, [r0, #0]\n\t"
      ".ltorg" ::
          : "r0", "r1", "r2", "r3");
  sleepForever();
}

PROGRAM unlocksWithoutConfiguration() {
  unlockWatchdog();
  sleepForever();
}

// Configures the watchdog. It uses the low-power oscillator, its time-out is 300 ms, and the
// configuration cannot be changed again.
static void watchFor300Milliseconds(std::uint16_t control) {
  unlockWatchdog();
  halfAt(0x40052004) = 0;
  halfAt(0x40052006) = 300;
  halfAt(0x40052008) = 0;
  halfAt(0x4005200A) = 100;
  halfAt(0x40052016) = 0;
  halfAt(0x40052000) = control;
}

static void refreshWatchdog() {
  halfAt(0x4005200C) = 0xA602;
  halfAt(0x4005200C) = 0xB480;
}

PROGRAM refreshesNever() {
  watchFor300Milliseconds(0x00C1);
  sleepForever();
}

PROGRAM refreshesAtEachTimer() {
  refreshWatchdog();
  wordAt(0x4003710C) = 1;
}

PROGRAM refreshesInTime() {
  watchFor300Milliseconds(0x00C1);
  openPit();
  wordAt(0x40037100) = 20971520 / 5;
  wordAt(0x40037108) = 3;
  enableInterrupt(48);
  sleepForever();
}

PROGRAM refreshesBeforeTheWindow() {
  watchFor300Milliseconds(0x00C9);
  openPit();
  wordAt(0x40037100) = 20971520 / 20;
  wordAt(0x40037108) = 3;
  enableInterrupt(48);
  sleepForever();
}

PROGRAM refreshesWithWrongKey() {
  watchFor300Milliseconds(0x00C1);
  for (int i = 0; i < 600; ++i) {
    asm volatile("nop");
  }
  halfAt(0x4005200C) = 0xB480;
  sleepForever();
}

PROGRAM configuresLockedWatchdog() {
  watchFor300Milliseconds(0x00C1);
  for (int i = 0; i < 600; ++i) {
    asm volatile("nop");
  }
  halfAt(0x40052006) = 1000;
  sleepForever();
}

PROGRAM readsNoByte() {
  stopWatchdog();
  openUart();
  byteAt(0x4006A003) = 0x04;
  sleepForever();
}

PROGRAM sendsAtWrongBaud() {
  stopWatchdog();
  openUart();
  byteAt(0x4006A001) = 22;
  byteAt(0x4006A003) = 0x08;
  byteAt(0x4006A007) = 'a';
  sleepForever();
}

PROGRAM receivesAtWrongBaud() {
  stopWatchdog();
  openUart();
  byteAt(0x4006A001) = 22;
  byteAt(0x4006A003) = 0x04;
  sleepForever();
}

PROGRAM sendsWithoutPin() {
  stopWatchdog();
  openUart();
  wordAt(0x4004A044) = 0x100;
  byteAt(0x4006A003) = 0x08;
  byteAt(0x4006A007) = 'a';
  sleepForever();
}

PROGRAM executesUndefinedInstruction() {
  stopWatchdog();
  asm volatile("udf #0");
  sleepForever();
}

PROGRAM usesFpuThatIsOff() {
  stopWatchdog();
  asm volatile("vmov s0, r0\n\tvadd.f32 s0, s0, s0" ::: "s0");
  sleepForever();
}

PROGRAM handlerThatAcknowledgesNothing() {}

PROGRAM startsTimer() {
  stopWatchdog();
  openPit();
  wordAt(0x40037100) = 999;
  wordAt(0x40037108) = 3;
  enableInterrupt(48);
  sleepForever();
}

PROGRAM requestsReset() {
  stopWatchdog();
  wordAt(0xE000ED0C) = 0x05FA0004;
  sleepForever();
}

PROGRAM writesWordToUart() {
  stopWatchdog();
  openUart();
  wordAt(0x4006A000) = 0;
  sleepForever();
}

PROGRAM startsTimerWithoutReadingItsControl() {
  stopWatchdog();
  wordAt(0x4004803C) |= 1U << 23;
  wordAt(0x40037000) = 0;
  sleepForever();
}

PROGRAM handlerThatFaults() {
  reported(0) = wordAt(0x30000000);
}

PROGRAM sleepsDeeply() {
  stopWatchdog();
  wordAt(0xE000ED10) = 4;
  sleepForever();
}

PROGRAM usesTimerBehindClosedGate() {
  stopWatchdog();
  wordAt(0x400B9008) = 999;
  sleepForever();
}

PROGRAM startsProtectedTimer() {
  stopWatchdog();
  openTimer();
  wordAt(0x40038074) = 0x40;
  wordAt(0x40038000) = 0x08;
  sleepForever();
}

PROGRAM changesProtectedChannel() {
  stopWatchdog();
  openTimer();
  wordAt(0x40038074) = 0x40;
  wordAt(0x4003800C) = 0x28;
  sleepForever();
}

PROGRAM pulsesLongerThanThePeriod() {
  stopWatchdog();
  startPulses(1001);
  sleepForever();
}

PROGRAM closesGateOfRunningTimer() {
  stopWatchdog();
  startPulses(250);
  wordAt(0x4004803C) &= ~(1U << 24);
  sleepForever();
}

PROGRAM capturesEdges() {
  stopWatchdog();
  openTimer();
  wordAt(0x4003800C) = 0x04;
  sleepForever();
}

PROGRAM usesAllOfTimer() {
  stopWatchdog();
  openTimer();
  wordAt(0x40038054) = 0x05;
  sleepForever();
}

PROGRAM centersPulses() {
  stopWatchdog();
  openTimer();
  wordAt(0x40038000) = 0x28;
  sleepForever();
}

PROGRAM countsAnotherClock() {
  stopWatchdog();
  openTimer();
  wordAt(0x40038000) = 0x10;
  sleepForever();
}

PROGRAM combinesChannels() {
  stopWatchdog();
  openTimer();
  wordAt(0x40038064) = 1;
  sleepForever();
}

PROGRAM usesThirdChannelOfSmallTimer() {
  stopWatchdog();
  wordAt(0x4004803C) |= 1U << 25;
  wordAt(0x4003901C) = 0x28;
  sleepForever();
}

PROGRAM writesByteToTimer() {
  stopWatchdog();
  openTimer();
  byteAt(0x40038000) = 0;
  sleepForever();
}

PROGRAM convertsTooFast() {
  stopWatchdog();
  openConverter();
  calibrateConverter();
  wordAt(0x4003B008) = 0x04;
  convert(12);
  sleepForever();
}

PROGRAM convertsSixteenBitsTooFast() {
  stopWatchdog();
  openConverter();
  calibrateConverter();
  wordAt(0x4003B008) = 0x0C;
  convert(12);
  sleepForever();
}

PROGRAM calibratesTooFast() {
  stopWatchdog();
  openConverter();
  wordAt(0x4003B008) = 0x44;
  calibrateConverter();
  sleepForever();
}

PROGRAM convertsWithoutCalibration() {
  stopWatchdog();
  openConverter();
  convert(12);
  sleepForever();
}

PROGRAM forgetsGain() {
  stopWatchdog();
  openConverter();
  calibrateConverter();
  wordAt(0x4003B030) = 0x8200;
  convert(12);
  sleepForever();
}

PROGRAM convertsDigitalPin() {
  stopWatchdog();
  openConverter();
  calibrateConverter();
  wordAt(0x4004A008) = 0x100;
  convert(12);
  sleepForever();
}

PROGRAM convertsChannelWithoutPin() {
  stopWatchdog();
  openConverter();
  calibrateConverter();
  convert(3);
  sleepForever();
}

PROGRAM convertsTemperature() {
  stopWatchdog();
  openConverter();
  calibrateConverter();
  convert(26);
  sleepForever();
}

PROGRAM convertsInputA() {
  stopWatchdog();
  openConverter();
  calibrateConverter();
  convert(4);
  sleepForever();
}

PROGRAM convertsDifference() {
  stopWatchdog();
  openConverter();
  calibrateConverter();
  convert(0x20);
  sleepForever();
}

PROGRAM configuresConverterThatConverts() {
  stopWatchdog();
  openConverter();
  calibrateConverter();
  wordAt(0x4003B000) = 12;
  wordAt(0x4003B00C) = 0x04;
  sleepForever();
}

PROGRAM convertsInTheCalibration() {
  stopWatchdog();
  openConverter();
  wordAt(0x4003B024) = 0x80;
  wordAt(0x4003B000) = 12;
  sleepForever();
}

PROGRAM storesToResult() {
  stopWatchdog();
  openConverter();
  wordAt(0x4003B010) = 0;
  sleepForever();
}

PROGRAM triggersConverterByHardware() {
  stopWatchdog();
  openConverter();
  wordAt(0x4003B020) = 0x40;
  sleepForever();
}

PROGRAM usesSecondControlOfConverter() {
  stopWatchdog();
  openConverter();
  wordAt(0x4003B004) = 12;
  sleepForever();
}

PROGRAM convertsForEver() {
  stopWatchdog();
  openConverter();
  wordAt(0x4003B024) = 0x08;
  sleepForever();
}

PROGRAM clocksConverterByItself() {
  stopWatchdog();
  openConverter();
  wordAt(0x4003B008) = 0x03;
  sleepForever();
}

PROGRAM clocksConverterByAlternateClock() {
  stopWatchdog();
  openConverter();
  wordAt(0x4003B008) = 0x65;
  sleepForever();
}

PROGRAM usesHoleOfConverter() {
  stopWatchdog();
  openConverter();
  reported(0) = wordAt(0x4003B050);
  sleepForever();
}

PROGRAM fillsSmallBuffer() {
  stopWatchdog();
  openSecondUart();
  byteAt(0x400EA010) = 0x80;
  byteAt(0x400EA003) = 0x08;
  for (std::uint8_t i = 0; i < 3; ++i) {
    byteAt(0x400EA007) = i;
  }
  sleepForever();
}

PROGRAM filtersPins() {
  stopWatchdog();
  openPorts();
  wordAt(0x4004A0C0) = 1;
  sleepForever();
}

PROGRAM filtersPinsByLowPowerOscillator() {
  stopWatchdog();
  openPorts();
  wordAt(0x4004C0C4) = 1;
  sleepForever();
}

PROGRAM changesFilterThatIsOn() {
  stopWatchdog();
  openPorts();
  wordAt(0x4004C0C0) = 1;
  wordAt(0x4004C0C8) = 31;
  sleepForever();
}

PROGRAM asksForDmaAtEdges() {
  stopWatchdog();
  openPorts();
  wordAt(0x4004C000) = 0x00010100;
  sleepForever();
}
