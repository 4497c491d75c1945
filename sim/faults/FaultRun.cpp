#include "sim/faults/FaultRun.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <utility>

#include "sim/emulator/Symbols.hpp"

namespace wr::faults {

namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr int kOrderPeriod = 100;   // ms
constexpr int kFirstOrder = 60;     // ms since the drive began; a time between two clock pulses
constexpr int kNeutralOrders = 10;  // number of neutral orders that arm the robot
constexpr int kStateEach = 100;     // ms
constexpr int kEnd = FaultRun::kLast + kLongestWindow + 200;  // ms
constexpr int kMissing = 300;  // ms without a report; these are three cycles
constexpr int kHelloEach = 250;
constexpr int kHellos = 4;
constexpr std::uint32_t kAwake =
    1500;  // us; the processor is awake during this time after a clock pulse
constexpr unsigned kSecondsOfCopy = 60;
constexpr int kFirstException = 16;
constexpr unsigned kStackPointer = 13;
constexpr unsigned kProgramCounter = 15;

// Returns the orders of a drive. These orders keep the robot away from its limits: the voltage
// stays low, and the steering stays near the middle.
std::vector<scenario::PcOrder> makeOrders(std::uint64_t seed) {
  Random random(seed);
  std::vector<scenario::PcOrder> orders;
  scenario::PcOrder order;
  while (orders.size() < static_cast<std::size_t>(kEnd) / kOrderPeriod + 1) {
    const int count = orders.empty() ? kNeutralOrders : random.between(4, 15);
    if (!orders.empty()) {
      const auto velocity = static_cast<std::int16_t>(random.between(-150, 200) * 10);
      std::ranges::for_each(order.wheels, [&](auto& wheel) { wheel.value = velocity; });
      order.steering = static_cast<std::int16_t>(random.between(-15, 15) * 100);
    }
    for (int i = 0; i < count; ++i) {
      ++order.id;
      order.sentAt += kOrderPeriod;
      orders.push_back(order);
    }
  }
  return orders;
}

emulator::Options options() {
  emulator::Options chosen;
  chosen.resetsAreFindings = false;
  chosen.faultsAreFindings = false;
  return chosen;
}

// Returns true if a report shows a fault that the report of the reference run does not show. The
// counters of the serial line are not compared.
bool reportsMore(const scenario::PcReport& report, const scenario::PcReport& reference) {
  constexpr std::uint8_t kSteeringFault = 3;
  return report.state != reference.state || report.inhibit != reference.inhibit ||
         report.stopCause != reference.stopCause || report.cutOffs != reference.cutOffs ||
         report.blindWheels != reference.blindWheels || report.held() != reference.held() ||
         (report.measured & reference.measured) != reference.measured ||
         report.steeringState == kSteeringFault;
}

// A result as a message. A copy of this process sends the message through a pipe.
struct Message {
  InjectedFault fault;
  int at = 0;
  std::uint32_t pc = 0;
  Verdict verdict;
  std::array<char, 160> stop{};
};

// A listener that checks each report once. Each call checks the new reports.
struct Listener {
  std::size_t read;

  [[nodiscard]] bool hears(const std::vector<scenario::PcReport>& reports,
                           const std::vector<scenario::PcReport>& reference) {
    bool reported = false;
    for (; read < reports.size(); ++read) {
      const scenario::PcReport& report = reports[read];
      const auto same = std::ranges::find(reference, report.cycle, &scenario::PcReport::cycle);
      reported = reported || same == reference.end() || reportsMore(report, *same);
    }
    return reported;
  }
};

class Hash {
 public:
  void add(std::uint64_t value) { state_ = (std::rotl(state_, 5) ^ value) * 0x9E3779B97F4A7C15U; }
  [[nodiscard]] std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0;
};

}  // namespace

/// A robot with a PC. The orders of the PC depend only on the seed and on the time.
class FaultRun::Robot {
 public:
  Robot(std::vector<std::uint8_t> image, std::uint64_t seed)
      : session(std::move(image), options()), orders_(makeOrders(seed)) {
    session.robot().setSeed(static_cast<std::uint32_t>(seed));
    session.onEvent([this](const emulator::Event& event) {
      const int line = static_cast<int>(event.number) - kFirstException;
      if (event.kind == emulator::Event::Kind::ExceptionEntered && line >= 0 &&
          !std::ranges::count(interrupts, line)) {
        interrupts.push_back(line);
      }
    });
    connect();
  }

  /// Advances the time by 1 ms. Returns false if a finding has stopped the board.
  bool step() {
    if (!silent && (now_ - kFirstOrder) % kOrderPeriod == 0 && now_ >= kFirstOrder) {
      send(pc_.order(orders_.at(static_cast<std::size_t>((now_ - kFirstOrder) / kOrderPeriod))));
    }
    ++now_;
    const bool runs = session.board.runUntil(begin_ + milliseconds(now_));
    listen();
    return runs;
  }

  /// Runs to the next clock pulse, and then for a given duration. The duration must end before the
  /// next order.
  void runPastPulse(microseconds duration) {
    constexpr int kPulse = board_robot::BoardSession::kPulseInterrupt;
    while (!session.board.runToInterrupt(kPulse, begin_ + milliseconds(now_ + 1))) {
      static_cast<void>(step());
    }
    const nanoseconds end = session.board.now() + duration;
    while (begin_ + milliseconds(now_ + 1) <= end) {
      static_cast<void>(step());
    }
    session.board.runUntil(end);
  }

  void hello() { send(pc_.hello()); }

  [[nodiscard]] int now() const { return now_; }

  [[nodiscard]] Outputs outputs() {
    Outputs all;
    const plant::Robot& robot = session.robot();
    for (std::size_t wheel = 0; wheel < all.drive.size(); ++wheel) {
      const plant::WheelDrive& drive = robot.drive(wheel);
      const double duty = drive.enabled ? drive.duty : 0;
      all.drive.at(wheel) = static_cast<float>(drive.backwards ? -duty : duty);
    }
    all.steering = static_cast<float>(robot.steeringDegrees());
    return all;
  }

  /// Returns a hash of the core registers, the memory in use, and three kinds of values of the
  /// plant: the positions and the currents of the motors, and the steering angle.
  [[nodiscard]] std::uint64_t state(const Places& places) {
    Hash hash;
    const emulator::VirtualBoard& board = session.board;
    for (unsigned number = 0; number <= kProgramCounter; ++number) {
      hash.add(board.core(number));
    }
    const auto addAll = [&](std::uint32_t address, std::uint32_t end) {
      for (; address < end; address += 4) {
        hash.add(board.word(address));
      }
    };
    addAll(board.core(kStackPointer) & ~3U, places.stackEnd);
    addAll(places.dataBegin, places.dataEnd);
    const plant::Robot& robot = session.robot();
    for (std::size_t wheel = 0; wheel < plant::kWheels; ++wheel) {
      hash.add(std::bit_cast<std::uint64_t>(robot.turns(wheel)));
      hash.add(std::bit_cast<std::uint64_t>(robot.currentAmperes(wheel)));
    }
    hash.add(std::bit_cast<std::uint64_t>(robot.steeringDegrees()));
    return hash.value();
  }

  board_robot::BoardSession session;
  std::vector<int> interrupts;
  std::vector<scenario::PcReport> reports;
  std::optional<scenario::PcWelcome> welcome;
  int reportedAt = 0;  // ms
  bool silent = false;
  int noise = 0;  // number of wrong bits in 1000 bits
  Random noiseOfLine{1};

 private:
  void connect() {
    session.board.runUntil(milliseconds(20));
    hello();
    session.runThroughPulse();
    listen();
    if (!welcome) {
      throw std::runtime_error(
          "the robot does not answer a Hello; check that the firmware image is an image of the "
          "robot");
    }
    send(pc_.confirm(welcome->session));
    session.runThroughPulse();
    listen();
    begin_ = session.board.now();
  }

  void send(std::vector<std::uint8_t> bytes) {
    for (std::uint8_t& byte : bytes) {
      for (unsigned bit = 0; bit < 8; ++bit) {
        if (noiseOfLine.below(1000) < static_cast<std::uint32_t>(noise)) {
          byte = static_cast<std::uint8_t>(byte ^ 1U << bit);
        }
      }
    }
    session.send(bytes);
  }

  void listen() {
    for (const std::uint8_t byte : session.takeSent()) {
      if (byte != 0) {
        line_.push_back(byte);
        continue;
      }
      const scenario::FrameBody body = scenario::bodyOf(line_);
      line_.clear();
      if (!body.damage.empty() || body.bytes.empty()) {
        continue;
      }
      if (const auto report = scenario::reportOf(body.bytes)) {
        reports.push_back(*report);
        reportedAt = now_;
      }
      if (const auto answer = scenario::welcomeOf(body.bytes)) {
        welcome = answer;
      }
    }
  }

  scenario::PcSender pc_;
  std::vector<scenario::PcOrder> orders_;
  std::vector<std::uint8_t> line_;
  nanoseconds begin_{};
  int now_ = 0;
};

FaultRun::FaultRun(std::vector<std::uint8_t> image, const std::filesystem::path& elf,
                   std::uint64_t seed)
    : image_(std::move(image)), seed_(seed), places_{} {
  const emulator::Symbols symbols(elf);
  places_ = {.codeBegin = symbols.addressOf("codeBegin"),
             .codeEnd = symbols.addressOf("codeEnd"),
             .dataBegin = symbols.addressOf("dataBegin"),
             .dataEnd = symbols.addressOf("bssEnd"),
             .stackEnd = symbols.addressOf("stackTop"),
             .flashEnd = static_cast<std::uint32_t>(image_.size()),
             .interrupts = {}};
  Robot robot(image_, seed_);
  while (robot.now() < kEnd) {
    if (!robot.step()) {
      throw std::runtime_error("without a fault: " + robot.session.finding().value().text);
    }
    reference_.push_back(robot.outputs());
    if (robot.now() % kStateEach == 0) {
      states_.push_back(robot.state(places_));
    }
  }
  reports_ = robot.reports;
  places_.interrupts = robot.interrupts;
  std::ranges::sort(places_.interrupts);
  const bool drives =
      std::ranges::any_of(reference_, [](const Outputs& one) { return !one.wheelsOff(); });
  if (!drives || reports_.back().inhibit != 0) {
    throw std::runtime_error(
        "the robot does not drive without a fault; choose another seed or another firmware image");
  }
}

Verdict FaultRun::runCopy(Robot& robot, const InjectedFault& fault, int at, bool silentPc) const {
  const int resets = robot.session.board.resets();
  Listener listener{robot.reports.size()};
  Observation seen;
  robot.silent = silentPc;
  robot.noise = noiseOf(fault);
  robot.noiseOfLine = Random(static_cast<std::uint64_t>(at));
  inject(fault, robot.session);
  int equal = 0;
  for (int ms = 0; ms < windowOf(fault); ++ms) {
    endIfDue(fault, ms, robot.session);
    if (!robot.step()) {
      throw std::runtime_error(robot.session.finding().value().id);
    }
    seen.outputs.push_back(robot.outputs());
    if (seen.resetAt == Observation::kNever && robot.session.board.resets() != resets) {
      seen.resetAt = ms;
    }
    const bool reported = listener.hears(robot.reports, reports_) ||
                          (!silentPc && robot.now() - robot.reportedAt > kMissing);
    if (seen.reportedAt == Observation::kNever && reported) {
      seen.reportedAt = ms;
    }
    if (passes(fault.kind) && robot.now() % kStateEach == 0) {
      const auto number = static_cast<std::size_t>(robot.now() / kStateEach - 1);
      equal = robot.state(places_) == states_.at(number) ? equal + 1 : 0;
      // The compared states do not include the devices of the microcontroller. If two successive
      // states are equal, this function assumes that the states of the devices are also equal.
      if (equal == 2) {
        break;
      }
    }
  }
  if (seen.resetAt == Observation::kNever && robot.now() - robot.reportedAt > kMissing) {
    robot.welcome.reset();
    robot.silent = true;
    robot.noise = 0;
    for (int ms = 0; ms < kHellos * kHelloEach && !robot.welcome; ++ms) {
      if (ms % kHelloEach == 0) {
        robot.hello();
      }
      if (!robot.step()) {
        throw std::runtime_error(robot.session.finding().value().id);
      }
    }
    seen.answers = robot.welcome.has_value() || robot.session.board.resets() != resets;
    seen.reportedAt = seen.answers ? seen.reportedAt : Observation::kNever;
  }
  return judge(seen, &reference_.at(static_cast<std::size_t>(at)));
}

// Runs a copy of the robot in a copy of this process.
Result FaultRun::observe(Robot& robot, const Choice& choice) const {
  Message message{};
  message.verdict.outcome = Outcome::Stopped;
  // If a byte arrives while the firmware restarts, a real board loses the byte. On the virtual
  // board, the byte causes a finding. After this finding, the copy with the fault therefore runs a
  // second time, with a silent PC.
  for (const bool silentPc : {false, true}) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) {
      throw std::runtime_error("cannot create a pipe");
    }
    const pid_t copy = fork();
    if (copy == 0) {
      alarm(kSecondsOfCopy);
      try {
        message.fault = choice(robot);
        message.at = robot.now();
        message.pc = robot.session.board.core(kProgramCounter);
        message.verdict = runCopy(robot, message.fault, message.at, silentPc);
      } catch (const std::exception& error) {
        std::strncpy(message.stop.data(), error.what(), message.stop.size() - 1);
      }
      const ssize_t written = write(ends[1], &message, sizeof message);
      _exit(written == sizeof message ? 0 : 1);
    }
    close(ends[1]);
    const ssize_t count = copy > 0 ? read(ends[0], &message, sizeof message) : -1;
    close(ends[0]);
    int status = 0;
    if (copy < 0 || waitpid(copy, &status, 0) != copy) {
      throw std::runtime_error("cannot create a process for the copy of the robot");
    }
    if (count != sizeof message) {
      message.verdict.outcome = Outcome::Stopped;
      std::strncpy(message.stop.data(), "simulator-ended", message.stop.size() - 1);
    }
    if (std::string_view(message.stop.data()) != "uart-overrun") {
      break;
    }
  }
  return {message.fault, message.at, message.pc, message.verdict, message.stop.data()};
}

void FaultRun::injectAll(int count, Random& random, std::optional<Kind> only,
                         const std::function<void(const Result&)>& take) {
  struct Plan {
    int at;
    Kind kind;
    std::uint32_t seed;
  };
  std::vector<Plan> plans;
  for (int i = 0; i < count; ++i) {
    const int at = random.between(kFirst, kLast - 1);
    const Kind kind = chooseKind(random);
    plans.push_back({at, only.value_or(kind), random.below(1U << 31U)});
  }
  std::ranges::stable_sort(plans, {}, &Plan::at);
  Robot robot(image_, seed_);
  for (const Plan& plan : plans) {
    while (robot.now() < plan.at) {
      robot.step();
    }
    take(observe(robot, [&](Robot& copy) {
      Random chosen(plan.seed);
      if (needsAwake(plan.kind)) {
        copy.runPastPulse(microseconds(chosen.below(kAwake)));
      }
      return choose(plan.kind, chosen, places_, copy.session.board.core(kStackPointer));
    }));
  }
}

Result FaultRun::injectOne(const InjectedFault& fault, int at) {
  Robot robot(image_, seed_);
  while (robot.now() < at) {
    robot.step();
  }
  return observe(robot, [&fault](Robot& /*copy*/) { return fault; });
}

}  // namespace wr::faults
