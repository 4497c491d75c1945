// Records for each test the executed arcs of the firmware's control-flow graphs. The build includes
// this file only with WR_TRACE. Each test writes one file <suite>.<test>.arcs in the folder
// WR_TRACE_DIR. A line that does not begin with a number is the name of a counter file. The lines
// after this name belong to this counter file. Each of these lines has the number of a function
// that ran, and the counters of this function.
//
// The counters of the whole run are also written to the counter files of gcc, which other programs
// read.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

// The header gcov.h of the compiler contains C declarations. The linker defines two symbols. The
// counters of all translation units are between these symbols. The function __gcov_init registers a
// unit in the runtime of the compiler. Without this call, the runtime neither clears the counters
// nor writes them to a file.
extern "C" {
#include <gcov.h>
// The linker and the compiler define these names.
extern const gcov_info* const __start_wr_counters[];
extern const gcov_info* const __stop_wr_counters[];
void __gcov_init(const gcov_info* unit);
}

namespace {

// The file format of gcc has a header of four words and then records. A record has a tag, a length
// in bytes, and words. A negative length means that all counters are zero.
constexpr std::size_t kHeader = 4;
constexpr std::uint32_t kFunction = 0x01000000;
constexpr std::uint32_t kArcs = 0x01A10000;

struct Unit {
  std::string name;
  std::vector<std::uint32_t> words;
  std::vector<std::uint32_t> wordsBefore;
  // Counts of each function at the end of the previous test.
  std::map<std::uint32_t, std::vector<std::uint64_t>> before;
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
  return std::malloc(bytes);  // memory that the runtime of the compiler requests
}

// Returns the increments of a function's counters since the previous call.
std::vector<std::uint64_t> grown(std::vector<std::uint64_t>& before, const std::uint32_t* words,
                                 std::size_t count) {
  std::vector<std::uint64_t> found(count);
  before.resize(count);
  for (std::size_t number = 0; number < count; ++number) {
    const std::uint64_t now = words[2 * number] | std::uint64_t{words[2 * number + 1]} << 32U;
    found[number] = now - before[number];
    before[number] = now;
  }
  return found;
}

void writeFunctions(Unit& unit, std::ostream& stream) {
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
      const auto counters = grown(unit.before[function], words.data() + begin, (at - begin) / 2);
      if (std::ranges::all_of(counters, [](std::uint64_t counter) { return counter == 0; })) {
        continue;
      }
      if (!named) {
        stream << unit.name << '\n';
        named = true;
      }
      stream << function;
      for (const std::uint64_t counter : counters) {
        stream << ' ' << counter;
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
    __gcov_reset();
  }

  void OnTestEnd(const testing::TestInfo& test) override {
    std::string name = std::string(test.test_suite_name()) + "." + test.name();
    std::ranges::replace(name, '/', '_');
    const std::filesystem::path folder = WR_TRACE_DIR;
    std::filesystem::create_directories(folder);
    std::ofstream file(folder / (name + ".arcs"));
    for (auto unit = __start_wr_counters; unit != __stop_wr_counters; ++unit) {
      Unit& found = units_[*unit];
      found.words.swap(found.wordsBefore);
      found.words.clear();
      __gcov_info_to_gcda(*unit, keepName, keepWords, allocate, &found);
      if (found.words != found.wordsBefore) {
        writeFunctions(found, file);
      }
    }
  }

  void OnTestProgramEnd(const testing::UnitTest& /*all*/) override { __gcov_dump(); }

  std::map<const gcov_info*, Unit> units_;
};

const bool registered = [] {
  testing::UnitTest::GetInstance()->listeners().Append(new Recorder);
  return true;
}();

}  // namespace
