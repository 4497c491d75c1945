#include "sim/gdb/StopRules.hpp"

#include <array>
#include <cstdio>
#include <utility>

namespace wr::gdb {

void StopRules::addWatchpoint(Watch kind, std::uint32_t address, std::uint32_t size) {
  removeWatchpoint(kind, address, size);
  watchpoints_.push_back({kind, address, size});
}

void StopRules::removeWatchpoint(Watch kind, std::uint32_t address, std::uint32_t size) {
  std::erase(watchpoints_, Watchpoint{kind, address, size});
}

void StopRules::accessed(std::uint32_t address, std::uint32_t size, bool store) {
  for (const Watchpoint& each : watchpoints_) {
    const bool meets = address < each.address + each.size && each.address < address + size;
    const bool wanted = each.kind == Watch::Access || (each.kind == Watch::Write) == store;
    if (meets && wanted) {
      const char* name = each.kind == Watch::Write  ? "watch"
                         : each.kind == Watch::Read ? "rwatch"
                                                    : "awatch";
      std::array<char, 32> text{};
      std::snprintf(text.data(), text.size(), "%s:%x;", name, static_cast<unsigned>(each.address));
      hit_ = text.data();
    }
  }
}

std::optional<std::string> StopRules::takeHit() {
  return std::exchange(hit_, std::nullopt);
}

void StopRules::clear() {
  breakpoints_.clear();
  watchpoints_.clear();
  hit_.reset();
}

}  // namespace wr::gdb
