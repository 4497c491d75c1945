#include "bluetooth/k64/key.hpp"

namespace wr {

// The bytes of flash that was never written: no key. They lie at 0x410, where ./wr flash writes the
// key.
[[gnu::section(".bluetooth_key"), gnu::used]] constinit const SipHash::Key bluetoothKey = {
    0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF};

}  // namespace wr
