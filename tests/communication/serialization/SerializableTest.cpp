#include "communication/serialization/Serializable.hpp"

#include <gtest/gtest.h>

#include "communication/serialization/OrderMessage.hpp"
#include "communication/serialization/ReportMessage.hpp"
#include "communication/serialization/SerialReader.hpp"
#include "communication/serialization/SerialWriter.hpp"
#include "support/orders.hpp"

namespace wr {
namespace {

/// @brief No order is written, and no report is read.
TEST(Serializable, TheOtherDirectionFails) {
  SerialWriter writer;
  EXPECT_FALSE(OrderMessage().writeTo(writer));
  EXPECT_TRUE(writer.bytes().empty());
  SerialReader reader;
  ASSERT_TRUE(reader.offer(test::orderBytes(1, 0, 0, 0), Instant()));
  EXPECT_FALSE(ReportMessage({}).readFrom(reader));
  EXPECT_TRUE(reader.available());
}

}  // namespace
}  // namespace wr
