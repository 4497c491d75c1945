#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <vector>

#include "sim/board_robot/BoardSession.hpp"
#include "sim/emulator/Event.hpp"
#include "sim/emulator/Image.hpp"
#include "sim/faults/Random.hpp"
#include "sim/programs/CampaignOptions.hpp"
#include "sim/programs/Program.hpp"
#include "sim/scenario/FrameFields.hpp"
#include "sim/scenario/PcFrames.hpp"

namespace wr::programs {

namespace {

using std::chrono::nanoseconds;

constexpr std::uint32_t kPulse = 16 + board_robot::BoardSession::kPulseInterrupt;
constexpr std::uint32_t kMainThread = 16 + 64;  // the interrupt of the main thread
constexpr int kCycles = 60;                     // cycles of a drive: 6 s
constexpr int kConnected = 3;                   // cycles after which the PC is connected
constexpr int kNeutral = 12;                    // cycles with neutral orders, which arm the robot
constexpr int kLineBytes = 1152;   // bytes that the serial line of the PC transfers in 100 ms
constexpr int kMostPayload = 200;  // greatest number of payload bytes of a frame
constexpr int kUpsets = 6;
// Greatest set-points: for a wheel 300.0 rpm, 3 V or 3 A
constexpr int kSetPoint = scenario::limitOf("Velocity");
constexpr int kSteering = scenario::limitOf("steering_set_point");

// The inputs whose edges cause interrupts. They are the Hall sensors and the signals of the remote
// control.
struct EdgePin {
  char port;
  int number;
};
constexpr std::array<EdgePin, 11> kEdgePins{{{'D', 0},
                                             {'D', 1},
                                             {'D', 2},
                                             {'D', 3},
                                             {'D', 4},
                                             {'D', 5},
                                             {'D', 6},
                                             {'D', 7},
                                             {'B', 18},
                                             {'B', 19},
                                             {'B', 23}}};
constexpr nanoseconds kCyclePeriod = std::chrono::milliseconds(100);
constexpr nanoseconds kNoiseBefore = std::chrono::milliseconds(2);  // noise before the clock pulse
constexpr nanoseconds kNoiseAfter = std::chrono::milliseconds(8);
// Duration of a level of a noisy input [us]. Levels of at most 240 us cause so many edges in each
// tick that the limit of FR-201 is reached.
constexpr int kShortestLevel = 20;
constexpr int kLongestLevel = 240;

// A robot with random orders, random bytes from the PC, and random surroundings.
class LoadedRobot {
 public:
  LoadedRobot(const CampaignOptions& settings, std::uint64_t seed)
      : random_(seed),
        style_(random_.below(kStyles)),
        noisy_(random_.below(4) == 0),
        session_(emulator::readImage(settings.image), optionsOf(settings)) {
    session_.onEvent([this](const emulator::Event& event) { measure(event); });
    session_.robot().setSeed(static_cast<std::uint32_t>(seed));
    session_.remoteControl().setCoincident(random_.below(2) == 0);
  }

  void cycle(int number) {
    connect(number);
    order(number);
    if (number > kConnected) {
      load();
    }
    if (number > kNeutral && random_.below(4) == 0) {
      upset();
    }
    if (noisy_ && number > kConnected && random_.below(2) == 0) {
      disturb();
    }
    if (!session_.runThroughPulse()) {
      throw std::runtime_error(session_.finding().value().text);
    }
    listen();
  }

  // Returns the longest time from a clock pulse to the end of the main thread in this drive.
  [[nodiscard]] nanoseconds longest() const { return longest_; }

  // Returns true if the inputs have noise in the drive.
  [[nodiscard]] bool noisy() const { return noisy_; }

 private:
  // The kinds of bytes that the PC sends to keep its serial line busy.
  enum Style : std::uint32_t {
    Quiet,
    Hellos,
    KeepAlives,
    Orders,
    Shortest,
    SmallFrames,
    BigFrames,
    Bytes
  };
  static constexpr std::uint32_t kStyles = Bytes + 1;

  static emulator::Options optionsOf(const CampaignOptions& settings) {
    emulator::Options options;
    options.elf = settings.elf;
    options.timing = emulator::Timing::SlowFlash;
    options.resetsAreFindings = false;
    return options;
  }

  void measure(const emulator::Event& event) {
    if (event.kind == emulator::Event::Kind::LineRaised && event.number == kPulse) {
      pulse_ = event.at;
    } else if (event.kind == emulator::Event::Kind::ExceptionLeft && event.number == kMainThread) {
      longest_ = std::max(longest_, event.at - pulse_);
    }
  }

  void connect(int number) {
    if (number == 0) {
      session_.send(pc_.hello());
    } else if (number == 1 && connection_ >= 0) {
      session_.send(pc_.confirm(static_cast<std::uint8_t>(connection_)));
    }
  }

  void order(int number) {
    if (number > kNeutral && random_.below(3) == 0) {
      const auto quantity = static_cast<std::uint8_t>(random_.below(3));
      for (scenario::PcOrder::Wheel& wheel : order_.wheels) {
        wheel = {.quantity = quantity,
                 .value = static_cast<std::int16_t>(random_.between(-kSetPoint, kSetPoint))};
      }
      order_.steering = static_cast<std::int16_t>(random_.between(-kSteering, kSteering));
      order_.stop = random_.below(20) == 0;
      order_.acknowledge = random_.below(5) == 0;
    }
    ++order_.id;
    session_.send(pc_.order(order_));
  }

  // Sends bytes that fill the serial line until the next cycle.
  void load() {
    if (style_ == Quiet) {
      return;
    }
    scenario::Bytes bytes;
    while (bytes.size() < static_cast<std::size_t>(kLineBytes)) {
      const scenario::Bytes frame = nextFrame();
      bytes.insert(bytes.end(), frame.begin(), frame.end());
    }
    session_.send(bytes);
  }

  scenario::Bytes nextFrame() {
    switch (style_) {
      case Hellos:
        return pc_.hello();
      case KeepAlives:
        return pc_.keepAlive();
      case Orders:
        ++order_.id;
        return pc_.order(order_);
      case Shortest:
        return {static_cast<std::uint8_t>(random_.between(1, 255)), 0};
      default:
        return someFrame();
    }
  }

  // Generates edges at all inputs around the next clock pulse. In one tick, the edges of an input
  // cause only a limited number of interrupts (FR-201). In each tick, each input reaches this
  // limit.
  void disturb() {
    const nanoseconds pulse =
        session_.pulses().empty() ? session_.now() : session_.pulses().back() + kCyclePeriod;
    for (const EdgePin& pin : kEdgePins) {
      bool level = false;
      nanoseconds at = std::max<nanoseconds>(pulse - kNoiseBefore, session_.now());
      while (at < pulse + kNoiseAfter) {
        session_.board.driveAt(at, pin.port, pin.number, level);
        level = !level;
        at += std::chrono::microseconds(random_.between(kShortestLevel, kLongestLevel));
      }
    }
  }

  scenario::Bytes someFrame() {
    scenario::Bytes content(random_.below(style_ == SmallFrames ? 4 : kMostPayload));
    std::ranges::generate(content,
                          [this] { return static_cast<std::uint8_t>(random_.below(256)); });
    return style_ == Bytes ? content
                           : pc_.frame(static_cast<std::uint8_t>(random_.below(256)), content);
  }

  void upset() {
    plant::Robot& robot = session_.robot();
    const std::size_t wheel = random_.below(plant::kWheels);
    switch (random_.below(kUpsets)) {
      case 0:
        robot.setFault(plant::Fault::HallLosses, wheel, random_.below(2) == 0,
                       random_.between(1, 60));
        break;
      case 1:
        robot.setFault(plant::Fault::Block, wheel, random_.below(2) == 0);
        break;
      case 2:
        robot.setFault(plant::Fault::Current, wheel, random_.below(3) == 0);
        break;
      case 3:
        robot.setSlope(random_.between(-10, 10));
        break;
      case 4:
        session_.remoteControl().setEnable(static_cast<plant::EnablePosition>(random_.below(5)));
        break;
      default:
        session_.remoteControl().set(plant::Sticks{.velocity = random_.between(-100, 100) / 100.0,
                                                   .steering = random_.between(-100, 100) / 100.0});
    }
  }

  void listen() {
    for (const std::uint8_t byte : session_.takeSent()) {
      if (byte != 0) {
        line_.push_back(byte);
        continue;
      }
      const scenario::FrameBody body = scenario::bodyOf(line_);
      line_.clear();
      if (!body.damage.empty() || body.bytes.empty()) {
        continue;
      }
      if (const auto welcome = scenario::welcomeOf(body.bytes)) {
        connection_ = welcome->session;
      }
    }
  }

  faults::Random random_;
  std::uint32_t style_;
  bool noisy_;
  board_robot::BoardSession session_;
  scenario::PcSender pc_;
  scenario::PcOrder order_;
  scenario::Bytes line_;
  int connection_ = -1;
  nanoseconds pulse_{};
  nanoseconds longest_{};
};

Exit run(const CampaignOptions& settings) {
  faults::Random seeds(settings.seed);
  for (int number = 0; number < settings.count; ++number) {
    const std::uint32_t seed = seeds.below(1U << 31U);
    LoadedRobot robot(settings, seed);
    for (int cycle = 0; cycle < kCycles; ++cycle) {
      robot.cycle(cycle);
    }
    std::printf("{\"seed\": %u, \"noise\": %s, \"longest_ns\": %lld}\n", seed,
                robot.noisy() ? "true" : "false", static_cast<long long>(robot.longest().count()));
  }
  return Exit::Done;
}

}  // namespace

}  // namespace wr::programs

int main(int count, char** arguments) try {
  wr::programs::CampaignOptions settings;
  CLI::App app(
      "Runs random drives of the robot with a raw firmware image on the virtual K64. The PC keeps "
      "its\n"
      "serial line busy. For each drive, prints a line of JSON with the longest time from a clock\n"
      "pulse to the end of the main thread.",
      "weeding_robot_loads");
  settings.addTo(app);
  return wr::programs::runProgram(app, count, arguments,
                                  [&settings] { return wr::programs::run(settings); });
} catch (const std::exception& error) {
  std::fprintf(stderr, "weeding_robot_loads: %s\n", error.what());
  return EXIT_FAILURE;
} catch (...) {
  return EXIT_FAILURE;
}
