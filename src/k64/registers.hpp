#pragma once

// The registers of the microcontroller MK64FN1M0VLL12 that the firmware uses. Each peripheral has
// its own namespace. The names of its registers and bits are the names in the reference manual
// (K64P144M120SF5RM). The names of the core's registers are the names in the ARMv7-M architecture
// manual. If the firmware does not use a bit, this bit has no name.

#include <cstdint>

#include "k64/Register.hpp"

namespace wr {

/// @brief Watchdog.
namespace wdog {
inline constexpr Register<std::uint16_t, 0x40052000> STCTRLH;
inline constexpr auto STCTRLH_WDOGEN = STCTRLH.bit(0);
inline constexpr auto STCTRLH_STOPEN = STCTRLH.bit(6);
inline constexpr auto STCTRLH_WAITEN = STCTRLH.bit(7);
inline constexpr auto STCTRLH_RESERVED = STCTRLH.bit(8);  // 1 after reset; the firmware keeps it 1
inline constexpr Register<std::uint16_t, 0x40052004> TOVALH;
inline constexpr Register<std::uint16_t, 0x40052006> TOVALL;
inline constexpr Register<std::uint16_t, 0x4005200C, Access::Write> REFRESH;
inline constexpr Register<std::uint16_t, 0x4005200E, Access::Write> UNLOCK;
inline constexpr Register<std::uint16_t, 0x40052016> PRESC;
}  // namespace wdog

/// @brief Multipurpose clock generator.
namespace mcg {
inline constexpr Register<std::uint8_t, 0x40064000> C1;
inline constexpr auto C1_FRDIV_1536 = C1.field(7, 3);
inline constexpr auto C1_CLKS_PLL_FLL = C1.field(0, 6);
inline constexpr auto C1_CLKS_EXTERNAL = C1.field(2, 6);
inline constexpr Register<std::uint8_t, 0x40064001> C2;
inline constexpr auto C2_RANGE_VERY_HIGH = C2.field(2, 4);
inline constexpr auto C2_LOCRE0 = C2.bit(7);
inline constexpr Register<std::uint8_t, 0x40064004> C5;
inline constexpr Register<std::uint8_t, 0x40064005> C6;
inline constexpr auto C6_CME0 = C6.bit(5);
inline constexpr auto C6_PLLS = C6.bit(6);
inline constexpr Register<std::uint8_t, 0x40064006, Access::Read> S;
inline constexpr auto S_CLKST = S.field(3, 2);
inline constexpr auto S_CLKST_EXTERNAL = S.field(2, 2);
inline constexpr auto S_CLKST_PLL = S.field(3, 2);
inline constexpr auto S_IREFST = S.bit(4);
inline constexpr auto S_PLLST = S.bit(5);
inline constexpr auto S_LOCK0 = S.bit(6);
inline constexpr Register<std::uint8_t, 0x4006400D> C8;
inline constexpr auto C8_LOLRE = C8.bit(6);
}  // namespace mcg

/// @brief System integration module: clock gates of the peripherals, and clock dividers.
namespace sim {
inline constexpr Register<std::uint32_t, 0x40048028> SCGC1;
inline constexpr auto SCGC1_UART4 = SCGC1.bit(10);
inline constexpr Register<std::uint32_t, 0x40048030> SCGC3;
inline constexpr auto SCGC3_ADC1 = SCGC3.bit(27);
inline constexpr Register<std::uint32_t, 0x40048034> SCGC4;
inline constexpr auto SCGC4_UART0 = SCGC4.bit(10);
inline constexpr Register<std::uint32_t, 0x40048038> SCGC5;
inline constexpr auto SCGC5_PORTA = SCGC5.bit(9);
inline constexpr auto SCGC5_PORTB = SCGC5.bit(10);
inline constexpr auto SCGC5_PORTC = SCGC5.bit(11);
inline constexpr auto SCGC5_PORTD = SCGC5.bit(12);
inline constexpr auto SCGC5_PORTE = SCGC5.bit(13);
inline constexpr Register<std::uint32_t, 0x4004803C> SCGC6;
inline constexpr auto SCGC6_RNGA = SCGC6.bit(9);
inline constexpr auto SCGC6_PIT = SCGC6.bit(23);
inline constexpr auto SCGC6_FTM0 = SCGC6.bit(24);
inline constexpr auto SCGC6_ADC0 = SCGC6.bit(27);
inline constexpr Register<std::uint32_t, 0x40048044> CLKDIV1;
}  // namespace sim

/// @brief Random number generator.
namespace rng {
inline constexpr Register<std::uint32_t, 0x40029000> CR;
inline constexpr auto CR_GO = CR.bit(0);
inline constexpr auto CR_HA = CR.bit(1);
inline constexpr auto CR_INTM = CR.bit(2);
inline constexpr Register<std::uint32_t, 0x40029004, Access::Read> SR;
inline constexpr auto SR_OREG_LVL = SR.field(0xFF, 8);
inline constexpr Register<std::uint32_t, 0x4002900C, Access::Read> OR;
}  // namespace rng

/// @brief Power management controller: supervision of the supply voltage.
namespace pmc {
inline constexpr Register<std::uint8_t, 0x4007D000, Access::Flags> LVDSC1;
inline constexpr auto LVDSC1_LVDV_HIGH = LVDSC1.field(1, 0);
inline constexpr auto LVDSC1_LVDRE = LVDSC1.bit(4);
}  // namespace pmc

/// @brief Reset control module: cause of the last reset.
namespace rcm {
inline constexpr Register<std::uint8_t, 0x4007F000, Access::Read> SRS0;
inline constexpr auto SRS0_LVD = SRS0.bit(1);
inline constexpr auto SRS0_LOC = SRS0.bit(2);
inline constexpr auto SRS0_LOL = SRS0.bit(3);
inline constexpr auto SRS0_WDOG = SRS0.bit(5);
inline constexpr auto SRS0_PIN = SRS0.bit(6);
inline constexpr auto SRS0_POR = SRS0.bit(7);
inline constexpr Register<std::uint8_t, 0x4007F001, Access::Read> SRS1;
inline constexpr auto SRS1_JTAG = SRS1.bit(0);
inline constexpr auto SRS1_LOCKUP = SRS1.bit(1);
inline constexpr auto SRS1_SW = SRS1.bit(2);
inline constexpr auto SRS1_MDM_AP = SRS1.bit(3);
}  // namespace rcm

/// @brief Port control: the peripheral to which each pin is connected, and the edges that cause
/// interrupts.
namespace port {
inline constexpr std::uint32_t kPortDistance = 0x1000;  // address step per port [byte]
inline constexpr std::uint32_t kPinDistance = 4;        // address step per pin [byte]
inline constexpr Register<std::uint32_t, 0x40049000, Access::Flags> PCR;
inline constexpr auto PCR_PS = PCR.bit(0);
inline constexpr auto PCR_PE = PCR.bit(1);
inline constexpr auto PCR_DSE = PCR.bit(6);
inline constexpr unsigned kMuxLowest = 8;
inline constexpr auto PCR_IRQC_BOTH_EDGES = PCR.field(11, 16);
inline constexpr Register<std::uint32_t, 0x400490A0, Access::Flags> ISFR;
inline constexpr Register<std::uint32_t, 0x400490C0> DFER;
inline constexpr Register<std::uint32_t, 0x400490C4> DFCR;
inline constexpr Register<std::uint32_t, 0x400490C8> DFWR;
}  // namespace port

/// @brief General purpose input and output.
namespace gpio {
inline constexpr std::uint32_t kPortDistance = 0x40;  // address step per port [byte]
inline constexpr Register<std::uint32_t, 0x400FF004, Access::Write> PSOR;
inline constexpr Register<std::uint32_t, 0x400FF008, Access::Write> PCOR;
inline constexpr Register<std::uint32_t, 0x400FF010, Access::Read> PDIR;
inline constexpr Register<std::uint32_t, 0x400FF014> PDDR;
}  // namespace gpio

/// @brief Periodic interrupt timer.
namespace pit {
inline constexpr Register<std::uint32_t, 0x40037000> MCR;
inline constexpr std::uint32_t kChannelDistance = 0x10;  // address step per channel [byte]
inline constexpr Register<std::uint32_t, 0x40037100> LDVAL;
inline constexpr Register<std::uint32_t, 0x40037104, Access::Read> CVAL;
inline constexpr Register<std::uint32_t, 0x40037108> TCTRL;
inline constexpr auto TCTRL_TEN = TCTRL.bit(0);
inline constexpr auto TCTRL_TIE = TCTRL.bit(1);
inline constexpr Register<std::uint32_t, 0x4003710C, Access::Flags> TFLG;
inline constexpr auto TFLG_TIF = TFLG.bit(0);
}  // namespace pit

/// @brief Flexible timer 0.
namespace ftm0 {
inline constexpr Register<std::uint32_t, 0x40038000> SC;
inline constexpr auto SC_CLKS_BUS = SC.field(1, 3);
inline constexpr Register<std::uint32_t, 0x40038004> CNT;
inline constexpr Register<std::uint32_t, 0x40038008> MOD;
inline constexpr std::uint32_t kChannelDistance = 8;  // address step per channel [byte]
inline constexpr Register<std::uint32_t, 0x4003800C> CnSC;
inline constexpr auto CnSC_ELSB = CnSC.bit(3);
inline constexpr auto CnSC_MSB = CnSC.bit(5);
inline constexpr Register<std::uint32_t, 0x40038010> CnV;
inline constexpr Register<std::uint32_t, 0x4003804C> CNTIN;
inline constexpr Register<std::uint32_t, 0x40038054> MODE;
inline constexpr auto MODE_WPDIS = MODE.bit(2);
inline constexpr Register<std::uint32_t, 0x40038084> CONF;
inline constexpr auto CONF_BDMMODE_SAFE = CONF.field(1, 6);
}  // namespace ftm0

/// @brief Analog-to-digital converters. The addresses are those of converter 0.
namespace adc {
inline constexpr std::uint32_t kConverterDistance = 0x80000;  // address step to converter 1 [byte]
inline constexpr Register<std::uint32_t, 0x4003B000, Access::Flags> SC1A;
inline constexpr auto SC1A_ADCH_NONE = SC1A.field(0x1F, 0);
inline constexpr auto SC1A_AIEN = SC1A.bit(6);
inline constexpr auto SC1A_COCO = SC1A.bit(7);
inline constexpr Register<std::uint32_t, 0x4003B008> CFG1;
inline constexpr auto CFG1_ADICLK_BUS = CFG1.field(0, 0);
inline constexpr auto CFG1_MODE_12_BITS = CFG1.field(1, 2);
inline constexpr auto CFG1_ADLSMP = CFG1.bit(4);
inline constexpr auto CFG1_ADIV_8 = CFG1.field(3, 5);
inline constexpr Register<std::uint32_t, 0x4003B00C> CFG2;
inline constexpr auto CFG2_MUXSEL_B = CFG2.bit(4);
inline constexpr Register<std::uint32_t, 0x4003B010, Access::Read> RA;
inline constexpr Register<std::uint32_t, 0x4003B020> SC2;
inline constexpr Register<std::uint32_t, 0x4003B024, Access::Flags> SC3;
inline constexpr auto SC3_AVGS_4 = SC3.field(0, 0);
inline constexpr auto SC3_AVGS_32 = SC3.field(3, 0);
inline constexpr auto SC3_AVGE = SC3.bit(2);
inline constexpr auto SC3_CALF = SC3.bit(6);
inline constexpr auto SC3_CAL = SC3.bit(7);
inline constexpr Register<std::uint32_t, 0x4003B02C> PG;
inline constexpr Register<std::uint32_t, 0x4003B030> MG;
inline constexpr std::uint32_t kCalibrationResults = 6;  // results of each side, plus and minus
inline constexpr std::uint32_t kResultDistance = 4;      // address step per result [byte]
inline constexpr Register<std::uint32_t, 0x4003B038, Access::Read> CLPS;  // CLP4 to CLP0 follow
inline constexpr Register<std::uint32_t, 0x4003B058, Access::Read> CLMS;  // CLM4 to CLM0 follow
}  // namespace adc

/// @brief Serial ports. The addresses are those of port 0.
namespace uart {
inline constexpr std::uint32_t kPort4Distance = 0x80000;  // address step to port 4 [byte]
inline constexpr Register<std::uint8_t, 0x4006A000> BDH;
inline constexpr Register<std::uint8_t, 0x4006A001> BDL;
inline constexpr Register<std::uint8_t, 0x4006A003> C2;
inline constexpr auto C2_RE = C2.bit(2);
inline constexpr auto C2_TE = C2.bit(3);
inline constexpr auto C2_RIE = C2.bit(5);
inline constexpr auto C2_TIE = C2.bit(7);
inline constexpr Register<std::uint8_t, 0x4006A004, Access::Read> S1;
inline constexpr auto S1_FE = S1.bit(1);
inline constexpr auto S1_OR = S1.bit(3);
inline constexpr auto S1_RDRF = S1.bit(5);
inline constexpr auto S1_TDRE = S1.bit(7);
inline constexpr Register<std::uint8_t, 0x4006A006> C3;
inline constexpr auto C3_ORIE = C3.bit(3);
inline constexpr Register<std::uint8_t, 0x4006A007, Access::Flags> D;
inline constexpr Register<std::uint8_t, 0x4006A00A> C4;
inline constexpr Register<std::uint8_t, 0x4006A00C, Access::Read> ED;
inline constexpr auto ED_NOISY = ED.bit(7);
inline constexpr Register<std::uint8_t, 0x4006A010> PFIFO;
inline constexpr auto PFIFO_RXFE = PFIFO.bit(3);
inline constexpr auto PFIFO_TXFE = PFIFO.bit(7);
inline constexpr Register<std::uint8_t, 0x4006A011, Access::Flags> CFIFO;
inline constexpr auto CFIFO_RXFLUSH = CFIFO.bit(6);
inline constexpr auto CFIFO_TXFLUSH = CFIFO.bit(7);
inline constexpr Register<std::uint8_t, 0x4006A014, Access::Read> TCFIFO;
inline constexpr Register<std::uint8_t, 0x4006A016, Access::Read> RCFIFO;
}  // namespace uart

/// @brief Interrupt controller of the core.
namespace nvic {
inline constexpr Register<std::uint32_t, 0xE000E100, Access::Flags> ISER;
inline constexpr Register<std::uint32_t, 0xE000E200, Access::Flags> ISPR;
inline constexpr Register<std::uint8_t, 0xE000E400> IPR;
inline constexpr unsigned kPriorityLowest = 4;  // the priority is in the upper 4 of 8 bits
}  // namespace nvic

/// @brief System control block of the core.
namespace scb {
inline constexpr Register<std::uint32_t, 0xE000ED08> VTOR;
inline constexpr Register<std::uint32_t, 0xE000ED0C, Access::Flags> AIRCR;
inline constexpr auto AIRCR_SYSRESETREQ = AIRCR.bit(2);
inline constexpr auto AIRCR_VECTKEY = AIRCR.field(0x05FA, 16);
inline constexpr Register<std::uint32_t, 0xE000ED14> CCR;
inline constexpr auto CCR_DIV_0_TRP = CCR.bit(4);
inline constexpr Register<std::uint32_t, 0xE000ED28, Access::Flags> CFSR;
inline constexpr auto CFSR_MEMORY = CFSR.field(0xFF, 0);
inline constexpr auto CFSR_BUS = CFSR.field(0xFF, 8);
inline constexpr auto CFSR_USAGE = CFSR.field(0xFFFF, 16);
inline constexpr Register<std::uint32_t, 0xE000ED88> CPACR;
inline constexpr auto CPACR_FPU = CPACR.field(0xF, 20);
}  // namespace scb

/// @brief Data watchpoint and trace unit of the core, and the bit that enables this unit.
namespace dwt {
inline constexpr Register<std::uint32_t, 0xE000EDFC> DEMCR;
inline constexpr auto DEMCR_TRCENA = DEMCR.bit(24);
inline constexpr Register<std::uint32_t, 0xE0001000> CTRL;
inline constexpr auto CTRL_CYCCNTENA = CTRL.bit(0);
inline constexpr Register<std::uint32_t, 0xE0001004, Access::Read> CYCCNT;
}  // namespace dwt

}  // namespace wr
