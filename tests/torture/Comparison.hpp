#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "torture/Image.hpp"

namespace wr::torture {

/// @brief Returns the index of the first record that differs between two runs; std::nullopt when
/// all records are equal.
[[nodiscard]] std::optional<std::size_t> firstDifference(const Records& left, const Records& right);

/// @brief Returns a description of a record.
[[nodiscard]] std::string described(const Record& record);

/// @brief Returns a text with both records at an index, and with the records before them.
[[nodiscard]] std::string context(const Records& left, const Records& right, std::size_t number);

/// @brief Returns the number of entries to and exits from exceptions.
[[nodiscard]] std::size_t exceptionEvents(const Records& records);

/// @brief Returns descriptions of the failed checks of the program; empty when no check has failed.
[[nodiscard]] std::string failedChecks(const Records& records);

/// @brief Returns true if the program reached its end.
[[nodiscard]] bool complete(const Records& records);

}  // namespace wr::torture
