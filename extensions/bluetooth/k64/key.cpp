#include "bluetooth/k64/key.hpp"

namespace wr {

// These are the bytes of erased flash, which mean that there is no key. They are at 0x410, where
// ./wr flash writes the key.
[[gnu::section(".bluetooth_key"), gnu::used]] constinit const SipHash::Key bluetoothKey = {
    0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF};

}  // namespace wr
