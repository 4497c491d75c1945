#pragma once

#include <cstdint>

namespace wr {

/// @brief Meaning of a field of an order, a report or a welcome.
/// @datatype
enum class FieldName : std::uint8_t {
  OrderId,           ///< number of the order
  Steering,          ///< set-point of the steering
  WheelQuantity,     ///< quantity of the set-point of a wheel
  WheelValue,        ///< set-point of a wheel
  SentAt,            ///< time of the sender's clock when the order was sent
  Commands,          ///< bits for stop and acknowledge
  Cycle,             ///< number of the cycle
  Time,              ///< time of the clock pulse
  OperationState,    ///< operation state after the read
  ReadingMode,       ///< reading mode after the read
  Source,            ///< source of the set-points
  Flags,             ///< conditions of this cycle
  SteeringPosition,  ///< measured position of the steering
  WheelVelocity,     ///< measured velocity of a wheel
  WheelCurrent,      ///< measured current of a wheel
  WheelPosition,     ///< measured position of a wheel
  Measured,          ///< bits of the valid measurements
  WheelTension,      ///< applied voltage of a wheel
  Turn,              ///< applied turn direction
  Applied,           ///< bits of the valid applied values
  Overruns,          ///< count of cycles that overran
  LostBytes,         ///< count of bytes that the serial port lost
  Damaged,           ///< count of damaged frames
  TooLong,           ///< count of frames that were too long
  UnknownVersion,    ///< count of frames of another protocol version
  UnknownType,       ///< count of frames of a type that is not received
  WrongLength,       ///< count of frames whose payload is too short
  OutOfRange,        ///< count of orders with a field out of range
  Unexpected,        ///< count of frames that the connection did not expect
  SequenceGaps,      ///< count of gaps in the sequence numbers
  ReportsNotSent,    ///< count of reports that were not sent
  SteeringState,     ///< state of the steering
  SteeringEnds,      ///< bits of the end stops that the steering has reached
  CutOffs,           ///< wheels whose driver the overcurrent trip switched off
  BlindWheels,       ///< wheels with voltage but without Hall edges
  RejectedEdges,     ///< count of Hall edges of a wheel that were rejected
  ReportCost,        ///< processor cycles from a clock pulse to the report of its cycle
  AwakeCost,         ///< processor cycles without sleep between two clock pulses
  StartCost,         ///< processor cycles from a clock pulse to the start of its cycle
  Inhibit,           ///< reason why the set-points are not followed
  StopCause,         ///< cause of a protective stop
  StopWheel,         ///< wheel that the cause concerns
  StopSources,       ///< sources that order stop
  StaleOrders,       ///< count of orders that were not newer than the previous order
  Session,           ///< number of the session
  FirmwareVersion,   ///< major, minor and patch number
  BuildId,           ///< character of the build id
  CyclePeriod,       ///< period of the control cycle
  WaitingCycles,     ///< the constant N of the operation states
  ResetCause,        ///< cause of the last reset
  FaultKind,         ///< fault that ended the firmware before this start
  FaultNumber,       ///< number with a meaning that depends on the kind of fault
  FaultAddress,      ///< address of the instruction at which the firmware ended
  LowestVersion,     ///< lowest version of the protocol that is accepted
  HighestVersion,    ///< highest version of the protocol that is accepted
  SchemaHash         ///< hash of the layout of all payloads
};

/// @brief Name of one field.
/// @datatype
struct Field {
  FieldName name{};  ///< meaning of the field; fields of several wheels or elements share it
};

}  // namespace wr
