#pragma once

#include <string_view>

namespace wr::web {

/// @brief Text of the exception that ended the module; empty when it was ended by something else.
[[nodiscard]] std::string_view thrownText();

}  // namespace wr::web
