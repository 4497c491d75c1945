#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "functions/HallVelocity.hpp"
#include "functions/SampledCurrent.hpp"
#include "sensing/current/CntSensor.hpp"
#include "sensing/current/ValueCollector.hpp"
#include "sensing/instants/BasicCollector.hpp"
#include "sensing/instants/CountCollector.hpp"
#include "sensing/velocity/SensorCollector.hpp"
#include "sensing/velocity/VelSensor.hpp"
#include "wheel_control/ControlledWheel.hpp"
#include "wheel_control/orders/ApplyControl.hpp"
#include "wheel_control/orders/HaltWheel.hpp"
#include "wheel_control/orders/ReadCurrent.hpp"
#include "wheel_control/orders/ReadVelocity.hpp"
#include "wheel_control/orders/RegisterPosition.hpp"

namespace wr::test {

/// A wheel with controller, sensors and orders, composed as in the robot. The test triggers the
/// interrupts.
class SensedWheel : public ControlledWheel {
 public:
  BasicCollector basic;
  CountCollector count{basic};
  SensorCollector edges{count};
  HallVelocity hallVelocity;
  VelSensor velSensor{edges, hallVelocity, time, velocities};
  ValueCollector samples{wheel.cutOff(), time};
  SampledCurrent sampledCurrent;
  CntSensor cntSensor{samples, sampledCurrent, currents};
  RegisterPosition registerPosition{velSensor};
  ReadVelocity readVelocity{velSensor, controller};
  ReadCurrent readCurrent{cntSensor, controller};
  ApplyControl applyControl{controller, wheel};
  HaltWheel haltWheel{controller, wheel};

  /// Sets the zero point of the current sensor and the first levels of the Hall sensors.
  SensedWheel() {
    for (int sample = 0; sample < ValueCollector::kZeroSamples; ++sample) {
      samples.collect(kMiddle);
    }
    edges.collect(0, time.now());
  }

  /// Advances the time by 100 ms. A turning wheel has an edge every 10 ms. The current has a sample
  /// every 1 ms.
  void pass(bool turning, std::uint16_t raw) {
    for (int tick = 0; tick < 100; ++tick) {
      time.advance(milliseconds(1));
      samples.collect(raw);
      if (turning && tick % 10 == 9) {
        constexpr std::array<std::uint8_t, 4> kForwards{0, 1, 3, 2};
        ++turned;
        edges.collect(kForwards.at(turned % kForwards.size()), time.now());
      }
    }
  }

  static constexpr std::uint16_t kMiddle = 2048;          // no current
  static constexpr std::uint16_t kTwoAmperes = 2296;      // 0.1 V/A; 3.3 V are 4096 steps
  static constexpr std::uint16_t kTooMuch = 2048 + 2000;  // 16.1 A

  std::size_t turned = 0;
};

}  // namespace wr::test
