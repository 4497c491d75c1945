// Vectors, start and the common entry of all exceptions.
  .syntax unified
  .thumb

  .section .vectors, "a"
  .word stackTop
  .word start
  .rept 46
  .word enter
  .endr

  .section .settings, "a"
  .word 1     // seed
  .word 1000  // actions

  .text
  .global start
  .thumb_func
// In both emulators, RAM is zero after power-on. With an odd seed, thread mode has a separate
// stack.
start:
  ldr r0, =0xE000ED88  // CPACR: floating point
  ldr r1, =0x00F00000
  str r1, [r0]
  dsb
  isb
  ldr r0, =0xC0
  ldr r0, [r0]
  tst r0, #1
  beq 1f
  ldr r1, =threadStackTop
  msr psp, r1
  movs r1, #2
  msr control, r1
  isb
1:
  bl run
  b .

  .thumb_func
enter:
  mov r0, lr
  tst lr, #4
  ite eq
  mrseq r1, msp
  mrsne r1, psp
  push {r4, lr}
  bl handle
  pop {r4, pc}
