#include "sim/board_robot/BoardWires.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace wr::board_robot {

namespace {

constexpr std::uint32_t kSeed = 1;

struct Pin {
  char port;
  int number;
};

struct Input {
  int converter;
  int channel;
};

// The wires between the board and the robot. The page about bring-up lists the same wires.
struct WheelWires {
  int pwm;  // channel of FTM0
  Pin orientation;
  Pin enable;
  std::array<Pin, 2> hall;
  Input current;
};

constexpr std::array<WheelWires, plant::kWheels> kWheelWires{{
    {0, {'C', 16}, {'C', 5}, {{{'D', 0}, {'D', 1}}}, {0, 12}},
    {1, {'C', 17}, {'C', 7}, {{{'D', 2}, {'D', 3}}}, {0, 13}},
    {2, {'B', 9}, {'C', 11}, {{{'D', 4}, {'D', 5}}}, {1, 14}},
    {3, {'A', 2}, {'B', 20}, {{{'D', 6}, {'D', 7}}}, {1, 15}},
}};
constexpr Pin kStep{'C', 8};
constexpr Pin kLeft{'C', 9};
constexpr Pin kSteeringEnable{'C', 0};
constexpr Pin kLeftEnd{'A', 1};
constexpr Pin kRightEnd{'C', 18};
constexpr Input kAngle{1, 6};
constexpr std::array<Pin, 3> kRemoteControl{{{'B', 18}, {'B', 19}, {'B', 23}}};
constexpr Pin kEmergencyStop{'E', 25};

constexpr std::uint32_t eventNumber(Pin pin) {
  return static_cast<std::uint32_t>(32 * (pin.port - 'A') + pin.number);
}

bool levelOf(const emulator::VirtualBoard& board, Pin pin) {
  return board.pin(pin.port, pin.number);
}

}  // namespace

BoardWires::BoardWires(emulator::VirtualBoard& board) : physics(kSeed), board_(board) {
  for (const WheelWires& wires : kWheelWires) {
    for (const Pin& pin : wires.hall) {
      board_.drive(pin.port, pin.number, false);
    }
  }
  for (const Pin& pin : kRemoteControl) {
    board_.drive(pin.port, pin.number, false);
  }
  measure();
  board_.onTime(plant::Robot::kStep, [this] { step(); });
}

void BoardWires::take(const emulator::Event& event) {
  if (event.kind == emulator::Event::Kind::PinChanged && event.number == eventNumber(kStep) &&
      event.value == 1) {
    physics.setSteeringEnabled(levelOf(board_, kSteeringEnable));
    physics.steeringStep(levelOf(board_, kLeft));
  }
}

void BoardWires::step() {
  drive();
  for (const plant::HallEdge& edge : physics.step()) {
    const Pin pin = kWheelWires.at(edge.wheel).hall.at(edge.sensor);
    board_.driveAt(board_.now() + edge.offset, pin.port, pin.number, edge.level);
  }
  for (const plant::RcEdge& edge : remoteControl.step()) {
    const Pin pin = kRemoteControl.at(edge.channel);
    board_.driveAt(board_.now() + edge.offset, pin.port, pin.number, edge.level);
  }
  measure();
}

void BoardWires::drive() {
  for (std::size_t wheel = 0; wheel < kWheelWires.size(); ++wheel) {
    const WheelWires& wires = kWheelWires.at(wheel);
    physics.setWheel(wheel, {.duty = board_.pwmDuty(0, wires.pwm),
                             .backwards = levelOf(board_, wires.orientation),
                             .enabled = levelOf(board_, wires.enable)});
  }
}

void BoardWires::measure() {
  for (std::size_t wheel = 0; wheel < kWheelWires.size(); ++wheel) {
    const Input input = kWheelWires.at(wheel).current;
    board_.setAnalog(input.converter, input.channel, physics.currentVolts(wheel));
  }
  board_.setAnalog(kAngle.converter, kAngle.channel, physics.steeringVolts());
  board_.drive(kLeftEnd.port, kLeftEnd.number, physics.leftEnd());
  board_.drive(kRightEnd.port, kRightEnd.number, physics.rightEnd());
  board_.drive(kEmergencyStop.port, kEmergencyStop.number, physics.emergencyStopOpen());
}

}  // namespace wr::board_robot
