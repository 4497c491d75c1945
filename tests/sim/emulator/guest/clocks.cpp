// Programs that set up the clock.

#include "guest.hpp"

static bool waitFor(std::uint8_t mask, std::uint8_t value) {
  for (int i = 0; i < 100000; ++i) {
    if ((byteAt(0x40064006) & mask) == value) {
      return true;
    }
  }
  return false;
}

static void divideFor120MHz() {
  wordAt(0x40048044) = 0x01240000;
}

static bool changeToExternalClock() {
  byteAt(0x40064001) = 0xA0;
  byteAt(0x40064000) = 0xB8;
  return waitFor(0x1C, 0x08);
}

static void setUpPll() {
  byteAt(0x40064004) = 0x13;
  byteAt(0x40064005) = 0x58;
}

PROGRAM runsAt120MHz() {
  stopWatchdog();
  divideFor120MHz();
  const bool external = changeToExternalClock();
  setUpPll();
  const bool locked = waitFor(0x60, 0x60);
  byteAt(0x40064000) = 0x38;
  const bool engaged = waitFor(0x0C, 0x0C);
  reported(0) = external && locked && engaged ? 1 : 2;
  sleepForever();
}

PROGRAM waitsForExternalClock() {
  stopWatchdog();
  divideFor120MHz();
  reported(0) = changeToExternalClock() ? 1 : 2;
  sleepForever();
}

PROGRAM waitsForNoLock() {
  stopWatchdog();
  divideFor120MHz();
  changeToExternalClock();
  setUpPll();
  waitFor(0x20, 0x20);
  byteAt(0x40064000) = 0x38;
  sleepForever();
}

PROGRAM dividesNothing() {
  stopWatchdog();
  changeToExternalClock();
  setUpPll();
  waitFor(0x60, 0x60);
  byteAt(0x40064000) = 0x38;
  waitFor(0x0C, 0x0C);
  sleepForever();
}

PROGRAM skipsMode() {
  stopWatchdog();
  byteAt(0x40064001) = 0xA0;
  byteAt(0x40064005) = 0x40;
  byteAt(0x40064000) = 0xB8;
  sleepForever();
}
