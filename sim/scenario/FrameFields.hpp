#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/scenario/PcFrames.hpp"

namespace wr {

/// @brief A value in a frame of the robot, as the protocol page lists them.
struct FrameField {
  enum class Form { U8, I8, U16, I16, U32, I32, Bit };

  std::string name;
  std::uint8_t type = 0;   ///< of the frame: kWelcomeType or kReportType
  std::size_t offset = 0;  ///< in the payload
  Form form = Form::U8;
  unsigned bit = 0;  ///< number of the bit, of a Bit
};

inline constexpr std::uint8_t kWelcomeType = 0x81;
inline constexpr std::uint8_t kReportType = 0x82;

/// @brief All values of Welcome and Report that have a name in scenarios.
/// @return the fields, those of a frame in their order
[[nodiscard]] const std::vector<FrameField>& frameFields();

/// @brief Finds a field by its name.
/// @param name the name
/// @return the field; null if there is none
[[nodiscard]] const FrameField* findField(std::string_view name);

/// @brief Reads a value out of a frame.
/// @param body a frame of the field's type, without its CRC
/// @param field which value
/// @return the value, in the unit of the protocol
[[nodiscard]] std::int64_t valueOf(const Bytes& body, const FrameField& field);

/// @brief The number that a word of a scenario stands for in a field, such as Working in state.
/// @param field the field
/// @param word a number, or a name of one of the field's values
/// @return the number; nothing if the word is none
[[nodiscard]] std::optional<std::int64_t> numberOf(const FrameField& field, std::string_view word);

}  // namespace wr
