#pragma once

#include <gtest/gtest.h>

namespace wr::test {

/// @brief Expects that a value is no longer equal to a default one when any one of the given
/// members is set to the value that follows it.
template <class T, class Member, class Value, class... Rest>
void expectDifference(Member T::*member, const Value& value, const Rest&... rest) {
  T changed{};
  EXPECT_EQ(changed, T{});
  changed.*member = value;
  EXPECT_NE(changed, T{});
  if constexpr (sizeof...(rest) > 0) {
    expectDifference(rest...);
  }
}

}  // namespace wr::test
