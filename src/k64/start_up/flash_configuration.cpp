#include <array>
#include <cstdint>

namespace wr {

namespace {

// At reset the flash controller reads these bytes at address 0x400. FSEC is 0xFE: the flash is not
// secured, and it can be erased completely. Another value of FSEC can lock the microcontroller
// permanently. FOPT is 0xF9: the mode for programming over a serial line (EZPORT) and the
// non-maskable interrupt are disabled. Otherwise a low level at PTA4 during the reset would start
// EZPORT, and a low level after the reset would cause the interrupt before the firmware configures
// the pin. On the board, a capacitor keeps PTA4 low for some milliseconds after power-on.
[[gnu::section(".flash_configuration"),
  gnu::used]] constexpr std::array<std::uint8_t, 16> kFlashConfiguration = {
    0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFE, 0xF9, 0xFF, 0xFF};

static_assert(sizeof(kFlashConfiguration) == 16);

}  // namespace

}  // namespace wr
