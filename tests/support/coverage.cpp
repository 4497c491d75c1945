// Records which arcs of the firmware's flow graphs each test takes. The build includes it only with
// WR_TRACE.
//
// Each test gives one file in the folder WR_TRACE_DIR, named <suite>.<test>.arcs. A line with a
// name says which file of counters the lines below it belong to; each of those has the number of a
// function that ran, and its counters.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

// The header of the compiler is one of C. The counters of all units are between two symbols that
// the linker makes. The runtime of the compiler learns of a unit by __gcov_init; without it, no
// counter can be set back.
extern "C" {
#include <gcov.h>
extern const gcov_info* const __start_wr_counters[];  // NOLINT
extern const gcov_info* const __stop_wr_counters[];   // NOLINT
void __gcov_init(const gcov_info* unit);              // NOLINT
}

namespace {

// What gcc writes: a header of four words, then records of a tag, a length in bytes and words.
// A negative length stands for counters that are all zero.
constexpr std::size_t kHeader = 4;
constexpr std::uint32_t kFunction = 0x01000000;
constexpr std::uint32_t kArcs = 0x01A10000;

struct Unit {
  std::string name;
  std::vector<std::uint32_t> words;
};

void keepName(const char* name, void* unit) {
  static_cast<Unit*>(unit)->name = name;
}

void keepWords(const void* data, unsigned bytes, void* unit) {
  std::vector<std::uint32_t>& words = static_cast<Unit*>(unit)->words;
  const std::size_t before = words.size();
  words.resize(before + bytes / sizeof(std::uint32_t));
  std::memcpy(words.data() + before, data, bytes);
}

void* allocate(unsigned bytes, void* /*unit*/) {
  return std::malloc(bytes);  // NOLINT: asked for by the runtime of the compiler
}

void writeFunctions(const Unit& unit, std::ostream& stream) {
  const std::vector<std::uint32_t>& words = unit.words;
  bool named = false;
  std::uint32_t function = 0;
  for (std::size_t at = kHeader; at + 1 < words.size();) {
    const std::uint32_t tag = words[at];
    const auto bytes = static_cast<std::int32_t>(words[at + 1]);
    const std::size_t begin = at + 2;
    at = begin + static_cast<std::size_t>(std::max(bytes, 0)) / sizeof(std::uint32_t);
    if (tag == kFunction && bytes > 0) {
      function = words[begin];
    } else if (tag == kArcs && bytes > 0) {
      if (!named) {
        stream << unit.name << '\n';
        named = true;
      }
      stream << function;
      for (std::size_t word = begin; word < at; word += 2) {
        stream << ' ' << (words[word] | std::uint64_t{words[word + 1]} << 32U);
      }
      stream << '\n';
    }
  }
}

class Recorder final : public testing::EmptyTestEventListener {
  void OnTestProgramStart(const testing::UnitTest& /*all*/) override {
    for (auto unit = __start_wr_counters; unit != __stop_wr_counters; ++unit) {
      __gcov_init(*unit);
    }
  }

  void OnTestStart(const testing::TestInfo& /*test*/) override { __gcov_reset(); }

  void OnTestEnd(const testing::TestInfo& test) override {
    std::string name = std::string(test.test_suite_name()) + "." + test.name();
    std::ranges::replace(name, '/', '_');
    const std::filesystem::path folder = WR_TRACE_DIR;
    std::filesystem::create_directories(folder);
    std::ofstream file(folder / (name + ".arcs"));
    for (auto unit = __start_wr_counters; unit != __stop_wr_counters; ++unit) {
      Unit found;
      __gcov_info_to_gcda(*unit, keepName, keepWords, allocate, &found);
      writeFunctions(found, file);
    }
  }
};

const bool registered = [] {
  testing::UnitTest::GetInstance()->listeners().Append(new Recorder);
  return true;
}();

}  // namespace
