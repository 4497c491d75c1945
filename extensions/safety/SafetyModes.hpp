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

/// @brief The reading modes of a robot that has safety functions and receives orders from the PC
/// and the remote control.
/// @datatype
struct SafetyModes {
  /// @brief Connects the modes to the sources of their orders.
  /// @param pcReader reader of the PC's orders
  /// @param rcReader reader of the remote control's orders
  /// @param connection link to the PC
  /// @param signals signals of the remote control
  /// @param memory memory of a stop order of the PC
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
  PersistentStop persistentStop;  ///< keeps a stop order of the PC in force after a reset
  SteeringGeometry geometry;      ///< computes the velocity of each wheel in a curve
  EnableSwitch enableSwitch;      ///< adds the enable switch to the remote control
  PC pc;                          ///< the reading mode PC
  RC rc;                          ///< the reading mode RC
  std::array<Mode*, 2> all;       ///< both reading modes
};

}  // namespace wr
