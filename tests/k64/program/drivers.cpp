// A program for the K64 that uses the drivers without a robot. Bytes from the PC are orders to the
// devices of the board. Each answer is a sequence of 16-bit numbers, low byte first.

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

#include "devices/EdgeInput.hpp"
#include "k64/core.hpp"
#include "k64/start_up/handlers.hpp"
#include "k64/start_up/platform.hpp"
#include "services/Command.hpp"
#include "services/Pipe.hpp"

namespace wr {

namespace {

struct Samples {
  std::uint16_t count;
  std::uint16_t last;
};

std::array<AnalogInput*, kWheelCount + 1> analogInputs{
    &platform::wheels[0].current, &platform::wheels[1].current, &platform::wheels[2].current,
    &platform::wheels[3].current, &platform::steeringAngle};
std::array<Samples, analogInputs.size()> samples{};

constexpr std::size_t kHallCount = 2 * kWheelCount;
std::array<EdgeInput*, kHallCount + 3> edgeInputs{
    &platform::wheels[0].hallA, &platform::wheels[0].hallB, &platform::wheels[1].hallA,
    &platform::wheels[1].hallB, &platform::wheels[2].hallA, &platform::wheels[2].hallB,
    &platform::wheels[3].hallA, &platform::wheels[3].hallB, &platform::rcVelocityPin,
    &platform::rcDirectionPin,  &platform::rcEnablePin};
std::array<std::uint16_t, edgeInputs.size()> edges{};

std::array<std::uint16_t, 8> runs{};  // numbers of the threads, in the order in which they ran
std::size_t runCount = 0;

K64Uart secondPort(K64Uart::Port::Uart4, platform::timebase);

void note(std::uint16_t thread) {
  runs[runCount % runs.size()] = thread;
  ++runCount;
}

class WheelBody final : public Command {
 public:
  explicit WheelBody(std::uint16_t wheel) : wheel_(wheel) {}
  void execute() override { note(wheel_); }

 private:
  std::uint16_t wheel_;
};

std::array<WheelBody, kWheelCount> wheelBodies{WheelBody(0), WheelBody(1), WheelBody(2),
                                               WheelBody(3)};

// Posts the threads of all wheels, beginning with the last wheel.
class MainBody final : public Command {
 public:
  MainBody() = default;
  void execute() override {
    for (std::size_t wheel = kWheelCount; wheel != 0; --wheel) {
      platform::wheels[wheel - 1].thread.post();
    }
    note(kWheelCount);
  }
};

MainBody mainBody;

void answer(std::uint16_t number) {
  const std::array bytes{static_cast<std::uint8_t>(number & 0xFFU),
                         static_cast<std::uint8_t>(number >> 8U)};
  platform::pcPort.write(bytes);
}

void countEdges(std::size_t begin, std::size_t end) {
  for (std::size_t input = begin; input < end; ++input) {
    edges[input] =
        static_cast<std::uint16_t>(edges[input] + (edgeInputs[input]->acknowledge() ? 1 : 0));
  }
}

// A value of 32 words, which is passed through a pipe. The values are numbered, and each word of a
// value contains the number of this value.
struct Numbered {
  std::array<std::uint32_t, 32> words{};
};

// Passes numbers through a pipe and checks the received numbers. Each side may interrupt the other
// side.
class Handover {
 public:
  Handover() = default;

  void write() {
    if (working_) {
      ++interruptions_;
    }
    const bool outer = begin();
    ++next_;
    Numbered value;
    value.words.fill(next_);
    pipe_.write(value, Instant(next_));
    end(outer);
  }

  void read() {
    if (working_) {
      ++interruptions_;
    }
    const bool outer = begin();
    const auto got = pipe_.read();
    end(outer);
    if (!got) {
      return;
    }
    const std::uint32_t number = got->value.words[0];
    const bool whole =
        got->at == Instant(number) &&
        std::ranges::all_of(got->value.words, [&](std::uint32_t word) { return word == number; });
    torn_ += whole ? 0 : 1;
    older_ += whole && number < newest_ ? 1 : 0;
    newest_ = std::max(newest_, number);
    ++reads_;
  }

  void answerCounts() const;

 private:
  bool begin() {
    const bool outer = !working_;
    working_ = true;
    std::atomic_signal_fence(std::memory_order_seq_cst);
    return outer;
  }

  void end(bool outer) {
    std::atomic_signal_fence(std::memory_order_seq_cst);
    working_ = working_ && !outer;
  }

  Pipe<Numbered> pipe_;
  volatile bool working_ = false;
  std::uint32_t next_ = 0;
  std::uint32_t newest_ = 0;
  std::uint32_t interruptions_ = 0;
  std::uint32_t torn_ = 0;
  std::uint32_t older_ = 0;
  std::uint32_t reads_ = 0;
};

Handover toMain;       // the interrupt of the Hall sensors writes this pipe
Handover toInterrupt;  // the interrupt of the Hall sensors reads this pipe

void Handover::answerCounts() const {
  for (const std::uint32_t count : {interruptions_, torn_, older_, newest_, reads_}) {
    answer(static_cast<std::uint16_t>(std::min<std::uint32_t>(count, 0xFFFF)));
  }
}

// Reads one pipe and writes the other pipe for a duration, while edges of Hall sensors cause
// interrupts.
void handOver(Microseconds duration) {
  const Instant begin = platform::timebase.now();
  while (platform::timebase.now() - begin < duration) {
    toMain.read();
    toInterrupt.write();
  }
}

struct Pulse {
  Instant rose;
  std::uint16_t width;  // [us]
};
std::array<Pulse, 3> pulses{};

// Serves an input of the remote control. Then keeps the processor busy for the longest time that
// the interrupt handler of any product may need.
void servePulse(std::size_t input) {
  constexpr std::uint32_t kRounds = 400;
  countEdges(kHallCount + input, kHallCount + input + 1);
  Pulse& pulse = pulses[input];
  const Instant now = platform::rcEdgeTime.now();
  if (edgeInputs[kHallCount + input]->level()) {
    pulse.rose = now;
  } else {
    pulse.width = static_cast<std::uint16_t>((now - pulse.rose).count());
  }
  for (std::uint32_t round = 0; round < kRounds; ++round) {
    asm volatile("nop");
  }
}

void takeSamples() {
  for (std::size_t input = 0; input < analogInputs.size(); ++input) {
    if (const auto value = analogInputs[input]->sample()) {
      samples[input] = {static_cast<std::uint16_t>(samples[input].count + 1), *value};
    }
    // A sample is already requested. Therefore this call has no effect.
    static_cast<void>(analogInputs[input]->sample());
  }
}

void obey(std::uint8_t order, std::uint8_t first, std::uint8_t second, std::uint8_t third) {
  switch (order) {
    case 'P':  // a channel and its duty cycle in 0.01 %
      platform::wheels[first].pwm.set(DutyCycle(static_cast<std::int16_t>(third << 8U | second)));
      break;
    case 'A':
      for (const Samples& row : samples) {
        answer(row.count);
        answer(row.last);
      }
      break;
    case 'E':
      for (const std::uint16_t count : edges) {
        answer(count);
      }
      break;
    case 'L':
      for (const EdgeInput* input : edgeInputs) {
        answer(input->level() ? 1 : 0);
      }
      answer(platform::leftEnd.level() ? 1 : 0);
      answer(platform::rightEnd.level() ? 1 : 0);
      answer(platform::emergencyStopContact.level() ? 1 : 0);
      break;
    case 'W':
      for (const Pulse& pulse : pulses) {
        answer(pulse.width);
      }
      break;
    case 'H':  // duration in ms
      handOver(milliseconds(first));
      break;
    case 'N':
      toMain.answerCounts();
      toInterrupt.answerCounts();
      break;
    case 'T':
      platform::mainThread.post();
      break;
    case 'R':
      for (const std::uint16_t thread : runs) {
        answer(thread);
      }
      answer(static_cast<std::uint16_t>(runCount));
      break;
    default:  // returns the number of bytes that were lost at the second port
      answer(secondPort.lostBytes());
      break;
  }
}

// Returns the byte that two letters of an order encode. Orders consist of letters, because the port
// drops a zero byte that follows another zero byte.
std::uint8_t number(std::uint8_t high, std::uint8_t low) {
  return static_cast<std::uint8_t>((high - 'A') << 4U | (low - 'A'));
}

void echo() {
  std::array<std::uint8_t, 64> bytes{};
  const std::size_t count =
      secondPort.read(std::span(bytes).first(std::min(bytes.size(), secondPort.free())));
  secondPort.write(std::span(bytes).first(count));
}

}  // namespace

}  // namespace wr

void tickTimerInterrupt() {
  wr::platform::tickTimer.acknowledge();
  wr::takeSamples();
  wr::platform::allowEdges();
  wr::finishStores();
}

void cycleTimerInterrupt() {
  wr::platform::watchdog.refresh();
  wr::platform::cycleTimer.acknowledge();
  wr::finishStores();
}

void hallSensorInterrupt() {
  wr::countEdges(0, wr::kHallCount);
  wr::toMain.write();
  wr::toInterrupt.read();
  wr::finishStores();
}

void remoteControlInterrupt() {
  const wr::platform::RcEdges edges = wr::platform::enterRcInterrupt();
  if (edges.velocity) {
    wr::servePulse(0);
  }
  if (edges.direction) {
    wr::servePulse(1);
  }
  if (edges.enable) {
    wr::servePulse(2);
  }
  wr::finishStores();
}

void secondPortInterrupt() {
  wr::secondPort.serve();
  wr::finishStores();
}

namespace wr {

void runRobot() {
  platform::startDevices();
  secondPort.start();
  for (EdgeInput* input : edgeInputs) {
    input->start();
  }
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    platform::wheels[wheel].thread.start(wheelBodies[wheel]);
  }
  platform::mainThread.start(mainBody);
  platform::enableInterrupts();
  K64Thread::enable(kSecondPortLine, kInterruptPriority);
  K64Thread::enable(kSecondPortErrorLine, kInterruptPriority);
  platform::cycleTimer.start(milliseconds(100));
  platform::tickTimer.start(milliseconds(1));
  std::array<std::uint8_t, 7> order{};
  std::size_t count = 0;
  for (;;) {
    count += platform::pcPort.read(std::span(order).subspan(count));
    if (count == order.size()) {
      obey(order[0], number(order[1], order[2]), number(order[3], order[4]),
           number(order[5], order[6]));
      count = 0;
    }
    echo();
    sleepUntilInterrupt();
  }
}

}  // namespace wr
