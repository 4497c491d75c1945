// Records for each test the called functions of the firmware. The build includes this file only
// with WR_TRACE. Each test writes one file <suite>.<test>.bin in the folder WR_TRACE_DIR. The file
// has one little-endian 64-bit number for each event. An event is the beginning or the end of a
// call. The number is the address of the called function. Bit 63 is set at the end of a call. The
// outermost calls come from the test or from the simulated platform. After kWhole events, such a
// call is shortened if it repeats an earlier call. Otherwise the calls of the timers would fill the
// file. Instead of the repeated call, the file contains the number of the event at which the
// earlier call begins, with bit 62 set. If several equal calls follow each other, the file contains
// this number only once. After kMost events, nothing more is recorded, and a file
// <suite>.<test>.truncated shows this.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace {

constexpr std::size_t kWhole = 20000;
constexpr std::size_t kMost = 60000;
constexpr std::uint64_t kExit = std::uint64_t{1} << 63U;
constexpr std::uint64_t kRepeat = std::uint64_t{1} << 62U;

std::array<std::uint64_t, kMost> events;
std::size_t count = 0;
bool truncated = false;
std::size_t depth = 0;
std::size_t begin = 0;  // beginning of the outermost call
// The outermost calls with their inner calls, and the positions at which the outermost calls begin.
std::map<std::vector<std::uint64_t>, std::size_t> before;
thread_local bool recording = false;  // only the thread that runs the tests records its calls

void note(std::uint64_t event) {
  if (count == kMost) {
    truncated = true;
    return;
  }
  events[count] = event;
  ++count;
}

void forgetRepeated() {
  if (truncated) {
    return;
  }
  const auto [first, isNew] =
      before.try_emplace({events.data() + begin, events.data() + count}, begin);
  if (!isNew && begin >= kWhole) {
    count = begin;
    if (events[count - 1] != (kRepeat | first->second)) {
      note(kRepeat | first->second);
    }
  }
}

void entered(void* function) {
  if (!recording) {
    return;
  }
  if (depth == 0) {
    begin = count;
  }
  ++depth;
  note(reinterpret_cast<std::uintptr_t>(function));
}

void left(void* function) {
  if (!recording || depth == 0) {
    return;
  }
  note(reinterpret_cast<std::uintptr_t>(function) | kExit);
  --depth;
  if (depth == 0) {
    forgetRepeated();
  }
}

class Recorder final : public testing::EmptyTestEventListener {
  void OnTestStart(const testing::TestInfo& /*test*/) override {
    count = 0;
    truncated = false;
    depth = 0;
    before.clear();
    recording = true;
  }

  void OnTestEnd(const testing::TestInfo& test) override {
    recording = false;
    std::string name = std::string(test.test_suite_name()) + "." + test.name();
    std::ranges::replace(name, '/', '_');
    const std::filesystem::path folder = WR_TRACE_DIR;
    std::filesystem::create_directories(folder);
    std::ofstream file(folder / (name + ".bin"), std::ios::binary);
    for (std::size_t i = 0; i < count; ++i) {
      for (unsigned shift = 0; shift < 64; shift += 8) {
        file.put(static_cast<char>(events[i] >> shift & 0xFFU));
      }
    }
    std::filesystem::remove(folder / (name + ".truncated"));
    if (truncated) {
      std::ofstream(folder / (name + ".truncated"))
          << "The record ends after " << kMost << " events.\n";
    }
  }
};

const bool registered = [] {
  testing::UnitTest::GetInstance()->listeners().Append(new Recorder);
  return true;
}();

}  // namespace

extern "C" {

void __cyg_profile_func_enter(void* function, void* /*callSite*/) {
  entered(function);
}

void __cyg_profile_func_exit(void* function, void* /*callSite*/) {
  left(function);
}
}
