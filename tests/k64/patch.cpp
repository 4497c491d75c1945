#include "k64/patch.hpp"

#include <array>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include "support/image.hpp"

namespace wr::test {

namespace {

// Appends an instruction that writes 16 bits to a half of a register: MOVW for the lower half if
// `movt` is false, MOVT for the upper half if `movt` is true (ARMv7-M ARM, A7.7.76, encoding T3,
// and A7.7.79).
void appendMove(Code& code, unsigned reg, std::uint32_t value, bool movt) {
  const std::uint32_t high = value >> 12U;
  const std::uint32_t i = value >> 11U & 1U;
  code.push_back(static_cast<std::uint16_t>((movt ? 0xF2C0U : 0xF240U) | i << 10U | high));
  code.push_back(
      static_cast<std::uint16_t>((value >> 8U & 7U) << 12U | reg << 8U | (value & 0xFFU)));
}

void load(Code& code, unsigned reg, std::uint32_t value) {
  appendMove(code, reg, value & 0xFFFFU, false);
  appendMove(code, reg, value >> 16U, true);
}

void store(Image& image, std::size_t at, std::uint32_t value, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) {
    image.at(at + i) = static_cast<std::uint8_t>(value >> 8U * i & 0xFFU);
  }
}

}  // namespace

Image withHandler(Image image, std::uint32_t exception, const Code& code) {
  if (image.size() > kHandlerAddress) {
    throw std::logic_error(
        "the firmware image is so large that it overlaps the code of the handler");
  }
  image.resize(kHandlerAddress, 0xFF);
  image.resize(kHandlerAddress + 2 * code.size());
  for (std::size_t i = 0; i < code.size(); ++i) {
    store(image, kHandlerAddress + 2 * i, code[i], 2);
  }
  store(image, 4UL * exception, kHandlerAddress | 1U, 4);
  return image;
}

std::uint32_t addressOf(const std::string& function) {
  const std::string command = "arm-none-eabi-nm -C " + elfFile().string();
  const std::unique_ptr<FILE, int (*)(FILE*)> names(popen(command.c_str(), "r"), &pclose);
  std::array<char, 1024> line{};
  while (names && std::fgets(line.data(), line.size(), names.get()) != nullptr) {
    const std::string text = line.data();
    if (text.size() > 11 && text.substr(11) == function + "\n") {
      return static_cast<std::uint32_t>(std::stoul(text, nullptr, 16)) & ~1U;
    }
  }
  throw std::runtime_error("the firmware image has no function " + function);
}

namespace stubs {

Code hang() {
  return {0xE7FE};  // b .
}

Code readFromNowhere() {
  return {0x2060, 0x0600, 0x6801};  // movs r0, #0x60; lsls r0, r0, #24; ldr r1, [r0]
}

Code failAssertion(std::uint8_t number) {
  Code code{static_cast<std::uint16_t>(0x2000U | number)};  // movs r0, #number
  load(code, 1, addressOf("wr::assertionFailed(wr::AssertId)") | 1U);
  code.push_back(0x4788);  // blx r1
  return code;
}

Code jumpIntoPeripheral() {
  Code code;
  load(code, 0, kPeripheral | 1U);
  code.push_back(0x4700);  // bx r0
  return code;
}

Code divideByZero() {
  return {0x2001, 0x2100, 0xFBB0, 0xF0F1};  // movs r0, #1; movs r1, #0; udiv r0, r0, r1
}

Code undefined() {
  return {0xDE00};  // udf #0
}

Code overflowStack() {
  return {0xB401, 0xE7FD};  // 1: push {r0}; b 1b
}

Code keepDevicesWaiting(std::uint32_t rounds) {
  Code code;
  load(code, 2, rounds);
  code.insert(code.end(), {0x3A01, 0xD1FD, 0x4770});  // 1: subs r2, #1; bne 1b; bx lr
  return code;
}

Code takeTime(std::uint32_t rounds) {
  Code code;
  load(code, 0, 0xE000ED23);                  // SHPR3, priority of SysTick
  code.insert(code.end(), {0x2180, 0x7001});  // movs r1, #0x80; strb r1, [r0]
  load(code, 2, rounds);
  code.insert(code.end(), {0x3A01, 0xD1FD, 0x4770});  // 1: subs r2, #1; bne 1b; bx lr
  return code;
}

}  // namespace stubs

}  // namespace wr::test
