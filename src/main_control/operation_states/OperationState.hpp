#pragma once

#include <cstdint>

namespace wr {

class MainController;
class Mode;

/// @brief The operation states. Their values are the numbers of the states in reports. N is
/// SystemConstants::waitingCycles().
/// @datatype
enum class OperationStateId : std::uint8_t {
  Working = 0,      ///< an order was read in this cycle
  Waiting = 1,      ///< 1 to N - 1 reads in a row failed
  WaitingN = 2,     ///< N reads in a row failed
  Reconnecting = 3  ///< more than N reads in a row failed
};

/// @brief A state of Main Control. The present state decides the actions of a cycle.
///
/// @function Reads orders with the same steps in every state. Subclasses define the reaction to a
/// message and the reaction to a missing message. In each cycle the state also orders the control
/// systems to follow their set-points or to hold, and sends the report.
///
/// @secret The steps in which every operation state reads an order.
///
/// @role{operation-states, State}
/// @role{read-orders, Abstract Class}
///
/// @patternapp{operation-states, State, Operation states of the main controller}
/// @why The steps of the main controller, and its orders to the control systems, depend on its
/// operation state.
/// @changes The behaviour of a state may change. A new state, for example with a warning after some
/// failed reads, needs a new subclass of this class. The other states do not change.
///
/// @patternapp{read-orders, Template Method, Read orders in the operation states}
/// @why Reading an order has the same steps in every state: check for a message, then execute one
/// action if there is a message, and another action if there is none. Only these two actions differ
/// from state to state.
/// @changes The two actions of one state may change. The steps do not change.
class OperationState {
 public:
  OperationState(const OperationState&) = delete;
  OperationState& operator=(const OperationState&) = delete;

  /// @brief Checks whether the present mode has a message. Then executes the action of this state
  /// for a message or for a missing message.
  /// @param mCtrl controller that reads
  /// @post The operation state of the controller is the state that results from this read.
  /// @satisfies FR-13
  /// @satisfies FR-15
  /// @isr{no}
  void read(MainController& mCtrl);

  /// @brief Calls MainController::applyControl(): the control systems follow the set-points that
  /// were read last, or are held while a stop is in force.
  /// @param mCtrl controller whose control systems get the order
  /// @satisfies FR-14
  /// @isr{no}
  virtual void control(MainController& mCtrl);

  /// @brief Sends the report of this cycle, with the number of this state.
  /// @param mCtrl controller that sends
  /// @satisfies FR-61
  /// @isr{no}
  virtual void write(MainController& mCtrl);

  /// @brief Returns the number of this state.
  /// @return number of the state, as in reports.
  /// @isr{yes}
  /// @satisfies FR-61
  [[nodiscard]] OperationStateId id() const;

 protected:
  /// @param id number of the state, as in reports
  explicit OperationState(OperationStateId id);
  ~OperationState() = default;

 private:
  virtual void actionWithMsg(MainController& mCtrl, Mode& md) = 0;
  virtual void actionNoMsg(MainController& mCtrl) = 0;

  OperationStateId id_;
};

}  // namespace wr
