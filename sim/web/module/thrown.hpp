#pragma once

#include <string_view>

namespace wr::web {

/// @brief Returns the text of the exception that ended the module; empty when the module did not
/// end by an exception.
[[nodiscard]] std::string_view thrownText();

}  // namespace wr::web
