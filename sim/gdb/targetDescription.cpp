#include "sim/gdb/targetDescription.hpp"

#include <string_view>

#include "sim/emulator/DebugPort.hpp"

namespace wr::gdb {

namespace {

// Returns the name of the feature that begins with this register; empty if no feature begins with
// it (GDB manual, ARM Features).
std::string_view featureFrom(std::string_view name) {
  if (name == "r0") {
    return "org.gnu.gdb.arm.m-profile";
  }
  if (name == "msp") {
    return "org.gnu.gdb.arm.m-system";
  }
  return name == "d0" ? "org.gnu.gdb.arm.vfp" : "";
}

std::string_view typeOf(const emulator::DebugPort::Register& each) {
  if (each.bits == 64) {
    return "ieee_double";
  }
  if (each.name == "pc") {
    return "code_ptr";
  }
  return each.name == "sp" || each.name == "msp" || each.name == "psp" ? "data_ptr" : "int";
}

}  // namespace

std::string targetDescription() {
  std::string text =
      "<?xml version=\"1.0\"?><!DOCTYPE target SYSTEM \"gdb-target.dtd\">"
      "<target><architecture>arm</architecture>";
  bool open = false;
  for (const emulator::DebugPort::Register& each : emulator::DebugPort::registers()) {
    if (const std::string_view feature = featureFrom(each.name); !feature.empty()) {
      text += open ? "</feature>" : "";
      text += "<feature name=\"" + std::string(feature) + "\">";
      open = true;
    }
    text += "<reg name=\"" + std::string(each.name) + "\" bitsize=\"" + std::to_string(each.bits) +
            "\" type=\"" + std::string(typeOf(each)) + "\"/>";
  }
  return text + "</feature></target>";
}

}  // namespace wr::gdb
