#include "bluetooth/k64/key.hpp"

namespace wr {

// These bytes mean that the robot has no key: they are the content of erased flash. The linker
// script places them at the address 0x410. The command ./wr flash writes the key to this address.
[[gnu::section(".bluetooth_key"), gnu::used]] constinit const SipHash::Key bluetoothKey = {
    0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF};

}  // namespace wr
