#pragma once

#include <gtest/gtest.h>

#include <array>
#include <functional>

#include "communication/pc_connection/Connected.hpp"
#include "communication/pc_connection/Disconnected.hpp"
#include "communication/pc_connection/Handshaking.hpp"
#include "communication/pc_connection/PcConnection.hpp"
#include "communication/serialization/SerialReader.hpp"
#include "main_control/MainController.hpp"
#include "main_control/SpySystem.hpp"
#include "sim/host/HostScheduler.hpp"
#include "sim/host/HostSerialPort.hpp"
#include "sim/host/HostThread.hpp"
#include "sim/host/HostWatchdog.hpp"
#include "sim/scenario/PcFrames.hpp"
#include "support/FakeTimebase.hpp"

namespace wr::test {

/// A mode that the test controls. It records the calls of its functions.
class FakeMode final : public Mode {
 public:
  explicit FakeMode(ModeId id) : Mode(id) {}

  bool message = false;
  bool stop = false;
  int reads = 0;
  int changes = 0;
  Mode* next = this;
  std::function<void()> onServe = [] {};

  void serve() override { onServe(); }
  [[nodiscard]] bool newMessage() const override { return message; }
  void read(MainController& mCtrl) override {
    ++reads;
    mCtrl.getData().saveModeId(id());
    mCtrl.getData().saveSetPoints({.orderId = static_cast<std::uint16_t>(reads)});
  }
  void changeMode(MainController& mCtrl) override {
    ++changes;
    mCtrl.changeMode(*next);
  }
  [[nodiscard]] bool stopOrdered() const override { return stop; }
};

/// A state that records the steps of the cycle. After each read, `next` is the present state.
class FakeState final : public OperationState {
 public:
  explicit FakeState(OperationStateId id) : OperationState(id) {}

  std::vector<std::string> steps;
  OperationState* next = this;
  std::function<void()> atWrite = [] {};

  void control(MainController& mCtrl) override {
    steps.emplace_back("control");
    OperationState::control(mCtrl);
  }
  void write(MainController& mCtrl) override {
    steps.emplace_back("write");
    OperationState::write(mCtrl);
    atWrite();
  }

 private:
  void actionWithMsg(MainController& mCtrl, Mode& md) override {
    steps.emplace_back("read with message");
    md.read(mCtrl);
    mCtrl.changeOpState(*next);
  }
  void actionNoMsg(MainController& mCtrl) override {
    steps.emplace_back("read without message");
    mCtrl.changeOpState(*next);
  }
};

/// A main controller with a link to the PC, one control system that records its orders, and fake
/// modes and states.
class ControllerFixture : public testing::Test {
 protected:
  ControllerFixture() {
    port.setClock(time);
    systems.add(system);
    second.onServe = [this] { connection.service(); };
  }

  // Connects the PC over the serial line. Serves only the link, without a control cycle.
  void connect() {
    port.arrive(pc.hello());
    serveLink();
    port.arrive(
        pc.confirm(scenario::welcomeOf(scenario::bodies(port.takeSent()).at(0)).value().session));
    serveLink();
  }

  // Serves the link in a cycle whose clock pulse has the present time.
  void serveLink() {
    connection.beginCycle(time.now());
    connection.service();
  }

  // Returns the only report on the serial line.
  scenario::PcReport sentReport() {
    const std::vector<scenario::Bytes> sent = scenario::bodies(port.takeSent());
    EXPECT_EQ(sent.size(), 1U);
    return scenario::reportOf(sent.at(0)).value();
  }

  FakeTimebase time;
  host::HostSerialPort port;
  host::HostScheduler scheduler;
  host::HostThread thread{scheduler, 1};
  SerialReader pcReader;
  struct Link {
    Link()
        : handshaking(connected, disconnected),
          disconnected(handshaking),
          connected(handshaking, disconnected) {}
    Handshaking handshaking;
    Disconnected disconnected;
    Connected connected;
  } link;
  StartRecord start;
  PcConnection connection{port, pcReader, link.disconnected, start};
  host::HostWatchdog watchdog{time};
  scenario::PcSender pc;
  ControlData data;
  ControlSystemPool systems;
  SpySystem system;
  FakeMode first{ModeId::RC};
  FakeMode second{ModeId::PC};
  FakeState state{OperationStateId::Working};
  FakeState other{OperationStateId::Reconnecting};
  std::array<Mode*, 2> modes{&first, &second};
  MainController controller{{.thread = thread,
                             .timebase = time,
                             .data = data,
                             .systems = systems,
                             .connection = connection,
                             .watchdog = watchdog,
                             .initialState = state,
                             .initialMode = first,
                             .modes = modes}};
};

}  // namespace wr::test
