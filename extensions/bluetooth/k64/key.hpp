#pragma once

#include "bluetooth/SipHash.hpp"

namespace wr {

/// @brief Key that the robot shares with its Bluetooth device. It is written into the image when
/// the image is flashed.
extern const SipHash::Key bluetoothKey;

}  // namespace wr
