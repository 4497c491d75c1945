#pragma once

#include <gtest/gtest.h>

namespace wr::test {

/// @brief Checks that an object with one changed member differs from an object with default values.
/// Each given member is changed alone. In the arguments, each member is followed by its new value.
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
