#include "main_control/operation_modes/Mode.hpp"

#include "communication/serialization/BufferReader.hpp"
#include "main_control/ControllerFixture.hpp"
#include "main_control/operation_modes/BasicMode.hpp"
#include "main_control/operation_modes/PC.hpp"
#include "main_control/operation_modes/RC.hpp"

namespace wr::test {
namespace {

// A source with an incomplete order.
class BrokenReader final : public Reader {
 public:
  [[nodiscard]] bool available() const override { return true; }
  [[nodiscard]] bool stopOrdered() const override { return false; }
  std::uint8_t readU8(Field /*field*/) override { return 0; }
  std::uint16_t readU16(Field /*field*/) override { return 0; }
  std::int16_t readI16(Field /*field*/) override { return 0; }
  std::uint32_t readU32(Field /*field*/) override { return 0; }
  bool finish() override { return false; }
};

class ModeTest : public ControllerFixture {
 protected:
  // Sends an order of the connected PC over the serial line, and serves the link.
  void order(std::uint16_t id, bool stop = false) {
    port.arrive(pc.order({.id = id, .stop = stop}));
    serveLink();
  }

  int source() {
    return data.report(OperationStateId::Working, ModeId::RC, connection.counts()).source;
  }

  Pipe<Velocity> velocity;
  Pipe<Angle> direction;
  BufferReader rcReader{velocity, direction, time};
  BasicMode basicPc{pcReader};
  BasicMode basicRc{rcReader};
};

/// @brief The basic mode has a message as long as its reader has an order.
/// @verifies FR-20
TEST_F(ModeTest, FR20_BasicModeAsksItsReader) {
  connect();
  EXPECT_FALSE(basicPc.newMessage());
  order(4);
  EXPECT_TRUE(basicPc.newMessage());
  time.advance(milliseconds(200));
  serveLink();
  EXPECT_TRUE(basicPc.newMessage());
  time.advance(Microseconds(1));
  serveLink();
  EXPECT_FALSE(basicPc.newMessage());
}

/// @brief The basic mode reads an order into the data of the controller. The mode cannot read this
/// order again.
/// @verifies FR-20
TEST_F(ModeTest, FR20_BasicModeReadsTheOrderOnce) {
  connect();
  order(4);
  basicPc.read(controller);
  EXPECT_EQ(data.setPoints()->orderId, 4);
  EXPECT_FALSE(basicPc.newMessage());
}

/// @brief An incomplete order does not change the set-points.
/// @verifies FR-20
TEST_F(ModeTest, FR20_OrderThatCannotBeReadWholeChangesNothing) {
  data.saveSetPoints({.orderId = 8});
  BrokenReader broken;
  BasicMode mode(broken);
  mode.read(controller);
  EXPECT_EQ(data.setPoints()->orderId, 8);
}

/// @brief changeMode() of the basic mode has no effect.
/// @verifies FR-17
TEST_F(ModeTest, FR17_BasicModeChangesNothing) {
  basicRc.changeMode(controller);
  EXPECT_EQ(&controller.getMode(), &first);
  EXPECT_EQ(basicRc.id(), ModeId::None);
}

/// @brief The mode RC records the remote control as the source of the set-points.
/// @verifies FR-11
/// @verifies FR-19
TEST_F(ModeTest, FR19_RcMarksTheSource) {
  RC rc(basicRc, second);
  velocity.write(Velocity(10), time.now());
  direction.write(Angle(20), time.now());
  ASSERT_TRUE(rc.newMessage());
  rc.read(controller);
  EXPECT_EQ(source(), 0);
  EXPECT_EQ(data.setPoints()->steering, Angle(20));
  EXPECT_EQ(rc.id(), ModeId::RC);
}

/// @brief The mode PC records the PC as the source of the set-points.
/// @verifies FR-12
/// @verifies FR-19
TEST_F(ModeTest, FR19_PcMarksTheSource) {
  PC mode(basicPc, second, connection);
  connect();
  order(6);
  ASSERT_TRUE(mode.newMessage());
  mode.read(controller);
  EXPECT_EQ(source(), 1);
  EXPECT_EQ(data.setPoints()->orderId, 6);
  EXPECT_EQ(mode.id(), ModeId::PC);
}

/// @brief The mode PC has no message without a connection, even if its reader has an order.
/// @verifies FR-36
TEST_F(ModeTest, FR36_PcHasNoMessageWithoutConnection) {
  FakeMode wrapped(ModeId::None);
  wrapped.message = true;
  PC mode(wrapped, second, connection);
  EXPECT_FALSE(mode.newMessage());
  connect();
  EXPECT_TRUE(mode.newMessage());
  wrapped.message = false;
  EXPECT_FALSE(mode.newMessage());
}

/// @brief In the modes RC and PC, changeMode() sets the successor of the mode as the present mode.
/// @verifies FR-17
TEST_F(ModeTest, FR17_ModesChangeToTheOther) {
  RC rc(basicRc, second);
  PC mode(basicPc, first, connection);
  rc.changeMode(controller);
  EXPECT_EQ(&controller.getMode(), &second);
  mode.changeMode(controller);
  EXPECT_EQ(&controller.getMode(), &first);
}

/// @brief The mode PC reports a stop order of the PC, even when the order is old and the link is
/// lost.
/// @verifies FR-21
TEST_F(ModeTest, FR21_ModePassesTheStopOn) {
  PC mode(basicPc, second, connection);
  RC rc(basicRc, second);
  connect();
  EXPECT_FALSE(mode.stopOrdered());
  order(1, true);
  time.advance(milliseconds(5000));
  serveLink();
  ASSERT_FALSE(connection.connected());
  EXPECT_TRUE(mode.stopOrdered());
  EXPECT_FALSE(rc.stopOrdered());
}

}  // namespace
}  // namespace wr::test
