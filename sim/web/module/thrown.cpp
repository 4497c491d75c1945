// This WebAssembly module cannot catch exceptions. A throw ends the module, and the page then reads
// the text of the exception.
#include "sim/web/module/thrown.hpp"

#include <cstddef>
#include <cstdlib>
#include <exception>
#include <string>

namespace {

std::string& text() {
  static std::string instance;
  return instance;
}

}  // namespace

namespace wr::web {

std::string_view thrownText() {
  return text();
}

}  // namespace wr::web

// The C++ ABI defines these names. The compiler calls these functions.
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming): names of the C++ ABI
extern "C" void* __cxa_allocate_exception(std::size_t size) noexcept {
  return std::malloc(size);
}

// All exceptions of the simulator are derived from std::exception, which is their first base.
extern "C" [[noreturn]] void __cxa_throw(void* thrown, void* /*type*/,
                                         void (* /*destroy*/)(void*)) {
  text() = static_cast<std::exception*>(thrown)->what();
  __builtin_trap();
}
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)
