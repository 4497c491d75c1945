#include "services/Pipe.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <thread>

namespace wr {
namespace {

/// @brief Before the first write, there is no value.
/// @verifies FR-173
TEST(Pipe, IsEmptyBeforeTheFirstWrite) {
  Pipe<int> pipe;
  EXPECT_FALSE(pipe.read());
}

/// @brief A value stays in the pipe with its time until the next value is written.
/// @verifies FR-173
TEST(Pipe, KeepsItsValueWithItsTime) {
  Pipe<int> pipe;
  pipe.write(7, Instant(100));
  for (int i = 0; i < 3; ++i) {
    const auto value = pipe.read();
    ASSERT_TRUE(value);
    EXPECT_EQ(value->value, 7);
    EXPECT_EQ(value->at, Instant(100));
  }
}

/// @brief Only the newest of several values is read.
/// @verifies FR-173
TEST(Pipe, TellsTheNewestValue) {
  Pipe<int> pipe;
  for (int i = 1; i <= 5; ++i) {
    pipe.write(i, Instant(static_cast<std::uint64_t>(i)));
  }
  EXPECT_EQ(pipe.read()->value, 5);
  pipe.write(6, Instant(6));
  EXPECT_EQ(pipe.read()->value, 6);
}

/// @brief The value that was read last stays unchanged at its address until the next read, even
/// when new values are written.
/// @verifies FR-173
TEST(Pipe, NewestValueStandsUntilTheNextRead) {
  Pipe<int> pipe;
  EXPECT_EQ(pipe.newest(), nullptr);
  pipe.write(7, Instant(100));
  const Stamped<int>* const first = pipe.newest();
  ASSERT_NE(first, nullptr);
  pipe.write(8, Instant(200));
  pipe.write(9, Instant(300));
  EXPECT_EQ(first->value, 7);
  EXPECT_EQ(first->at, Instant(100));
  EXPECT_EQ(pipe.newest()->value, 9);
  EXPECT_EQ(pipe.read()->at, Instant(300));
}

/// @brief A reader never gets a partly written value, and never gets an older value after a newer
/// value.
/// @verifies FR-173
TEST(Pipe, ReadsWholeValuesInOrder) {
  struct Pair {
    std::uint64_t number = 0;
    std::uint64_t complement = ~std::uint64_t{0};
  };
  constexpr std::uint64_t kLast = 100000;
  Pipe<Pair> pipe;
  EXPECT_FALSE(pipe.read());
  std::thread writer([&] {
    for (std::uint64_t i = 1; i <= kLast; ++i) {
      pipe.write(Pair{i, ~i}, Instant(i));
    }
  });
  std::uint64_t newest = 0;
  while (newest < kLast) {
    const auto read = pipe.read();
    if (!read) {
      continue;
    }
    ASSERT_EQ(read->value.complement, ~read->value.number);
    ASSERT_EQ(read->at, Instant(read->value.number));
    ASSERT_GE(read->value.number, newest);
    newest = read->value.number;
  }
  writer.join();
}

}  // namespace
}  // namespace wr
