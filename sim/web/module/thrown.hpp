#pragma once

#include <string_view>

namespace wr::web {

/// @brief Returns the text of the exception that ended the module; empty when something else ended it.
[[nodiscard]] std::string_view thrownText();

}  // namespace wr::web
