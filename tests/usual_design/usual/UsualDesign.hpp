#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "communication/framing/FrameDecoder.hpp"
#include "communication/framing/FrameEncoder.hpp"
#include "communication/serialization/ReportData.hpp"
#include "services/Pipe.hpp"
#include "units/Measurements.hpp"
#include "units/SetPoints.hpp"
#include "units/quantities.hpp"
#include "usual_design/Devices.hpp"
#include "wheel_control/algorithms/PiRegulator.hpp"

namespace wr {

/// Main Control and one wheel in the baseline design. The design is one class with variables for
/// the state, and conditions on these variables. Interrupts collect values. The main loop runs a
/// control cycle at each clock pulse.
class UsualDesign {
 public:
  explicit UsualDesign(const Devices& devices);
  UsualDesign(const UsualDesign&) = delete;
  UsualDesign& operator=(const UsualDesign&) = delete;

  void start();

  // The interrupts call these functions.
  void cycleTimerExpired();
  void tickTimerExpired();
  void hallEdge();
  void remoteControlEdge();

  // The main loop calls this function after each interrupt.
  void run() {
    if (pulses_.load(std::memory_order_relaxed) != begun_) {
      cycle();
    }
  }

 private:
  enum class Mode : std::uint8_t { Rc = 0, Pc = 1, None = 255 };
  enum class Link : std::uint8_t { Disconnected, Handshaking, Connected };

  struct Pulse {
    std::uint32_t number = 0;
    std::uint32_t awake = 0;  // count of processor cycles
  };
  struct HallRecord {
    std::optional<Instant> last;
    std::int32_t count = 0;
    std::uint32_t unclear = 0;
    std::uint32_t reversals = 0;
  };
  enum class Trip : std::uint8_t { None, Tripped, Decaying, Braking, Off };
  struct CurrentRecord {
    std::uint32_t sum = 0;
    std::uint32_t number = 0;
    Instant at{};
  };
  struct RcChannel {
    std::optional<Instant> rise;
    std::optional<Microseconds> period;
    std::optional<Instant> read;  // time of the value that was read last
    Pipe<std::int32_t> value;
  };

  // Runs one control cycle.
  void cycle();
  void readOrder();
  [[nodiscard]] bool pcOrderIsNew() const;
  void readRcOrder(const Stamped<std::int32_t>& velocity, const Stamped<std::int32_t>& direction);
  [[nodiscard]] static bool isNew(const std::optional<Stamped<std::int32_t>>& value,
                                  const std::optional<Instant>& read, Instant now);
  void control();
  void sendReport();

  // Link to the PC.
  void servePc();
  void checkSilence(Instant at);
  void receive(const Frame& frame);
  [[nodiscard]] bool isNewer(std::uint8_t sequence) const;
  [[nodiscard]] bool accept(const Frame& frame);
  [[nodiscard]] bool takeOrder(std::span<const std::uint8_t> payload);
  void sendWelcome();
  bool send(FrameType type, std::span<const std::uint8_t> payload);

  // Signals of the remote control.
  void takeRcEdge(RcChannel& channel, bool rising, std::int32_t fullDeflection);

  // The wheel.
  void takeHallPhase();
  void takeCurrentSample(std::int32_t raw);
  void measureVelocity(const HallRecord& record, Instant now);
  [[nodiscard]] Velocity bounded(Velocity value, std::int32_t edges, Microseconds elapsed) const;
  [[nodiscard]] std::optional<Velocity> velocityOf(std::int32_t edges, Microseconds elapsed) const;
  void measureCurrent();
  void followSetPoint(const WheelSetPoint& setPoint, HallCount position, WheelMeasurements& wheel);
  [[nodiscard]] Tension calculate(const WheelSetPoint& setPoint, Velocity velocity,
                                  Current current);
  [[nodiscard]] Tension velocityTension(std::int16_t setPoint, Velocity velocity, Current current);
  [[nodiscard]] Tension currentTension(std::int16_t setPoint, Velocity velocity, Current current);
  void apply(Tension demand, Velocity velocity);
  void lower();
  [[nodiscard]] bool plausible(const HallRecord& record) const;
  void release(const WheelMeasurements& wheel);
  void releaseTrip();
  void watchMotion(const WheelSetPoint& setPoint, HallCount position, Current current);
  void watchReversal(const WheelSetPoint& setPoint, Tension demand);
  [[nodiscard]] bool doubtful(Velocity velocity, Current current);
  void driverOff();
  void resetAlgorithms();
  void setTension(Tension tension);
  void enableDriver(Trip permitted);

  Devices devices_;

  // Control cycle.
  std::atomic<std::uint32_t> pulses_{0};
  Pipe<Pulse> pulse_;
  std::uint32_t begun_ = 0;
  std::uint32_t cycle_ = 0;
  std::uint16_t overruns_ = 0;
  Instant clockPulse_{};
  bool orderRead_ = false;
  bool held_ = false;
  bool overran_ = false;
  CycleCosts costs_{};
  std::optional<std::uint32_t> awakeAtPulse_;
  std::uint32_t reportCost_ = 0;

  // Reading of orders.
  Mode mode_ = Mode::Rc;
  Mode source_ = Mode::None;
  std::uint8_t countNoMsg_ = 0;
  std::optional<SetPoints> setPoints_;

  // Link to the PC.
  Link link_ = Link::Disconnected;
  FrameDecoder decoder_;
  FrameEncoder encoder_;
  LinkCounts counts_{};
  Instant receivedAt_{};
  Instant lastAccepted_{};
  Instant welcomed_{};
  bool welcomeDue_ = false;
  bool offered_ = false;
  bool sentFirst_ = false;
  std::uint8_t session_ = 0;
  std::uint8_t newestReceived_ = 0;
  std::uint8_t nextSent_ = 0;
  SetPoints pcOrder_{};
  Instant pcOrderAt_{};
  bool pcOrderUnread_ = false;
  bool pcStop_ = false;        // the PC has ordered a stop and has not released it
  bool stopReceived_ = false;  // the present cycle received a stop
  bool stop_ = false;          // a stop is in force in the present cycle

  // Remote control.
  RcChannel rcVelocity_;
  RcChannel rcDirection_;

  // Hall sensors.
  std::optional<std::uint8_t> phase_;
  std::int8_t direction_ = 0;
  Instant lastEdge_{};
  HallRecord hall_;
  Pipe<HallRecord> hallRecord_;

  // Current sensor.
  std::int32_t zeroSamples_ = 0;
  std::int32_t zero_ = 0;
  bool zeroPlausible_ = false;
  std::int32_t leastSample_ = 0;
  std::int32_t greatestSample_ = 0;
  std::uint32_t tooHigh_ = 0;
  CurrentRecord current_;
  Pipe<CurrentRecord> currentRecord_;

  // Measured velocity and current, with their times.
  bool standing_ = true;
  Instant measuredAt_{};
  std::optional<Instant> seenEdge_;
  std::int32_t seenCount_ = 0;
  HallRecord seenHall_;
  Velocity velocity_{};
  Velocity writtenBefore_{};
  std::optional<Instant> velocityAt_;
  CurrentRecord seenCurrent_;
  Current meanCurrent_{};
  std::optional<Instant> currentAt_;

  // Control of the wheel.
  WheelQuantity quantity_ = WheelQuantity::Velocity;
  PiRegulator velocityRegulator_;
  PiRegulator currentRegulator_;
  std::optional<std::int64_t> model_;
  std::optional<Velocity> velocityBefore_;
  std::int16_t velocitySetPoint_ = 0;
  std::int16_t currentSetPoint_ = 0;
  std::optional<Tension> applied_;
  bool backwards_ = false;
  std::uint8_t slowCycles_ = 0;
  std::uint8_t brakedCycles_ = 0;
  HallCount stillPosition_{};
  std::int32_t effort_ = 0;
  std::uint8_t waitingCycles_ = 0;
  bool blind_ = false;
  bool reversalLate_ = false;
  Velocity usedVelocity_{};
  std::optional<Tension> velocityApplied_;
  std::uint8_t doubts_ = 0;
  std::atomic<Trip> trip_{Trip::None};

  Measurements measurements_{};
};

}  // namespace wr
