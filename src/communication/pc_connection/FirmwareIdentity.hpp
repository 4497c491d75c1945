#pragma once

#include <array>
#include <cstdint>

namespace wr {

/// @brief Identity of a firmware: its version, its sources, and the layout of its payloads.
/// @datatype
struct FirmwareIdentity {
  std::uint8_t major;           ///< major number of the version
  std::uint8_t minor;           ///< minor number of the version
  std::uint8_t patch;           ///< patch number of the version
  std::array<char, 8> buildId;  ///< first 8 hexadecimal digits of a hash of the sources
  std::uint32_t schemaHash;     ///< CRC-32 of the fields in design/frames.toml: frame, name, type
                                ///< and offset of each field
};

/// @brief Identity of this firmware. The build generates its values.
extern const FirmwareIdentity firmwareIdentity;

}  // namespace wr
