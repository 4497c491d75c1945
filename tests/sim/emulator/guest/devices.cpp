// Programs that use timers, pins and the serial port.

#include "guest.hpp"

PROGRAM acknowledgesTimer() {
  wordAt(0x4003710C) = 1;
}

PROGRAM runsTimers() {
  stopWatchdog();
  openPit();
  wordAt(0x40037120) = 0xFFFFFFFF;
  wordAt(0x40037128) = 1;
  wordAt(0x40037100) = 2097152 - 1;
  wordAt(0x40037108) = 3;
  enableInterrupt(48);
  sleepForever();
}

PROGRAM countsTimer() {
  wordAt(0x4003710C) = 1;
  reported(0) = 0xFFFFFFFF - wordAt(0x40037124);
}

PROGRAM chainsTimers() {
  stopWatchdog();
  openPit();
  wordAt(0x40037110) = 9;
  wordAt(0x40037118) = 7;
  wordAt(0x40037100) = 20971;
  wordAt(0x40037108) = 1;
  enableInterrupt(49);
  sleepForever();
}

PROGRAM acknowledgesSecondTimer() {
  wordAt(0x4003711C) = 1;
}

PROGRAM echoesByte() {
  reported(0) = byteAt(0x4006A004);
  byteAt(0x4006A007) = static_cast<std::uint8_t>(byteAt(0x4006A007) + 1);
}

PROGRAM echoes() {
  stopWatchdog();
  openUart();
  byteAt(0x4006A003) = 0x2C;
  enableInterrupt(31);
  sleepForever();
}

PROGRAM readsNoFlags() {
  stopWatchdog();
  openUart();
  byteAt(0x4006A003) = 0x04;
  while (byteAt(0x4006A016) == 0) {
  }
  reported(0) = byteAt(0x4006A007);
  reported(1) = byteAt(0x4006A004);
  reported(2) = byteAt(0x4006A007);
  reported(3) = byteAt(0x4006A004);
  sleepForever();
}

PROGRAM readsFramingError() {
  reported(0) = byteAt(0x4006A004);
  reported(1) = byteAt(0x4006A007);
  reported(2) = byteAt(0x4006A004);
}

PROGRAM receivesErrors() {
  stopWatchdog();
  openUart();
  byteAt(0x4006A006) = 0x02;
  byteAt(0x4006A003) = 0x04;
  enableInterrupt(32);
  sleepForever();
}

PROGRAM usesFifo() {
  stopWatchdog();
  openUart();
  byteAt(0x4006A010) = 0x88;
  byteAt(0x4006A003) = 0x0C;
  for (std::uint8_t i = 0; i < 8; ++i) {
    byteAt(0x4006A007) = i;
  }
  reported(0) = byteAt(0x4006A014);
  sleepForever();
}

PROGRAM drivesPin() {
  stopWatchdog();
  openPorts();
  wordAt(0x400FF054) = 1U << 22;
  wordAt(0x4004A058) = 0x100;
  wordAt(0x400FF044) = 1U << 22;
  sleepForever();
}

PROGRAM notesPin() {
  reported(0) = reported(0) + 1;
  reported(1) = wordAt(0x4004C0A0);
  reported(2) = wordAt(0x400FF0D0);
  wordAt(0x4004C0A0) = wordAt(0x4004C0A0);
}

PROGRAM watchesPin() {
  stopWatchdog();
  openPorts();
  reported(0) = 0;
  wordAt(0x4004C000) = 0x000A0103;
  enableInterrupt(62);
  sleepForever();
}

PROGRAM tellsCauseOfReset() {
  reported(0) = byteAt(0x4007F000);
  reported(1) = byteAt(0x4007F001);
  stopWatchdog();
  reported(2) = wordAt(0x20000040);
  wordAt(0x20000040) = 0xCAFE;
  sleepForever();
}

PROGRAM stopsWatchdogThenRequestsReset() {
  const bool again = byteAt(0x4007F001) == 0x04;
  stopWatchdog();
  if (!again) {
    wordAt(0xE000ED0C) = 0x05FA0004;
  }
  sleepForever();
}
