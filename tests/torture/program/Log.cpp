#include "torture/program/Log.hpp"

#include "torture/program/processor.hpp"

namespace wr::torture {
namespace {

constexpr std::uint32_t kOpen = 0x01;
constexpr std::uint32_t kWrite = 0x05;
constexpr std::uint32_t kExit = 0x18;
constexpr std::uint32_t kToWrite = 4;
constexpr std::uint32_t kApplicationExit = 0x20026;
constexpr char kConsole[] = ":tt";

}  // namespace

void Log::add(const Record& record) {
  if (count_ == kMost) {
    full_ = true;
    return;
  }
  records_[count_] = record;
  ++count_;
}

void Log::hand() {
  if (count_ > kMost / 2) {
    flush();
  }
}

void Log::end() {
  flush();
  if (full_) {
    add({Kind::CheckFailed, static_cast<std::uint8_t>(Check::LogFull), 0, 0, {}});
    flush();
  }
  semihosting(kExit, reinterpret_cast<const void*>(kApplicationExit));
}

void Log::flush() {
  if (output_ == 0) {
    const std::array<std::uint32_t, 3> name{
        static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(kConsole)), kToWrite,
        sizeof kConsole - 1};
    output_ = semihosting(kOpen, name.data());
  }
  const std::array<std::uint32_t, 3> bytes{
      output_, static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(records_.data())),
      static_cast<std::uint32_t>(count_ * sizeof(Record))};
  semihosting(kWrite, bytes.data());
  count_ = 0;
}

}  // namespace wr::torture
