#include "services/SystemConstants.hpp"

#include <gtest/gtest.h>

#include <type_traits>

namespace wr {
namespace {

/// @brief SystemConstants has one instance, and a second instance cannot be constructed.
TEST(SystemConstants, HasOneInstance) {
  EXPECT_EQ(&SystemConstants::instance(), &SystemConstants::instance());
  EXPECT_FALSE(std::is_default_constructible_v<SystemConstants>);
  EXPECT_FALSE(std::is_copy_constructible_v<SystemConstants>);
  EXPECT_FALSE(std::is_copy_assignable_v<SystemConstants>);
}

}  // namespace
}  // namespace wr
