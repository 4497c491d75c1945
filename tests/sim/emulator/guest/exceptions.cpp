// Programs that test interrupts and faults.

#include "guest.hpp"

PROGRAM notesOne() {
  note(1);
}

PROGRAM notesTwo() {
  note(2);
}

PROGRAM notesThree() {
  note(3);
}

PROGRAM pendsTwoInside() {
  note(10);
  pend(2);
  asm volatile("dsb\n\tisb");
  note(11);
}

// The handler of interrupt line 1 triggers interrupt line 2.
static void nest(std::uint8_t priorityOfOne, std::uint8_t priorityOfTwo) {
  stopWatchdog();
  forgetNotes();
  setPriority(1, priorityOfOne);
  setPriority(2, priorityOfTwo);
  enableInterrupt(1);
  enableInterrupt(2);
  pend(1);
  asm volatile("dsb\n\tisb");
  note(20);
  sleepForever();
}

PROGRAM pendsHigherPriority() {
  nest(5, 4);
}

PROGRAM pendsEqualPriority() {
  nest(5, 5);
}

PROGRAM pendsTwoBehindMask() {
  stopWatchdog();
  forgetNotes();
  setPriority(1, 5);
  setPriority(2, 3);
  setPriority(3, 5);
  for (std::uint32_t line = 1; line <= 3; ++line) {
    enableInterrupt(line);
  }
  asm volatile("msr basepri, %0" ::"r"(0x40));
  pend(3);
  pend(1);
  pend(2);
  asm volatile("dsb\n\tisb");
  note(20);
  asm volatile("msr basepri, %0\n\tisb" ::"r"(0));
  note(21);
  asm volatile("cpsid i");
  pend(1);
  asm volatile("dsb\n\tisb");
  note(22);
  asm volatile("wfi");
  note(23);
  asm volatile("cpsie i\n\tisb");
  note(24);
  sleepForever();
}

PROGRAM spoilsFpuRegisters() {
  asm volatile(
      "vmov s0, %0\n\tvmov s15, %0\n\tvadd.f32 s1, s0, s0\n\tvmsr fpscr, %1" ::"r"(0x40400000),
      "r"(0x80000000)
      : "s0", "s1", "s15");
}

PROGRAM keepsFpuRegisters() {
  stopWatchdog();
  switchFpuOn();
  enableInterrupt(1);
  std::uint32_t first = 0;
  std::uint32_t last = 0;
  std::uint32_t status = 0;
  std::uint32_t before = 0;
  std::uint32_t after = 0;
  asm volatile(
      "vmov s0, %5\n\tvmov s15, %6\n\tvmsr fpscr, %7\n\t"
      "mov %3, sp\n\t"
      "str %9, [%8]\n\tdsb\n\tisb\n\t"
      "mov %4, sp\n\t"
      "vmov %0, s0\n\tvmov %1, s15\n\tvmrs %2, fpscr"
      : "=&r"(first), "=&r"(last), "=&r"(status), "=&r"(before), "=&r"(after)
      : "r"(0x11111111), "r"(0x22222222), "r"(0x10000000), "r"(0xE000E200), "r"(2)
      : "s0", "s15", "memory");
  reported(0) = first;
  reported(1) = last;
  reported(2) = status;
  reported(3) = before - after;
  sleepForever();
}

PROGRAM tellsFrame() {
  // Reports the values of LR and of both stack pointers in the handler of an exception.
  std::uint32_t link = 0;
  std::uint32_t stack = 0;
  std::uint32_t process = 0;
  asm volatile("mov %0, lr\n\tmov %1, sp\n\tmrs %2, psp" : "=r"(link), "=r"(stack), "=r"(process));
  reported(0) = link;
  reported(1) = stack;
  reported(2) = process;
}

PROGRAM usesProcessStack() {
  stopWatchdog();
  enableInterrupt(1);
  asm volatile(
      "msr psp, %0\n\tmsr control, %1\n\tisb\n\t"
      "str %3, [%2]\n\tdsb\n\tisb" ::"r"(0x20001000),
      "r"(2), "r"(0xE000E200), "r"(2)
      : "memory");
  std::uint32_t stack = 0;
  std::uint32_t control = 0;
  asm volatile("mov %0, sp\n\tmrs %1, control" : "=r"(stack), "=r"(control));
  reported(3) = stack;
  reported(4) = control;
  sleepForever();
}

PROGRAM tellsFault() {
  reported(0) = wordAt(0xE000ED28);  // CFSR
  reported(1) = wordAt(0xE000ED2C);  // HFSR
  reported(2) = wordAt(0xE000ED38);  // BFAR
  std::uint32_t number = 0;
  asm volatile("mrs %0, ipsr" : "=r"(number));
  reported(3) = number;
  sleepForever();
}

PROGRAM faultsWithHandlerOn() {
  stopWatchdog();
  wordAt(0xE000ED24) = 7U << 16;
  reported(4) = wordAt(0x30000000);
  sleepForever();
}

PROGRAM faultsWithHandlerOff() {
  stopWatchdog();
  reported(4) = wordAt(0x30000000);
  sleepForever();
}

PROGRAM countsUp() {
  stopWatchdog();
  reported(0) = 0;
  while (true) {
    reported(0) = reported(0) + 1;
  }
}

PROGRAM measures100Instructions() {
  stopWatchdog();
  wordAt(0xE000EDFC) = 1U << 24;
  wordAt(0xE0001004) = 0;
  wordAt(0xE0001000) = 1;
  const std::uint32_t from = wordAt(0xE0001004);
  asm volatile(".rept 100\n\tnop\n\t.endr");
  reported(0) = wordAt(0xE0001004) - from;
  sleepForever();
}

PROGRAM countsTicks() {
  reported(0) = reported(0) + 1;
}

// The time until the interrupt varies. In the course of the run, the interrupt therefore occurs at
// different instructions of a loop.
PROGRAM countsTicksBetweenConditions() {
  reported(2) = reported(2) + 1;
  wordAt(0xE000E014) = 80 + reported(2) % 29;
  asm volatile("cmp %0, %0" ::"r"(0) : "cc");
}

// An IT block across a border of 1 KB, at which the emulator ends a block of code. The interrupts
// occur at different instructions of the IT block.
PROGRAM runsConditionalBlocks() {
  stopWatchdog();
  reported(2) = 0;
  reported(3) = 1;
  reported(4) = 100'000;
  wordAt(0xE000E014) = 97 - 1;
  wordAt(0xE000E018) = 0;
  wordAt(0xE000E010) = 7;
  std::uint32_t sum = 0;
  for (std::uint32_t i = 0; i < 10'000; ++i) {
    std::uint32_t loaded = 0;
    asm volatile(
        "b.w 1f\n\t.p2align 10\n\t.space 1016\n1:\ttst %1, #1\n\tite eq\n\t"
        "ldreq %0, [%2, #0]\n\tldrne %0, [%2, #4]"
        : "=&l"(loaded)
        : "l"(i), "l"(&reported(3))
        : "cc", "memory");
    sum += loaded;
  }
  wordAt(0xE000E010) = 0;
  reported(0) = sum;
  sleepForever();
}

PROGRAM startsSysTick() {
  stopWatchdog();
  reported(0) = 0;
  wordAt(0xE000E014) = 20971 - 1;
  wordAt(0xE000E018) = 0;
  wordAt(0xE000E010) = 7;
  sleepForever();
}

extern "C" [[gnu::noinline, gnu::used]] std::uint32_t inner(std::uint32_t value) {
  asm volatile("" ::: "memory");
  return value + 1;
}

extern "C" [[gnu::noinline, gnu::used]] std::uint32_t outer(std::uint32_t value) {
  return inner(inner(value)) + 1;
}

PROGRAM callsFunctions() {
  stopWatchdog();
  enableInterrupt(1);
  reported(0) = outer(1);
  pend(1);
  asm volatile("dsb\n\tisb");
  reported(1) = inner(1);
  sleepForever();
}
