#include "sim/emulator/Finding.hpp"

#include "sim/emulator/hexText.hpp"

namespace wr::emulator {

std::string textOf(const Finding& finding) {
  std::string text = finding.id + ": " + finding.what + ", at pc " + hexText(finding.pc);
  if (!finding.function.empty()) {
    text += " in " + finding.function;
  }
  if (!finding.place.empty()) {
    text += " at " + finding.place;
  }
  const auto us = std::chrono::duration_cast<std::chrono::microseconds>(finding.at).count();
  return text + ", " + std::to_string(us / 1000) + "." +
         std::to_string(1000 + us % 1000).substr(1) + " ms";
}

}  // namespace wr::emulator
