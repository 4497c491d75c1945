#pragma once

#include <gtest/gtest.h>

#include <string>

namespace wr::test {

/// @brief Records in the test results that a test is only for one product. All other tests of the
/// firmware image also run with the image of `weeding_robot_paper`.
/// @param product name of the product
inline void onlyWith(const std::string& product) {
  testing::Test::RecordProperty("only", product);
}

}  // namespace wr::test
