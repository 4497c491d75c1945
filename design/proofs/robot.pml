// The parts of the robot that are not state machines of design/fsm: the latches of the stops,
// arming at neutral, the protective stop, and the sequence of a control cycle. The state machines
// are generated and put in front of this file.
//
// A round is a period of 100 ms: a control cycle, a missed cycle, or a reset; then two ticks of the steering.
// Above each inline, "code:" names the elements of the firmware that it models; "environment" chooses inputs
// at random; "observer" only records. A number that is a constant of the firmware has the name of
// this constant.

#define WAITING_CYCLES 4  // SystemConstants::waitingCycles
#define ORDER_ROUNDS 2    // SystemConstants::orderLifetime / SystemConstants::cyclePeriod
#define NEUTRAL_ORDERS 5  // kNeutral / SystemConstants::cyclePeriod

// ---- inputs of a round ----------------------------------------------------------

#define RC_OFF 1
#define RC_STOP 2
#define RC_PC 3
#define RC_PC_DEFLECTED 4
#define RC_NEUTRAL 5
#define RC_DRIVES 6
#define RC_UNATTENDED 7
#define RC_SILENT 8
byte rc;          // the remote control in this round
byte rc_order;    // content of its order in this round
bool rc_acknowledges;
byte frame;       // the frame of the PC that is received now, 0: none
bool emergency_stop;
bool wheel_fails;
byte reset;  // 0: none

#define HELLO 1
#define CONFIRM 2
#define WRONG_CONFIRM 3
#define KEEP_ALIVE 4
#define ORDER_NEUTRAL 5
#define ORDER_MOVING 6
#define ORDER_STOP 7
#define ORDER_ACKNOWLEDGE 8
#define ORDER_ACKNOWLEDGE_MOVING 9
#define DROPPED_ORDER 10
#define DROPPED_STOP 11

#define stops (frame == ORDER_STOP || frame == DROPPED_STOP)

#define RESET_WATCHDOG 1
#define RESET_POWER 2
#define RESET_CLOCK 3
#define RESET_MEMORY 4

// ---- state of the firmware ------------------------------------------------------

#define NONE 0
#define NEUTRAL 1
#define MOVING 2
#define ACKNOWLEDGE 3
#define ACKNOWLEDGE_MOVING 4
byte order;         // content of the newest order of the PC
bool unread;        // the order can be read
byte age;           // age of the order, in rounds
byte set_points;    // in force
bool read_now;      // an order was read in this cycle
byte failed_reads;  // in a row
bool accepted;      // a frame was accepted in this round
bool welcome_due;
bool pc_stop;     // the reader of the PC stores a stop
bool pc_stop_now; // the reader of the PC received a stop in this cycle
bool pc_kept;     // a stop from before the reset
bool stop_memory; // the memory that a reset does not clear
bool rc_stopped = true;
byte neutral_orders;
bool latched;  // protective stop; a reset does not clear its memory
bool halted = true;
bool moves;
bool follow;        // the steering has to follow its target
bool release;       // the target is newer than the state of the steering
bool stopped_now;   // the stops as they were recorded before the read
bool missed;        // no control cycle in this round
bool abandoned;     // the steering had no new target for 300 ms

// ---- observed at the end of each round: used by the properties ------------

bool pulse;  // changes in each round
bool cycle_ran;
bool commands_rc = true;  // reading mode
bool commands_pc;
bool connected;
bool handshaking;
bool working = true;
bool reconnecting;
bool order_read;
bool neutral_read;
bool five_silent_reads;
bool pc_silent = true;
bool pc_orders;
bool rc_silent = true;
bool rc_orders;
bool stop_of_pc;
bool stop_of_rc = true;
bool rc_released;  // the enable switch is not at stop, and the stick is centred
bool pc_neutral;   // a neutral order of the PC without stop was accepted or read in this round
bool pc_ordered_stop;
bool at_rest = true;
bool drives;
bool armed;
bool protected;
bool acknowledges;
bool contact_open;
bool part_fails;
bool steering_on;
bool steering_follows;
bool steering_off = true;
bool steering_fault;
bool steering_ordered;
bool orders_ceased;
bool was_reset;
bool power_on;
bool reset_with_stop;
bool reset_with_protection;
bool mode_changed;
bool second_passed;
bool handshake_late;

// Of the present round, for the observer.
bool heard_stop;
bool heard_neutral;
bool mode_left;
bool second_now;
bool late_now;
bool stop_kept;
bool protection_kept;
bool rc_ordered;
bool rc_centred;
bool contact_seen;
bool part_failed;
bool pc_sent;
bool pc_ordered;
bool acknowledged;
bool ran;

// ---- environment ----------------------------------------------------------------

// environment
inline choose_rc() {
  if
  :: rc = RC_OFF; printf("event rc-off\n")
  :: rc = RC_STOP; printf("event rc-stop\n")
  :: rc = RC_PC; printf("event rc-pc\n")
  :: rc = RC_PC_DEFLECTED; printf("event rc-pc-deflected\n")
  :: rc = RC_NEUTRAL; printf("event rc-neutral\n")
  :: rc = RC_DRIVES; printf("event rc-drives\n")
  :: rc = RC_UNATTENDED; printf("event rc-unattended\n")
  :: rc = RC_SILENT; printf("event rc-silent\n")
  fi
}

// environment
inline choose_acknowledge() {
  if
  :: rc_acknowledges = false
  :: reading_modes == reading_modes_RC && rc_order != NONE && !rc_stopped ->
     rc_acknowledges = true;
     printf("event rc-acknowledges\n")
  fi
}

// environment
inline choose_parts() {
  if
  :: emergency_stop = false
  :: emergency_stop = true; printf("event emergency-stop\n")
  fi;
  if
  :: wheel_fails = false
  :: !emergency_stop -> wheel_fails = true; printf("event wheel-fails\n")
  fi
}

// environment
inline choose_frame() {
  if
  :: frame = 0
  :: frame = HELLO; printf("event pc-hello\n")
  :: frame = CONFIRM; printf("event pc-confirm\n")
  :: frame = WRONG_CONFIRM; printf("event pc-wrong-confirm\n")
  :: frame = KEEP_ALIVE; printf("event pc-keepalive\n")
  :: frame = ORDER_NEUTRAL; printf("event pc-order-neutral\n")
  :: frame = ORDER_MOVING; printf("event pc-order-moving\n")
  :: frame = ORDER_STOP; printf("event pc-order-stop\n")
  :: frame = ORDER_ACKNOWLEDGE; printf("event pc-order-acknowledge\n")
  :: frame = ORDER_ACKNOWLEDGE_MOVING; printf("event pc-order-acknowledge-moving\n")
  :: frame = DROPPED_ORDER; printf("event pc-order-dropped\n")
  :: frame = DROPPED_STOP; printf("event pc-order-stop-dropped\n")
  fi
}

// observer
inline hear_rc() {
  rc_centred = rc == RC_PC || rc == RC_NEUTRAL || rc == RC_SILENT;
  rc_ordered = rc == RC_NEUTRAL || rc == RC_DRIVES || rc == RC_UNATTENDED
}

// observer
inline hear_pc() {
  pc_sent = pc_sent || frame != 0;
  heard_stop = heard_stop || stops
}

// ---- the remote control ---------------------------------------------------------

// code: EnableSwitch::serve, EnableSwitch::takePosition, EnableSwitch::unattended, EnableSwitch::newMessage
inline serve_rc() {
  if
  :: rc == RC_OFF || rc == RC_STOP || rc == RC_UNATTENDED -> rc_stopped = true
  :: rc == RC_PC || rc == RC_NEUTRAL || rc == RC_SILENT -> rc_stopped = false
  :: else
  fi;
  if
  :: rc == RC_NEUTRAL -> rc_order = NEUTRAL
  :: rc == RC_DRIVES || rc == RC_UNATTENDED -> rc_order = MOVING
  :: else -> rc_order = NONE
  fi;
  rc = 0
}

// code: RC::read, EnableSwitch::read, EnableSwitch::advanceSequence
inline read_rc() {
  if
  :: rc_acknowledges -> set_points = (rc_order == NEUTRAL -> ACKNOWLEDGE : ACKNOWLEDGE_MOVING)
  :: else -> set_points = rc_order
  fi;
  rc_acknowledges = false
}

// ---- the PC link ----------------------------------------------------------------

// environment
inline choose_time() {
  if
  :: skip
  :: !accepted && pc_mcu_connection == pc_mcu_connection_Connected ->
     second_now = true;
     printf("event second-without-frame\n")
  :: !welcome_due && pc_mcu_connection == pc_mcu_connection_Handshaking ->
     late_now = true;
     printf("event second-without-confirm\n")
  fi
}

// code: Connected::checkTime, Handshaking::checkTime, PcConnection::silence, PcConnection::sinceWelcome
inline check_time() {
  if
  :: second_now -> pc_mcu_connection_step(pc_mcu_connection_on_1_s_without_accepted_frame); forget_order()
  :: else
  fi;
  if
  :: late_now -> pc_mcu_connection_step(pc_mcu_connection_on_1_s_without_Confirm)
  :: else
  fi
}

// code: PcConnection::dropOrder, SerialReader::discard
inline forget_order() {
  if
  :: pc_mcu_connection_did == pc_mcu_connection_does_drop_newest_order ||
     pc_mcu_connection_did == pc_mcu_connection_does_drop_newest_order_Welcome ->
     unread = false; age = 0; order = NONE
  :: else
  fi
}

#define good_order (frame >= ORDER_NEUTRAL && frame <= ORDER_ACKNOWLEDGE_MOVING)
#define neutral_order (frame == ORDER_NEUTRAL || frame == ORDER_ACKNOWLEDGE)

// code: SerialReader::heedStop
inline heed_stop() {
  if
  :: stops -> pc_stop = true; pc_stop_now = true
  :: else
  fi
}

// code: PcConnection::takeOrder, SerialReader::offer, OrderMessage::neutral
inline take_order() {
  if
  :: pc_mcu_connection_did == pc_mcu_connection_does_keep_as_newest_order ->
     accepted = true;
     unread = true;
     age = 0;
     pc_stop = (frame == ORDER_STOP || (pc_stop && !neutral_order));
     heard_neutral = heard_neutral || neutral_order;
     if
     :: frame == ORDER_NEUTRAL -> order = NEUTRAL
     :: frame == ORDER_ACKNOWLEDGE -> order = ACKNOWLEDGE
     :: frame == ORDER_ACKNOWLEDGE_MOVING -> order = ACKNOWLEDGE_MOVING
     :: else -> order = MOVING
     fi
  :: else
  fi
}

// code: PcConnection::answer, PcConnection::handle, PcConnection::offered, Handshaking::confirm
inline answer_frame() {
  if
  :: frame == 0
  :: frame == HELLO ->
     pc_mcu_connection_step(pc_mcu_connection_on_Hello);
     forget_order();
     accepted = true; welcome_due = true; pc_ordered = false
  :: frame == CONFIRM || frame == WRONG_CONFIRM ->
     // A correct Confirm has the number of the offered session, whose Welcome was sent in an
     // earlier cycle.
     pc_mcu_connection_if_session_is_the_offered_one = (frame == CONFIRM && !welcome_due);
     accepted = accepted || (pc_mcu_connection_if_session_is_the_offered_one &&
                             pc_mcu_connection == pc_mcu_connection_Handshaking);
     pc_mcu_connection_step(pc_mcu_connection_on_Confirm);
     pc_mcu_connection_if_session_is_the_offered_one = false
  :: frame == KEEP_ALIVE ->
     accepted = accepted || pc_mcu_connection == pc_mcu_connection_Connected;
     pc_mcu_connection_step(pc_mcu_connection_on_KeepAlive)
  :: else ->
     heed_stop();
     pc_ordered = pc_ordered || good_order;
     pc_mcu_connection_if_fresh_and_in_range = good_order;
     pc_mcu_connection_step(pc_mcu_connection_on_Order);
     pc_mcu_connection_if_fresh_and_in_range = false;
     take_order()
  fi;
  pc_mcu_connection_did = 0;
  frame = 0
}

// code: PC::serve, PcConnection::service, PcConnection::sendWelcome, PersistentStop::serve, SerialReader::beginCycle
inline serve_pc() {
  pc_stop_now = false;
  choose_time();
  d_step { check_time() };
  choose_frame();
  d_step { hear_pc(); answer_frame() };
  choose_frame();
  d_step { hear_pc(); answer_frame() };
  choose_time();
  d_step {
    check_time();
    stop_memory = pc_stop || pc_stop_now || pc_kept;
    welcome_due = false;
    accepted = false;
    pc_mcu_connection_did = 0
  }
}

#define pc_message (pc_mcu_connection == pc_mcu_connection_Connected && unread && age < ORDER_ROUNDS)

// code: PC::read, BasicMode::read, PersistentStop::read, SerialReader::finish
inline read_pc() {
  set_points = order;
  unread = false;
  order = NONE;
  age = 0;
  if
  :: (set_points == NEUTRAL || set_points == ACKNOWLEDGE) && !pc_stop && !pc_stop_now ->
     pc_kept = false; heard_neutral = true
  :: else
  fi
}

// code: SerialReader::available, PcConnection::beginCycle
inline age_order() {
  if
  :: unread && age + 1 < ORDER_ROUNDS -> age++
  :: unread && age + 1 >= ORDER_ROUNDS -> unread = false; age = 0; order = NONE
  :: else
  fi
}

// ---- the control cycle ----------------------------------------------------------

// code: OperationState::read, Mode::newMessage, Waiting::actionNoMsg, Reconnecting::actionNoMsg, Mode::changeMode
inline read_order() {
  read_now = (reading_modes == reading_modes_RC -> rc_order != NONE : pc_message);
  operation_states_if_failed_reads_below_N_1 = failed_reads < WAITING_CYCLES - 1;
  operation_states_if_failed_reads_is_N_1 = failed_reads >= WAITING_CYCLES - 1;
  reading_modes_if_in_Reconnecting = operation_states == operation_states_Reconnecting;
  if
  :: read_now ->
     failed_reads = 0;
     operation_states_step(operation_states_on_newMessage);
     assert(operation_states_did == operation_states_does_read);
     if
     :: reading_modes == reading_modes_RC -> read_rc()
     :: else -> read_pc()
     fi;
     reading_modes_step(reading_modes_on_newMessage)
  :: else ->
     failed_reads = (failed_reads <= WAITING_CYCLES -> failed_reads + 1 : failed_reads);
     mode_left = reading_modes_if_in_Reconnecting;
     operation_states_step(operation_states_on_noMessage);
     reading_modes_step(reading_modes_on_noMessage)
  fi;
  rc_order = NONE;
  operation_states_did = 0;
  operation_states_if_failed_reads_below_N_1 = false;
  operation_states_if_failed_reads_is_N_1 = false;
  reading_modes_if_in_Reconnecting = false
}

// code: RobotStage::stand, WheelSystem::halt, DirSystem::halt
inline robot_stands() { halted = true; moves = false; follow = false }

// code: RobotStage::follow, WheelSystem::apply, DirSystem::apply
inline robot_follows() { halted = false; moves = set_points == MOVING; follow = true }

// code: ProtectiveStop::examine, ProtectiveStop::examineContact, ProtectiveStop::latch, ContactWatch::opened
inline examine() {
  if
  :: emergency_stop || wheel_fails || steering_controller_states == steering_controller_states_DirFault ->
     latched = true
  :: else
  fi
}

// code: ProtectiveStop::stand, Arming::stand, Arming::disarm, SetPointRamp::stand
inline stages_stand() { robot_stands(); examine() }

// code: ProtectiveStop::follow
inline protective_stop_follows() {
  if
  :: latched -> robot_stands()
  :: else ->
     robot_follows();
     examine();
     if
     :: latched -> robot_stands()
     :: else
     fi
  fi
}

// code: Arming::follow, Arming::armed
inline arming_follows() {
  if
  :: neutral_orders >= NEUTRAL_ORDERS -> protective_stop_follows()
  :: else ->
     if
     :: read_now -> neutral_orders = (set_points == NEUTRAL -> neutral_orders + 1 : 0)
     :: else
     fi;
     stages_stand()
  fi
}

// code: ProtectiveStop::recover, Arming::recover, DirSystem::release, ContactWatch::opened
inline stages_recover() {
  acknowledged = true;
  neutral_orders = 0;
  latched = emergency_stop;
  robot_stands();
  release = true
}

#define stop_in_force (rc_stopped || pc_stop || pc_stop_now || pc_kept)

// code: MainController::applyControl, MainController::noteStop, Reconnecting::control, SafeSystem::activate
inline control() {
  release = false;
  if
  :: operation_states == operation_states_Reconnecting || stopped_now || set_points == NONE ||
     set_points == ACKNOWLEDGE_MOVING ->
     neutral_orders = 0;
     stages_stand()
  :: else ->
     if
     :: set_points == ACKNOWLEDGE -> stages_recover()
     :: else -> arming_follows()
     fi
  fi;
  stopped_now = false;
  contact_seen = emergency_stop;
  part_failed = wheel_fails;
  emergency_stop = false;
  wheel_fails = false
}

// code: MainController::cycle, MainController::serveSources
inline cycle() {
  choose_rc();
  d_step {
    ran = true;
    missed = false;
    abandoned = false;
    age_order();
    hear_rc();
    serve_rc()
  };
  serve_pc();
  choose_acknowledge();
  d_step {
    stopped_now = stop_in_force;
    read_order()
  };
  choose_parts();
  d_step { control() }
}

// ---- missed cycles and resets ---------------------------------------------------

// environment
inline miss_cycle() {
  printf("event cycle-missed\n");
  d_step {
    age_order();
    if
    :: missed -> abandoned = true
    :: else -> missed = true
    fi
  }
}

// code: RetainedStop::begin, RetainedProtection::begin, PersistentStop::PersistentStop, ProtectiveStop::ProtectiveStop
inline start_again() {
  d_step {
    if
    :: reset == RESET_POWER -> stop_memory = false; latched = false
    :: reset == RESET_CLOCK -> latched = true
    :: reset == RESET_MEMORY -> stop_memory = true; latched = true
    :: else
    fi;
    pc_kept = stop_memory;
    pc_stop = false; pc_stop_now = false; rc_stopped = true;
    unread = false; order = NONE; age = 0; set_points = NONE; failed_reads = 0;
    neutral_orders = 0; missed = false; abandoned = false; release = false;
    robot_stands();
    operation_states_step(machine_reset);
    reading_modes_step(machine_reset);
    pc_mcu_connection_step(machine_reset);
    steering_controller_states_step(machine_reset);
    steering_switch_step(machine_reset)
  }
}

// environment
inline choose_reset() {
  if
  :: reset = RESET_WATCHDOG; printf("event reset-watchdog\n")
  :: reset = RESET_POWER; printf("event reset-power\n")
  :: reset = RESET_CLOCK; printf("event reset-clock\n")
  :: reset = RESET_MEMORY; printf("event reset-memory\n")
  fi;
  d_step {
    stop_kept = reset != RESET_POWER && (stop_memory || reset == RESET_MEMORY);
    protection_kept = reset != RESET_POWER && (latched || reset == RESET_MEMORY || reset == RESET_CLOCK)
  }
}

// ---- the steering ---------------------------------------------------------------

#define steering_powered                                              \
  (steering_controller_states == steering_controller_states_DirHolding || \
   steering_controller_states == steering_controller_states_DirTurning)

// environment
inline choose_steering() {
  if
  :: steering_controller_states_if_no_turn_wanted_and_at_rest = true
  :: steering_controller_states == steering_controller_states_DirTurning ->
     skip  // no turn is wanted, but the motor still turns
  :: steering_powered ->
     steering_controller_states_if_position_older_than_20_ms_or_inconsistent = true;
     printf("event position-lost\n")
  :: steering_controller_states == steering_controller_states_DirTurning ->
     steering_controller_states_if_stalled = true;
     printf("event steering-stalls\n")
  :: steering_powered && follow && !abandoned ->
     steering_controller_states_if_the_algorithm_wants_a_turn = true
  fi
}

// code: DirController::tick, DirController::released, EnableSteering::execute, DisableSteering::execute
inline tick_steering() {
  choose_steering();
  d_step {
    steering_controller_states_if_order_to_follow_a_set_point = follow && !abandoned;
    steering_controller_states_if_order_older_than_300_ms = abandoned;
    steering_controller_states_if_order_to_acknowledge_given_after_the_fault = release;
    steering_controller_states_step(steering_controller_states_on_tick);
    if
    :: steering_controller_states_did == steering_controller_states_does_enable ->
       steering_switch_step(steering_switch_on_enable)
    :: steering_controller_states_did == steering_controller_states_does_disable ->
       steering_switch_step(steering_switch_on_disable)
    :: else
    fi;
    if
    :: steering_controller_states == steering_controller_states_DirFault -> release = false
    :: else
    fi;
    steering_controller_states_did = 0;
    steering_switch_did = 0;
    steering_controller_states_if_position_older_than_20_ms_or_inconsistent = false;
    steering_controller_states_if_stalled = false;
    steering_controller_states_if_the_algorithm_wants_a_turn = false;
    steering_controller_states_if_no_turn_wanted_and_at_rest = false;
    steering_controller_states_if_order_to_follow_a_set_point = false;
    steering_controller_states_if_order_older_than_300_ms = false;
    steering_controller_states_if_order_to_acknowledge_given_after_the_fault = false
  }
}

// ---- observation ----------------------------------------------------------------

// observer
inline observe() {
  d_step {
    pulse = !pulse;
    cycle_ran = ran;
    commands_rc = reading_modes == reading_modes_RC;
    commands_pc = reading_modes == reading_modes_PC;
    connected = pc_mcu_connection == pc_mcu_connection_Connected;
    handshaking = pc_mcu_connection == pc_mcu_connection_Handshaking;
    working = operation_states == operation_states_Working;
    reconnecting = operation_states == operation_states_Reconnecting;
    order_read = read_now;
    neutral_read = read_now && set_points == NEUTRAL;
    five_silent_reads = failed_reads > WAITING_CYCLES;
    pc_silent = !pc_sent;
    pc_orders = pc_ordered;
    rc_silent = !rc_ordered;
    rc_orders = rc_ordered;
    stop_of_pc = pc_stop || (pc_stop_now && ran) || pc_kept;
    stop_of_rc = rc_stopped;
    rc_released = rc_centred;
    pc_neutral = heard_neutral;
    pc_ordered_stop = heard_stop;
    at_rest = halted;
    drives = moves;
    armed = neutral_orders >= NEUTRAL_ORDERS;
    protected = latched;
    acknowledges = acknowledged;
    contact_open = contact_seen;
    part_fails = part_failed;
    steering_on = steering_switch == steering_switch_PoweredOn;
    steering_follows = steering_controller_states == steering_controller_states_DirHolding ||
                       steering_controller_states == steering_controller_states_DirTurning;
    steering_off = steering_controller_states == steering_controller_states_DirOff;
    steering_fault = steering_controller_states == steering_controller_states_DirFault;
    steering_ordered = follow;
    orders_ceased = abandoned;
    was_reset = reset != 0;
    power_on = reset == RESET_POWER;
    mode_changed = mode_left;
    second_passed = second_now;
    handshake_late = late_now;
    reset_with_stop = stop_kept;
    reset_with_protection = protection_kept;
    second_now = false; late_now = false; stop_kept = false; protection_kept = false;
    pc_sent = false; pc_ordered = false; heard_stop = false; heard_neutral = false; acknowledged = false;
    mode_left = false; rc_ordered = false; rc_centred = false; contact_seen = false; part_failed = false;
    reset = 0; ran = false; read_now = false
  }
}

active proctype robot() {
  do
  :: printf("round\n");
     if
     :: cycle()
     :: miss_cycle()
     :: choose_reset(); start_again()
     fi;
     tick_steering();
     tick_steering();
     observe()
  od
}
