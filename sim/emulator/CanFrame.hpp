#pragma once

#include <cstdint>
#include <vector>

namespace wr::emulator {

/// @brief A data frame of the CAN bus with a standard identifier (ISO 11898-1).
struct CanFrame {
  std::uint16_t identifier =
      0;  ///< 11 bits; of two waiting frames, the frame with the smaller identifier is sent first
  std::vector<std::uint8_t> data;  ///< at most 8 bytes
};

}  // namespace wr::emulator
