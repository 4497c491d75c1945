#pragma once

#include <array>

#include "communication/pc_connection/PcConnection.hpp"
#include "communication/serialization/Reader.hpp"
#include "main_control/operation_modes/BasicMode.hpp"
#include "main_control/operation_modes/PC.hpp"
#include "main_control/operation_modes/RC.hpp"
#include "safety/EnableSwitch.hpp"
#include "safety/PersistentStop.hpp"
#include "safety/SteeringGeometry.hpp"
#include "safety/StopMemory.hpp"

namespace wr {

/// @brief The reading modes of a robot with safety functions that receives orders from the PC and the remote control.
/// @datatype
struct SafetyModes {
  /// @brief Constructs the modes.
  /// @param pcReader reader of the PC's orders
  /// @param rcReader reader of the remote control's orders
  /// @param connection link to the PC
  /// @param signals signals of the remote control
  /// @param memory memory of the PC's stop
  SafetyModes(Reader& pcReader, Reader& rcReader, PcConnection& connection,
              const EnableSwitch::Signals& signals, StopMemory& memory)
      : basicPc(pcReader),
        basicRc(rcReader),
        persistentStop(basicPc, memory),
        geometry(basicRc),
        enableSwitch(geometry, signals),
        pc(persistentStop, rc, connection),
        rc(enableSwitch, pc),
        all{&rc, &pc} {}

  BasicMode basicPc;              ///< reads orders of the PC
  BasicMode basicRc;              ///< reads orders of the remote control
  PersistentStop persistentStop;  ///< keeps the stop of the PC during a reset
  SteeringGeometry geometry;      ///< computes the velocity of each wheel
  EnableSwitch enableSwitch;      ///< adds a stop to the remote control
  PC pc;                          ///< mode of the PC
  RC rc;                          ///< mode of the remote control
  std::array<Mode*, 2> all;       ///< both modes
};

}  // namespace wr
