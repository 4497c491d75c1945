#pragma once

#include <cstdint>

namespace wr {

/// @brief Meaning of a field of an order, a report or a Welcome.
/// @datatype
enum class FieldName : std::uint8_t {
  OrderId,           ///< number of the order, assigned by its sender
  Steering,          ///< set-point of the steering
  WheelQuantity,     ///< quantity of a wheel set-point: velocity, voltage or current
  WheelValue,        ///< set-point of a wheel
  SentAt,            ///< time of the sender's clock when the order was sent
  Commands,          ///< bits that order to stop and to acknowledge
  Cycle,             ///< number of the control cycle since start
  Time,              ///< time of the clock pulse
  OperationState,    ///< operation state after the read step of the cycle
  ReadingMode,       ///< reading mode after the read step of the cycle
  Source,            ///< source of the set-points in force
  Flags,             ///< bits for the conditions of this control cycle, such as stop and overrun
  SteeringPosition,  ///< measured position of the steering
  WheelVelocity,     ///< measured velocity of a wheel
  WheelCurrent,      ///< measured current of a wheel
  WheelPosition,     ///< measured position of a wheel
  Measured,          ///< one bit for each measured value: 1 if the value is valid
  WheelTension,      ///< applied voltage of a wheel
  Turn,              ///< applied turn direction of the steering
  Applied,           ///< one bit for each applied value: 1 if the value is valid
  Overruns,          ///< count of control cycles that overran
  LostBytes,         ///< count of bytes that the serial port lost
  Damaged,           ///< count of frames with bad COBS, a bad CRC or too few bytes
  TooLong,           ///< count of frames that were too long
  UnknownVersion,    ///< count of frames of another protocol version
  UnknownType,       ///< count of received frames of an unknown type
  WrongLength,       ///< count of frames with a payload that is too short
  OutOfRange,        ///< count of orders with a field out of range
  Unexpected,        ///< count of frames that the state of the connection did not expect
  SequenceGaps,      ///< count of gaps in the sequence numbers
  ReportsNotSent,    ///< count of reports that were dropped because the serial port had no space
  SteeringState,     ///< state of the steering
  SteeringEnds,      ///< bits of the end stops that the steering has reached
  CutOffs,           ///< bits of the wheels whose overcurrent trip has acted
  BlindWheels,       ///< bits of the wheels that have voltage but no motion feedback
  RejectedEdges,     ///< count of implausible Hall edges of a wheel
  ReportCost,        ///< processor cycles from a clock pulse until the report of the same control
                     ///< cycle was sent
  AwakeCost,         ///< processor cycles without sleep between two clock pulses
  StartCost,         ///< processor cycles from a clock pulse until the firmware began the control
                     ///< cycle
  Inhibit,           ///< reason why the robot does not follow the set-points
  StopCause,         ///< cause of a protective stop
  StopWheel,         ///< number of the wheel that the cause concerns
  StopSources,       ///< bits of the sources that order a stop
  StaleOrders,       ///< count of orders that were repeated, or overtaken by a newer frame
  Session,           ///< number of the session
  FirmwareVersion,   ///< major, minor or patch number of the firmware version
  BuildId,           ///< one character of the build id
  CyclePeriod,       ///< period of the control cycle
  WaitingCycles,     ///< the constant N: after N failed reads in a row, the last waiting state
                     ///< begins
  ResetCause,        ///< cause of the last reset
  FaultKind,         ///< fault that ended the firmware before this start
  FaultNumber,       ///< number whose meaning depends on the kind of fault
  FaultAddress,      ///< address of the instruction at which the firmware ended
  LowestVersion,     ///< lowest protocol version that the firmware accepts
  HighestVersion,    ///< highest protocol version that the firmware accepts
  SchemaHash         ///< hash of the layouts of all payloads
};

/// @brief Name of one field.
/// @datatype
struct Field {
  FieldName name{};  ///< meaning of the field; it is the same for each wheel, and for each
                     ///< character of the build id
};

}  // namespace wr
