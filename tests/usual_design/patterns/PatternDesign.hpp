#pragma once

#include <array>

#include "construction/ControlSystemBuilder.hpp"
#include "construction/ControlSystemPoolBuilder.hpp"
#include "construction/MainControllerBuilder.hpp"
#include "construction/RobotDirector.hpp"
#include "construction/WheelSystemBuilder.hpp"
#include "services/Pipe.hpp"
#include "units/quantities.hpp"
#include "usual_design/Devices.hpp"

namespace wr {

/// Main Control and one wheel, composed of the modules of the robot as in each product.
class PatternDesign {
 public:
  explicit PatternDesign(const Devices& devices);
  PatternDesign(const PatternDesign&) = delete;
  PatternDesign& operator=(const PatternDesign&) = delete;

  void start();

  // The interrupts call these functions.
  void cycleTimerExpired();
  void tickTimerExpired();
  void hallEdge();
  void remoteControlEdge();

  // The main loop calls this function after each interrupt. In this design, the threads do the
  // work.
  void run() {}

 private:
  Pipe<Velocity> rcVelocity_;
  Pipe<Angle> rcDirection_;
  WheelSystemBuilder wheelBuilder_;
  std::array<ControlSystemBuilder*, 1> systems_;
  ControlSystemPoolBuilder poolBuilder_;
  MainControllerBuilder controllerBuilder_;
  RobotDirector director_;
};

}  // namespace wr
