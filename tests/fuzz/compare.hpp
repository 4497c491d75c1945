#pragma once

#include <cstddef>
#include <cstdint>

#include "communication/pc_connection/Connected.hpp"
#include "communication/pc_connection/Disconnected.hpp"
#include "communication/pc_connection/Handshaking.hpp"
#include "communication/pc_connection/PcConnection.hpp"
#include "communication/serialization/OrderMessage.hpp"
#include "communication/serialization/SerialReader.hpp"
#include "fuzz/LinkOracle.hpp"
#include "fuzz/expect.hpp"
#include "support/LineBytes.hpp"

namespace wr::fuzz {

/// @brief The three state objects of a connection. Each state has a reference to the states that
/// can follow it.
struct States {
  States()
      : disconnected(handshaking),
        handshaking(connected, disconnected),
        connected(handshaking, disconnected) {}
  Disconnected disconnected;
  Handshaking handshaking;
  Connected connected;
};

/// @brief Compares two states after a cycle: the state of a connection, and the state of the oracle
/// that received the same bytes.
/// @param connection the connection
/// @param reader reader of the connection's orders
/// @param oracle the oracle
/// @param now clock pulse of the cycle [us]
inline void compare(const PcConnection& connection, const SerialReader& reader,
                    const LinkOracle& oracle, LinkOracle::Time now) {
  const LinkCounts& counts = connection.counts();
  const LinkOracle::Counts found{counts.damaged,     counts.tooLong,      counts.unknownVersion,
                                 counts.unknownType, counts.wrongLength,  counts.outOfRange,
                                 counts.unexpected,  counts.sequenceGaps, counts.staleOrders};
  expect(found == oracle.counts(), "the counts of dropped frames agree with the protocol");
  expect(connection.connected() == oracle.connected(),
         "the connection has the state that the protocol demands");
  expect(reader.stopOrdered() == oracle.stop(), "a stop is in force as the protocol demands");
  expect(reader.available() == oracle.order(now).has_value(),
         "an order can be read exactly when the protocol accepts it");
}

/// @brief Reads the order that is available, and compares it with the order of the oracle.
/// @param reader reader of the orders
/// @param oracle the oracle
/// @param now clock pulse of the cycle [us]
inline void readAndCompare(SerialReader& reader, LinkOracle& oracle, LinkOracle::Time now) {
  const test::Bytes wanted = oracle.order(now).value();
  OrderMessage order;
  expect(order.readFrom(reader), "an accepted order is in range");
  const SetPoints& found = order.setPoints();
  expect(found.orderId == (wanted[0] | wanted[1] << 8U), "the order has the id that was sent");
  for (std::size_t wheel = 0; wheel < found.wheels.size(); ++wheel) {
    const std::size_t at = 8 + 3 * wheel;
    const auto value = static_cast<std::int16_t>(wanted[at + 1] | wanted[at + 2] << 8U);
    expect(static_cast<std::uint8_t>(found.wheels[wheel].quantity) == wanted[at] &&
               found.wheels[wheel].value == value,
           "the wheel has the set-point that was sent");
  }
  oracle.orderRead();
  expect(!reader.available(), "an order is read once");
}

}  // namespace wr::fuzz
