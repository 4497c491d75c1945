#include "sim/emulator/RegisterNames.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "sim/emulator/Blocks.hpp"
#include "sim/emulator/hexText.hpp"

namespace wr::emulator {

namespace {

/// @brief A register, or an array of registers at equal distances. The character '#' in a name is
/// replaced by the index in the array.
struct Row {
  std::string_view kind;  ///< name of the block without its number
  std::uint32_t offset;
  std::string_view name;
  std::uint32_t count = 1;
  std::uint32_t stride = 0;
};

// The names of frequently used registers. See the memory maps in K64P144M120SF5RM.
constexpr auto kRows = std::to_array<Row>({
    {"ADC", 0x00, "SC1A"},
    {"ADC", 0x04, "SC1B"},
    {"ADC", 0x08, "CFG1"},
    {"ADC", 0x0C, "CFG2"},
    {"ADC", 0x10, "RA"},
    {"ADC", 0x14, "RB"},
    {"ADC", 0x18, "CV#", 2, 4},
    {"ADC", 0x20, "SC2"},
    {"ADC", 0x24, "SC3"},
    {"ADC", 0x28, "OFS"},
    {"ADC", 0x2C, "PG"},
    {"ADC", 0x30, "MG"},
    {"CAN", 0x00, "MCR"},
    {"CAN", 0x04, "CTRL1"},
    {"CAN", 0x08, "TIMER"},
    {"CAN", 0x1C, "ECR"},
    {"CAN", 0x20, "ESR1"},
    {"CAN", 0x28, "IMASK1"},
    {"CAN", 0x30, "IFLAG1"},
    {"CAN", 0x34, "CTRL2"},
    {"CMP", 0x00, "CMP#_CR0", 3, 8},
    {"CMP", 0x01, "CMP#_CR1", 3, 8},
    {"CMP", 0x02, "CMP#_FPR", 3, 8},
    {"CMP", 0x03, "CMP#_SCR", 3, 8},
    {"CMP", 0x04, "CMP#_DACCR", 3, 8},
    {"CMP", 0x05, "CMP#_MUXCR", 3, 8},
    {"CRC", 0x00, "DATA"},
    {"CRC", 0x04, "GPOLY"},
    {"CRC", 0x08, "CTRL"},
    {"DAC", 0x00, "DAT#L", 16, 2},
    {"DAC", 0x01, "DAT#H", 16, 2},
    {"DAC", 0x20, "SR"},
    {"DAC", 0x21, "C0"},
    {"DAC", 0x22, "C1"},
    {"DAC", 0x23, "C2"},
    {"DMA", 0x00, "CR"},
    {"DMA", 0x04, "ES"},
    {"DMA", 0x0C, "ERQ"},
    {"DMA", 0x14, "EEI"},
    {"DMA", 0x18, "CEEI"},
    {"DMA", 0x19, "SEEI"},
    {"DMA", 0x1A, "CERQ"},
    {"DMA", 0x1B, "SERQ"},
    {"DMA", 0x1C, "CDNE"},
    {"DMA", 0x1D, "SSRT"},
    {"DMA", 0x1E, "CERR"},
    {"DMA", 0x1F, "CINT"},
    {"DMA", 0x24, "INT"},
    {"DMA", 0x2C, "ERR"},
    {"DMA", 0x34, "HRS"},
    {"DMA_TCD", 0x00, "TCD#_SADDR", 16, 32},
    {"DMA_TCD", 0x04, "TCD#_SOFF", 16, 32},
    {"DMA_TCD", 0x06, "TCD#_ATTR", 16, 32},
    {"DMA_TCD", 0x08, "TCD#_NBYTES", 16, 32},
    {"DMA_TCD", 0x0C, "TCD#_SLAST", 16, 32},
    {"DMA_TCD", 0x10, "TCD#_DADDR", 16, 32},
    {"DMA_TCD", 0x14, "TCD#_DOFF", 16, 32},
    {"DMA_TCD", 0x16, "TCD#_CITER", 16, 32},
    {"DMA_TCD", 0x18, "TCD#_DLASTSGA", 16, 32},
    {"DMA_TCD", 0x1C, "TCD#_CSR", 16, 32},
    {"DMA_TCD", 0x1E, "TCD#_BITER", 16, 32},
    {"DMAMUX", 0x00, "CHCFG#", 16, 1},
    {"ENET", 0x04, "EIR"},
    {"ENET", 0x08, "EIMR"},
    {"ENET", 0x10, "RDAR"},
    {"ENET", 0x14, "TDAR"},
    {"ENET", 0x24, "ECR"},
    {"ENET", 0x40, "MMFR"},
    {"ENET", 0x44, "MSCR"},
    {"ENET", 0x84, "RCR"},
    {"ENET", 0xC4, "TCR"},
    {"EWM", 0x00, "CTRL"},
    {"EWM", 0x01, "SERV"},
    {"EWM", 0x02, "CMPL"},
    {"EWM", 0x03, "CMPH"},
    {"FMC", 0x00, "PFAPR"},
    {"FMC", 0x04, "PFB#CR", 2, 4},
    {"FTFE", 0x00, "FSTAT"},
    {"FTFE", 0x01, "FCNFG"},
    {"FTFE", 0x02, "FSEC"},
    {"FTFE", 0x03, "FOPT"},
    {"FTM", 0x00, "SC"},
    {"FTM", 0x04, "CNT"},
    {"FTM", 0x08, "MOD"},
    {"FTM", 0x0C, "C#SC", 8, 8},
    {"FTM", 0x10, "C#V", 8, 8},
    {"FTM", 0x4C, "CNTIN"},
    {"FTM", 0x50, "STATUS"},
    {"FTM", 0x54, "MODE"},
    {"FTM", 0x58, "SYNC"},
    {"FTM", 0x5C, "OUTINIT"},
    {"FTM", 0x60, "OUTMASK"},
    {"FTM", 0x64, "COMBINE"},
    {"FTM", 0x68, "DEADTIME"},
    {"FTM", 0x6C, "EXTTRIG"},
    {"FTM", 0x70, "POL"},
    {"FTM", 0x74, "FMS"},
    {"FTM", 0x78, "FILTER"},
    {"FTM", 0x7C, "FLTCTRL"},
    {"FTM", 0x80, "QDCTRL"},
    {"FTM", 0x84, "CONF"},
    {"FTM", 0x88, "FLTPOL"},
    {"FTM", 0x8C, "SYNCONF"},
    {"FTM", 0x90, "INVCTRL"},
    {"FTM", 0x94, "SWOCTRL"},
    {"FTM", 0x98, "PWMLOAD"},
    {"I2C", 0x00, "A1"},
    {"I2C", 0x01, "F"},
    {"I2C", 0x02, "C1"},
    {"I2C", 0x03, "S"},
    {"I2C", 0x04, "D"},
    {"I2C", 0x05, "C2"},
    {"I2C", 0x06, "FLT"},
    {"I2C", 0x07, "RA"},
    {"I2C", 0x08, "SMB"},
    {"I2C", 0x09, "A2"},
    {"I2S", 0x00, "TCSR"},
    {"I2S", 0x80, "RCSR"},
    {"I2S", 0x100, "MCR"},
    {"LLWU", 0x00, "PE1"},
    {"LLWU", 0x04, "ME"},
    {"LLWU", 0x05, "F1"},
    {"LPTMR", 0x00, "CSR"},
    {"LPTMR", 0x04, "PSR"},
    {"LPTMR", 0x08, "CMR"},
    {"LPTMR", 0x0C, "CNR"},
    {"MCG", 0x00, "C1"},
    {"MCG", 0x01, "C2"},
    {"MCG", 0x02, "C3"},
    {"MCG", 0x03, "C4"},
    {"MCG", 0x04, "C5"},
    {"MCG", 0x05, "C6"},
    {"MCG", 0x06, "S"},
    {"MCG", 0x08, "SC"},
    {"MCG", 0x0A, "ATCVH"},
    {"MCG", 0x0B, "ATCVL"},
    {"MCG", 0x0C, "C7"},
    {"MCG", 0x0D, "C8"},
    {"PDB", 0x00, "SC"},
    {"PDB", 0x04, "MOD"},
    {"PDB", 0x08, "CNT"},
    {"PDB", 0x0C, "IDLY"},
    {"PDB", 0x10, "CH#C1", 2, 0x28},
    {"PDB", 0x14, "CH#S", 2, 0x28},
    {"PIT", 0x00, "MCR"},
    {"PIT", 0xE0, "LTMR64H"},
    {"PIT", 0xE4, "LTMR64L"},
    {"PIT", 0x100, "LDVAL#", 4, 16},
    {"PIT", 0x104, "CVAL#", 4, 16},
    {"PIT", 0x108, "TCTRL#", 4, 16},
    {"PIT", 0x10C, "TFLG#", 4, 16},
    {"PORT", 0x00, "PCR#", 32, 4},
    {"PORT", 0x80, "GPCLR"},
    {"PORT", 0x84, "GPCHR"},
    {"PORT", 0xA0, "ISFR"},
    {"PORT", 0xC0, "DFER"},
    {"PORT", 0xC4, "DFCR"},
    {"PORT", 0xC8, "DFWR"},
    {"RNG", 0x00, "CR"},
    {"RNG", 0x04, "SR"},
    {"RNG", 0x08, "ER"},
    {"RNG", 0x0C, "OR"},
    {"RTC", 0x00, "TSR"},
    {"RTC", 0x04, "TPR"},
    {"RTC", 0x08, "TAR"},
    {"RTC", 0x0C, "TCR"},
    {"RTC", 0x10, "CR"},
    {"RTC", 0x14, "SR"},
    {"RTC", 0x18, "LR"},
    {"RTC", 0x1C, "IER"},
    {"SDHC", 0x00, "DSADDR"},
    {"SDHC", 0x04, "BLKATTR"},
    {"SDHC", 0x08, "CMDARG"},
    {"SDHC", 0x0C, "XFERTYP"},
    {"SDHC", 0x24, "PRSSTAT"},
    {"SDHC", 0x28, "PROCTL"},
    {"SDHC", 0x2C, "SYSCTL"},
    {"SDHC", 0x30, "IRQSTAT"},
    {"SDHC", 0x34, "IRQSTATEN"},
    {"SIM", 0x00, "SOPT1"},
    {"SIM", 0x04, "SOPT1CFG"},
    {"SIM", 0x1004, "SOPT2"},
    {"SIM", 0x100C, "SOPT4"},
    {"SIM", 0x1010, "SOPT5"},
    {"SIM", 0x1018, "SOPT7"},
    {"SIM", 0x1024, "SDID"},
    {"SIM", 0x1028, "SCGC#+1", 7, 4},
    {"SIM", 0x1044, "CLKDIV#+1", 2, 4},
    {"SIM", 0x104C, "FCFG#+1", 2, 4},
    {"SIM", 0x1054, "UIDH"},
    {"SIM", 0x1058, "UIDMH"},
    {"SIM", 0x105C, "UIDML"},
    {"SIM", 0x1060, "UIDL"},
    {"SPI", 0x00, "MCR"},
    {"SPI", 0x08, "TCR"},
    {"SPI", 0x0C, "CTAR#", 2, 4},
    {"SPI", 0x2C, "SR"},
    {"SPI", 0x30, "RSER"},
    {"SPI", 0x34, "PUSHR"},
    {"SPI", 0x38, "POPR"},
    {"UART", 0x00, "BDH"},
    {"UART", 0x01, "BDL"},
    {"UART", 0x02, "C1"},
    {"UART", 0x03, "C2"},
    {"UART", 0x04, "S1"},
    {"UART", 0x05, "S2"},
    {"UART", 0x06, "C3"},
    {"UART", 0x07, "D"},
    {"UART", 0x08, "MA#+1", 2, 1},
    {"UART", 0x0A, "C4"},
    {"UART", 0x0B, "C5"},
    {"UART", 0x0C, "ED"},
    {"UART", 0x0D, "MODEM"},
    {"UART", 0x0E, "IR"},
    {"UART", 0x10, "PFIFO"},
    {"UART", 0x11, "CFIFO"},
    {"UART", 0x12, "SFIFO"},
    {"UART", 0x13, "TWFIFO"},
    {"UART", 0x14, "TCFIFO"},
    {"UART", 0x15, "RWFIFO"},
    {"UART", 0x16, "RCFIFO"},
    {"USB", 0x00, "PERID"},
    {"USB", 0x80, "ISTAT"},
    {"USB", 0x84, "INTEN"},
    {"USB", 0x94, "CTL"},
    {"USB", 0x98, "ADDR"},
    {"USB", 0x100, "USBCTRL"},
    {"VREF", 0x00, "TRM"},
    {"VREF", 0x01, "SC"},
    {"WDOG", 0x00, "STCTRLH"},
    {"WDOG", 0x02, "STCTRLL"},
    {"WDOG", 0x04, "TOVALH"},
    {"WDOG", 0x06, "TOVALL"},
    {"WDOG", 0x08, "WINH"},
    {"WDOG", 0x0A, "WINL"},
    {"WDOG", 0x0C, "REFRESH"},
    {"WDOG", 0x0E, "UNLOCK"},
    {"WDOG", 0x10, "TMROUTH"},
    {"WDOG", 0x12, "TMROUTL"},
    {"WDOG", 0x14, "RSTCNT"},
    {"WDOG", 0x16, "PRESC"},
});

constexpr std::array<std::string_view, 6> kGpioRegisters{"PDOR", "PSOR", "PCOR",
                                                         "PTOR", "PDIR", "PDDR"};
constexpr std::uint32_t kGpio = 0x400FF000;
constexpr std::uint32_t kGpioSize = 0x40;
constexpr std::uint32_t kGpioPorts = 5;
constexpr std::uint32_t kSimSize = 0x2000;

// Returns true if a block has a given kind. The name of a block is its kind and, for some kinds,
// one more character, as in UART4 and PORTA.
bool isOfKind(std::string_view block, std::string_view kind) {
  return block == kind ||
         (block.starts_with(kind) && block.size() == kind.size() + 1 && block.back() != '_');
}

std::string nameIn(const Row& row, std::uint32_t place) {
  std::string name(row.name);
  const std::size_t at = name.find('#');
  if (at == std::string::npos) {
    return name;
  }
  const bool fromOne = name.compare(at, 3, "#+1") == 0;
  return name.replace(at, fromOne ? 3 : 1, std::to_string(place + (fromOne ? 1 : 0)));
}

std::optional<std::uint32_t> placeIn(const Row& row, std::uint32_t offset) {
  for (std::uint32_t place = 0; place < row.count; ++place) {
    if (row.offset + place * row.stride == offset) {
      return place;
    }
  }
  return std::nullopt;
}

std::string gpioName(std::uint32_t offset) {
  const std::uint32_t port = offset / kGpioSize;
  const std::uint32_t place = offset % kGpioSize / 4;
  if (port >= kGpioPorts || place >= kGpioRegisters.size()) {
    return {};
  }
  return std::string("GPIO") + static_cast<char>('A' + port) + "_" +
         std::string(kGpioRegisters.at(place));
}

}  // namespace

std::string registerName(std::uint32_t address) {
  if (address >= kGpio) {
    return gpioName(address - kGpio);
  }
  constexpr std::span<const Block> kAll(kBlocks);
  const auto block = std::ranges::find_if(kAll, [address](const Block& each) {
    const std::uint32_t size = each.name == "SIM" ? kSimSize : kBlockSize;
    return address >= each.base && address - each.base < size;
  });
  if (block == kAll.end()) {
    return {};
  }
  const std::uint32_t offset = address - block->base;
  for (const Row& row : kRows) {
    if (const auto place = placeIn(row, offset); place && isOfKind(block->name, row.kind)) {
      // The three comparators share one block. The descriptors of DMA are in a separate block.
      // Therefore the names of these registers do not begin with the name of their block.
      const bool whole = row.kind == "CMP" || row.kind == "DMA_TCD";
      return (whole ? "" : std::string(block->name) + "_") + nameIn(row, *place);
    }
  }
  return std::string(block->name) + " + " + hexText(offset);
}

}  // namespace wr::emulator
