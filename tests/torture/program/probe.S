// Fills all registers, executes one action that may cause exceptions, and stores all registers.
  .syntax unified
  .thumb
  .fpu fpv4-sp-d16

// Members of Probe
  .equ core, 0          // R0 to R12
  .equ flags, 52
  .equ pad, 56          // 0 or 4; remainder of the stack pointer modulo 8
  .equ usesFp, 60
  .equ stack, 64        // stack pointer that is restored
  .equ coreAfter, 68    // R0 to R12
  .equ flagsAfter, 120
  .equ stackBefore, 124
  .equ stackAfter, 128
  .equ fpStatusAtStart, 132
  .equ fpStatus, 136
  .equ fpStatusAfter, 140
  .equ fp, 144          // S0 to S31
  .equ fpAfter, 272     // S0 to S31

  .macro probe name, trigger:vararg
  .global \name
  .thumb_func
\name:
  push {r4-r11, lr}
  sub sp, #4
  ldr r1, [r0, #usesFp]
  cbz r1, 1f
  vmrs r1, fpscr
  str r1, [r0, #fpStatusAtStart]
  vpush {s16-s31}
  add r1, r0, #fp
  vldmia r1, {s0-s31}
  ldr r1, [r0, #fpStatus]
  vmsr fpscr, r1
1:
  str sp, [r0, #stack]
  ldr r1, [r0, #pad]
  sub sp, sp, r1
  push {r0, r1}
  str sp, [r0, #stackBefore]
  ldr r1, [r0, #flags]
  msr apsr_nzcvqg, r1
  ldmia r0, {r0-r12}
  \trigger
  dsb
  isb
  push {r0-r12}
  add r1, sp, #52
  ldr r0, [r1]
  str r1, [r0, #stackAfter]
  mrs r1, apsr
  str r1, [r0, #flagsAfter]
  add r1, r0, #coreAfter
  mov r2, sp
  movs r3, #13
2:
  ldr r4, [r2], #4
  str r4, [r1], #4
  subs r3, #1
  bne 2b
  ldr sp, [r0, #stack]
  ldr r1, [r0, #usesFp]
  cbz r1, 3f
  vmrs r1, fpscr
  str r1, [r0, #fpStatusAfter]
  add r1, r0, #fpAfter
  vstmia r1, {s0-s31}
  vpop {s16-s31}
3:
  add sp, #4
  pop {r4-r11, pc}
  .endm

  .text
  probe probeStore, str r1, [r0]
  probe probeSupervisor, svc 0
  probe probeUndefined, udf 0
  probe probeBusError, ldr r2, [r0]
  .macro storeInItBlock
  itttt eq
  streq r1, [r0]
  dsbeq
  isbeq
  moveq r2, r3
  .endm
  probe probeItBlock, storeInItBlock
