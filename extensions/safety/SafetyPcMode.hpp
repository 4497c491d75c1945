#pragma once

#include <array>

#include "communication/pc_connection/PcConnection.hpp"
#include "communication/serialization/Reader.hpp"
#include "main_control/operation_modes/BasicMode.hpp"
#include "main_control/operation_modes/PC.hpp"
#include "safety/PersistentStop.hpp"
#include "safety/StopMemory.hpp"

namespace wr {

/// @brief The reading mode of a robot that has safety functions and receives orders only from the
/// PC.
/// @datatype
struct SafetyPcMode {
  /// @brief Connects the mode to the PC.
  /// @param pcReader reader of the PC's orders
  /// @param connection link to the PC
  /// @param memory memory of a stop order of the PC
  SafetyPcMode(Reader& pcReader, PcConnection& connection, StopMemory& memory)
      : basicPc(pcReader),
        persistentStop(basicPc, memory),
        pc(persistentStop, pc, connection),
        all{&pc} {}

  BasicMode basicPc;              ///< reads orders of the PC
  PersistentStop persistentStop;  ///< keeps a stop order of the PC in force after a reset
  PC pc;                          ///< the reading mode PC
  std::array<Mode*, 1> all;       ///< the only reading mode
};

}  // namespace wr
