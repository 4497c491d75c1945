#include "communication/serialization/Serializable.hpp"

#include <gtest/gtest.h>

#include "communication/serialization/OrderMessage.hpp"
#include "communication/serialization/ReportMessage.hpp"
#include "communication/serialization/SerialReader.hpp"
#include "communication/serialization/SerialWriter.hpp"
#include "support/orders.hpp"

namespace wr {
namespace {

/// @brief An order cannot be written, and a report cannot be read. Both attempts return false.
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
