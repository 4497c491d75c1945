#pragma once

#include "bluetooth/SipHash.hpp"

namespace wr {

/// @brief Key that the robot shares with its Bluetooth device. The command ./wr flash writes the
/// key into the firmware image.
extern const SipHash::Key bluetoothKey;

}  // namespace wr
