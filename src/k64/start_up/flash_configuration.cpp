#include <array>
#include <cstdint>

namespace wr {

namespace {

// At reset the flash controller reads these bytes at address 0x400. FSEC is 0xFE: the flash is not
// secured, and it can be erased completely. Another value of FSEC can lock the microcontroller
// permanently. FOPT is 0xFD: the mode for programming over a serial line (EZPORT) is disabled.
// Otherwise a low level at PTA4 during the reset would start EZPORT, and the firmware would not
// run.
[[gnu::section(".flash_configuration"),
  gnu::used]] constexpr std::array<std::uint8_t, 16> kFlashConfiguration = {
    0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFE, 0xFD, 0xFF, 0xFF};

static_assert(sizeof(kFlashConfiguration) == 16);

}  // namespace

}  // namespace wr
