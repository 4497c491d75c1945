#pragma once

#include <array>

#include "communication/pc_connection/PcConnection.hpp"
#include "communication/serialization/Reader.hpp"
#include "main_control/operation_modes/BasicMode.hpp"
#include "main_control/operation_modes/PC.hpp"
#include "safety/PersistentStop.hpp"
#include "safety/StopMemory.hpp"

namespace wr {

/// @brief The reading mode of a robot with safety functions that receives orders only from the PC.
/// @datatype
struct SafetyPcMode {
  /// @brief Constructs the mode.
  /// @param pcReader reader of the PC's orders
  /// @param connection link to the PC
  /// @param memory memory of the PC's stop
  SafetyPcMode(Reader& pcReader, PcConnection& connection, StopMemory& memory)
      : basicPc(pcReader),
        persistentStop(basicPc, memory),
        pc(persistentStop, pc, connection),
        all{&pc} {}

  BasicMode basicPc;              ///< reads orders of the PC
  PersistentStop persistentStop;  ///< keeps the stop of the PC during a reset
  PC pc;                          ///< mode of the PC
  std::array<Mode*, 1> all;       ///< the mode
};

}  // namespace wr
