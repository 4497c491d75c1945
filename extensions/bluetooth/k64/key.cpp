#include "bluetooth/k64/key.hpp"

namespace wr {

// Erased flash has these bytes. They mean that the robot has no key. They are at 0x410, where
// ./wr flash writes the key.
[[gnu::section(".bluetooth_key"), gnu::used]] constinit const SipHash::Key bluetoothKey = {
    0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF};

}  // namespace wr
