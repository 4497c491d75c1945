#include "services/SystemConstants.hpp"

#include <gtest/gtest.h>

#include <type_traits>

namespace wr {
namespace {

/// @brief There is one instance, and no other can be made.
TEST(SystemConstants, HasOneInstance) {
  EXPECT_EQ(&SystemConstants::instance(), &SystemConstants::instance());
  EXPECT_FALSE(std::is_default_constructible_v<SystemConstants>);
  EXPECT_FALSE(std::is_copy_constructible_v<SystemConstants>);
  EXPECT_FALSE(std::is_copy_assignable_v<SystemConstants>);
}

/// @brief The constants are those that the requirements and the protocol name.
/// @verifies FR-1
/// @verifies FR-16
/// @verifies FR-20
/// @verifies FR-32
/// @verifies FR-33
/// @verifies FR-46
/// @verifies FR-50
/// @verifies FR-70
TEST(SystemConstants, HoldsTheValuesOfTheRequirements) {
  const SystemConstants& constants = SystemConstants::instance();
  EXPECT_EQ(constants.cyclePeriod().count(), 100000);
  EXPECT_EQ(constants.waitingCycles(), 4);
  EXPECT_EQ(constants.orderLifetime().count(), 200000);
  EXPECT_EQ(constants.handshakeTimeout().count(), 1000000);
  EXPECT_EQ(constants.linkTimeout().count(), 1000000);
  EXPECT_EQ(constants.watchdogTimeout().count(), 300000);
  EXPECT_EQ(constants.steeringLimit().count(), 3200);
  EXPECT_EQ(constants.velocityLimit().count(), 3000);
  EXPECT_EQ(constants.tensionLimit().count(), 24000);
  EXPECT_EQ(constants.currentLimit().count(), 10000);
}

}  // namespace
}  // namespace wr
