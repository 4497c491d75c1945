#include <array>
#include <cstdint>

namespace wr {

namespace {

// The flash controller reads these bytes at reset, at address 0x400. FSEC = FE: not secured, mass
// erase allowed. Any other value can lock the microcontroller permanently. FOPT = FD: a low level
// at PTA4 during the reset does not start the mode for programming over a serial line. The firmware
// does not run in this mode.
[[gnu::section(".flash_configuration"),
  gnu::used]] constexpr std::array<std::uint8_t, 16> kFlashConfiguration = {
    0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFE, 0xFD, 0xFF, 0xFF};

static_assert(sizeof(kFlashConfiguration) == 16);

}  // namespace

}  // namespace wr
