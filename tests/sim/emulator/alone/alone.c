/* A program for a K64 board. It shares neither sources, headers, pins nor memory layout with the
 * firmware. Its clock is the clock after a reset, 20.97 MHz.
 *
 * It prints a banner at UART0 on PTA14 and PTA15. It blinks an LED at PTE6 from the interrupt of
 * PIT channel 2, which changes the pin each 50 ms. It prints the voltage at ADC0_SE8, PTB0, ten
 * times a second. When it receives a 'd', it uses the DAC. */

#include <stdint.h>

#define BYTE(address) (*(volatile uint8_t*)(address))
#define HALF(address) (*(volatile uint16_t*)(address))
#define WORD(address) (*(volatile uint32_t*)(address))

#define SIM_SCGC2 WORD(0x4004802C)
#define SIM_SCGC4 WORD(0x40048034)
#define SIM_SCGC5 WORD(0x40048038)
#define SIM_SCGC6 WORD(0x4004803C)
#define PORTA_PCR14 WORD(0x40049038)
#define PORTA_PCR15 WORD(0x4004903C)
#define PORTB_PCR0 WORD(0x4004A000)
#define PORTE_PCR6 WORD(0x4004D018)
#define GPIOE_PTOR WORD(0x400FF10C)
#define GPIOE_PDDR WORD(0x400FF114)
#define WDOG_STCTRLH HALF(0x40052000)
#define WDOG_UNLOCK HALF(0x4005200E)
#define UART0_BDH BYTE(0x4006A000)
#define UART0_BDL BYTE(0x4006A001)
#define UART0_C2 BYTE(0x4006A003)
#define UART0_S1 BYTE(0x4006A004)
#define UART0_D BYTE(0x4006A007)
#define UART0_C4 BYTE(0x4006A00A)
#define PIT_MCR WORD(0x40037000)
#define PIT_LDVAL2 WORD(0x40037120)
#define PIT_TCTRL2 WORD(0x40037128)
#define PIT_TFLG2 WORD(0x4003712C)
#define ADC0_SC1A WORD(0x4003B000)
#define ADC0_CFG1 WORD(0x4003B008)
#define ADC0_RA WORD(0x4003B010)
#define ADC0_SC3 WORD(0x4003B024)
#define DAC0_C0 BYTE(0x400CC021)
#define NVIC_ISER1 WORD(0xE000E104)

extern uint32_t data_begin[], data_end[], data_load[], bss_begin[], bss_end[], stack_top[];

static volatile uint32_t blinks;
static const char* banner = "alone on a K64\r\n";

static void send(char character) {
  while ((UART0_S1 & 0x80) == 0) {
  }
  UART0_D = (uint8_t)character;
}

static void print(const char* text) {
  for (; *text != 0; ++text) {
    send(*text);
  }
}

static void printNumber(uint32_t number) {
  if (number >= 10) {
    printNumber(number / 10);
  }
  send((char)('0' + number % 10));
}

/* The manual demands a calibration before the first conversion. */
static void calibrate(void) {
  ADC0_CFG1 = 0x64; /* 12 bits, bus clock / 8 = 2.6 MHz */
  ADC0_SC3 = 0x87;
  while ((ADC0_SC3 & 0x80) != 0) {
  }
  uint32_t plus = 0;
  uint32_t minus = 0;
  for (uint32_t offset = 0x38; offset <= 0x4C; offset += 4) { /* CLPS to CLP0, CLMS to CLM0 */
    plus += WORD(0x4003B000 + offset);
    minus += WORD(0x4003B020 + offset);
  }
  WORD(0x4003B02C) = (plus & 0xFFFF) / 2 | 0x8000;
  WORD(0x4003B030) = (minus & 0xFFFF) / 2 | 0x8000;
}

static uint32_t convert(uint32_t channel) {
  ADC0_SC1A = channel;
  while ((ADC0_SC1A & 0x80) == 0) {
  }
  return ADC0_RA;
}

static void blink(void) {
  PIT_TFLG2 = 1;
  GPIOE_PTOR = 1u << 6;
  ++blinks;
}

static void run(void) {
  SIM_SCGC4 |= 1u << 10;
  SIM_SCGC5 |= 1u << 9 | 1u << 10 | 1u << 13;
  SIM_SCGC6 |= 1u << 23 | 1u << 27;

  PORTA_PCR14 = 3u << 8;
  PORTA_PCR15 = 3u << 8;
  UART0_BDH = 0;
  UART0_BDL = 11; /* 20.97 MHz / 16 / (11 + 12/32) = 115.2 kBd */
  UART0_C4 = 12;
  UART0_C2 = 0x0C;

  PORTE_PCR6 = 1u << 8;
  GPIOE_PDDR = 1u << 6;
  (void)PIT_MCR; /* erratum e7914: after the clock gate was opened, read this register first */
  PIT_MCR = 0;
  PIT_LDVAL2 = 1048576 - 1; /* 50 ms */
  PIT_TCTRL2 = 3;
  NVIC_ISER1 = 1u << (50 - 32);

  print(banner);
  calibrate();
  for (uint32_t printed = 0;;) {
    if (blinks >= printed + 2) {
      printed = blinks;
      printNumber(convert(8) * 3300 / 4095);
      print(" mV\r\n");
    }
    if ((UART0_S1 & 0x20) != 0 && UART0_D == 'd') {
      SIM_SCGC2 |= 1u << 12;
      DAC0_C0 = 0x80;
      print("DAC\r\n");
    }
  }
}

void start(void);

void start(void) {
  WDOG_UNLOCK = 0xC520;
  WDOG_UNLOCK = 0xD928;
  __asm volatile("nop\n\tnop");
  WDOG_STCTRLH = 0x01D2;
  const uint32_t* from = data_load;
  for (uint32_t* to = data_begin; to < data_end; ++to, ++from) {
    *to = *from;
  }
  for (uint32_t* to = bss_begin; to < bss_end; ++to) {
    *to = 0;
  }
  run();
}

static void stopHere(void) {
  for (;;) {
  }
}

__attribute__((section(".vectors"), used)) static void (*const vectors[16 + 86])(void) = {
    (void (*)(void))stack_top,
    start,
    stopHere,
    stopHere,
    stopHere,
    stopHere,
    stopHere,
    0,
    0,
    0,
    0,
    stopHere,
    stopHere,
    0,
    stopHere,
    stopHere,
    [16 + 50] = blink};

__attribute__((section(".flash_config"), used)) static const uint32_t config[4] = {
    0xFFFFFFFF, 0xFFFFFFFF, 0xFFFFFFFF, 0xFFFFFFFE};
