#include "sim/scenario/WorldAction.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include "sim/scenario/FrameFields.hpp"

namespace wr::scenario {

namespace {

// A stick at the end of its range sets the greatest possible value.
constexpr double kFullVelocity = limitOf("Velocity");
constexpr double kFullSteering = limitOf("steering_set_point");
constexpr double kPercent = 100;
constexpr double kThousand = 1000;

template <class Value>
struct Named {
  std::string_view word;
  Value value;
};

constexpr auto kPositions = std::to_array<Named<plant::EnablePosition>>({
    {"stop", plant::EnablePosition::Stop},
    {"pc", plant::EnablePosition::Pc},
    {"drive", plant::EnablePosition::Drive},
    {"stop-pc", plant::EnablePosition::StopPc},
    {"pc-drive", plant::EnablePosition::PcDrive},
});

constexpr auto kFailSafes = std::to_array<Named<plant::FailSafe>>({
    {"none", plant::FailSafe::None},
    {"hold", plant::FailSafe::Hold},
    {"neutral", plant::FailSafe::Neutral},
});

constexpr auto kSwitch = std::to_array<Named<bool>>({{"on", true}, {"off", false}});

constexpr auto kClock = std::to_array<Named<bool>>({{"lost", false}, {"back", true}});

struct ParameterWord {
  plant::Parameter parameter;
  double unit;  ///< factor from a value of the text to a value of the plant
};

constexpr auto kParameters = std::to_array<Named<ParameterWord>>({
    {"supply", {plant::Parameter::Supply, kThousand}},
    {"battery", {plant::Parameter::Battery, kThousand}},
    {"mass", {plant::Parameter::Mass, kPercent}},
    {"inertia", {plant::Parameter::Inertia, kPercent}},
    {"resistance", {plant::Parameter::Resistance, kPercent}},
    {"motor-constant", {plant::Parameter::MotorConstant, kPercent}},
    {"friction", {plant::Parameter::Friction, kPercent}},
    {"rolling", {plant::Parameter::Rolling, kPercent}},
    {"current-gain", {plant::Parameter::CurrentGain, kPercent}},
    {"angle-gain", {plant::Parameter::AngleGain, kPercent}},
});

struct FaultWord {
  plant::Fault fault;
  bool ofWheel;
  bool hasValue;
};

constexpr auto kFaults = std::to_array<Named<FaultWord>>({
    {"hall", {plant::Fault::Hall, true, false}},
    {"hall-a", {plant::Fault::HallA, true, false}},
    {"hall-b", {plant::Fault::HallB, true, false}},
    {"hall-swapped", {plant::Fault::HallSwapped, true, false}},
    {"hall-misplaced", {plant::Fault::HallMisplaced, true, true}},
    {"hall-glitches", {plant::Fault::HallGlitches, true, true}},
    {"hall-losses", {plant::Fault::HallLosses, true, true}},
    {"leads", {plant::Fault::Leads, true, false}},
    {"block", {plant::Fault::Block, true, false}},
    {"current", {plant::Fault::Current, true, false}},
    {"current-open", {plant::Fault::CurrentOpen, true, false}},
    {"current-stuck", {plant::Fault::CurrentStuck, true, false}},
    {"current-offset", {plant::Fault::CurrentOffset, true, true}},
    {"angle", {plant::Fault::Angle, false, false}},
    {"angle-open", {plant::Fault::AngleOpen, false, false}},
    {"angle-stuck", {plant::Fault::AngleStuck, false, false}},
    {"angle-drift", {plant::Fault::AngleDrift, false, true}},
    {"stall", {plant::Fault::Stall, false, false}},
    {"left-end", {plant::Fault::LeftEnd, false, false}},
    {"right-end", {plant::Fault::RightEnd, false, false}},
});

template <class Value>
std::string listOf(std::span<const Named<Value>> names) {
  std::string list;
  for (const Named<Value>& name : names) {
    list += (list.empty() ? "" : ", ") + std::string(name.word);
  }
  return list;
}

// Returns the value of the next word. For an unknown word, the error message lists the known words.
template <class Value, std::size_t count>
Value take(Words& words, const std::string& what, const std::array<Named<Value>, count>& names) {
  const std::string word = words.take(what);
  const auto found = std::ranges::find(names, word, &Named<Value>::word);
  if (found == names.end()) {
    throw ScenarioError("'" + word + "' is not " + what +
                        "; choose from: " + listOf(std::span<const Named<Value>>(names)));
  }
  return found->value;
}

WorldAction readRemoteControl(Words& words) {
  if (words.takeIf("off")) {
    return world::MoveSticks{};
  }
  if (words.takeIf("enable")) {
    return world::SetEnable{take(words, "a position of the enable switch", kPositions)};
  }
  if (words.takeIf("failsafe")) {
    return world::SetFailSafe{take(words, "a fail-safe of the receiver", kFailSafes)};
  }
  if (words.takeIf("tremor")) {
    return world::SetTremor{words.number("a change in us")};
  }
  if (words.takeIf("coincident")) {
    return world::SetCoincident{take(words, "on or off", kSwitch)};
  }
  plant::Sticks sticks;
  words.skip("velocity");
  sticks.velocity = words.value() / kFullVelocity;
  words.skip("steering");
  sticks.steering = words.value() / kFullSteering;
  return world::MoveSticks{sticks};
}

WorldAction readFault(Words& words, bool present) {
  const FaultWord fault = take(words, "a fault", kFaults);
  const std::size_t wheel = fault.ofWheel ? words.wheel() : 0;
  const double value = fault.hasValue && present ? words.number("the size of the fault") : 0.0;
  return world::SetFault{.fault = fault.fault, .wheel = wheel, .present = present, .value = value};
}

WorldAction readPlant(Words& words) {
  if (words.takeIf("nominal")) {
    return world::VaryPlant{false};
  }
  if (words.takeIf("varied")) {
    return world::VaryPlant{true};
  }
  const ParameterWord parameter = take(words, "a parameter of the robot", kParameters);
  const double value = words.number("the value of the parameter");
  if (value <= 0) {
    throw ScenarioError("a parameter of the robot must be greater than 0");
  }
  return world::SetParameter{.parameter = parameter.parameter, .value = value / parameter.unit};
}

WorldAction readEmergencyStop(Words& words) {
  if (words.takeIf("release")) {
    return world::SetEmergencyStop{plant::EmergencyStop::Released};
  }
  words.skip("press");
  return world::SetEmergencyStop{words.takeIf("brake") ? plant::EmergencyStop::Brake
                                                       : plant::EmergencyStop::Coast};
}

WorldAction readGround(const std::string& word, Words& words) {
  if (word == "slope") {
    return world::SetSlope{words.number("a slope in percent")};
  }
  return world::SetGrip{words.number("a grip in percent") / kPercent};
}

// Executes each kind of action on a robot.
struct Actor {
  RobotSession& robot;

  void operator()(const world::MoveSticks& action) const {
    robot.remoteControl().set(action.sticks);
  }
  void operator()(const world::SetEnable& action) const {
    robot.remoteControl().setEnable(action.position);
  }
  void operator()(const world::SetFailSafe& action) const {
    robot.remoteControl().setFailSafe(action.kind);
  }
  void operator()(const world::SetTremor& action) const {
    robot.remoteControl().setTremor(action.microseconds);
  }
  void operator()(const world::SetCoincident& action) const {
    robot.remoteControl().setCoincident(action.on);
  }
  void operator()(const world::SetSlope& action) const { robot.robot().setSlope(action.percent); }
  void operator()(const world::SetGrip& action) const { robot.robot().setGrip(action.share); }
  void operator()(const world::SetNoise& action) const {
    robot.robot().setNoise(action.on);
    robot.remoteControl().setNoise(action.on);
  }
  void operator()(const world::SetFault& action) const {
    robot.robot().setFault(action.fault, action.wheel, action.present, action.value);
  }
  void operator()(const world::SetEmergencyStop& action) const {
    robot.robot().setEmergencyStop(action.state);
  }
  void operator()(const world::VaryPlant& action) const { robot.robot().vary(action.varied); }
  void operator()(const world::SetParameter& action) const {
    robot.robot().setParameter(action.parameter, action.value);
  }
  void operator()(const world::SetClock& action) const { robot.setExternalClock(action.present); }
  void operator()(const world::ResetBoard& action) const { robot.reset(action.kind); }
};

}  // namespace

std::optional<WorldAction> readWorldAction(const std::string& word, Words& words) {
  if (word == "rc") {
    return readRemoteControl(words);
  }
  if (word == "slope" || word == "grip") {
    return readGround(word, words);
  }
  if (word == "noise") {
    return world::SetNoise{take(words, "on or off", kSwitch)};
  }
  if (word == "fault" || word == "repair") {
    return readFault(words, word == "fault");
  }
  if (word == "estop") {
    return readEmergencyStop(words);
  }
  if (word == "plant") {
    return readPlant(words);
  }
  if (word == "clock") {
    return world::SetClock{take(words, "a state of the external clock", kClock)};
  }
  if (word == "reset") {
    return world::ResetBoard{words.takeIf("power") ? ResetKind::Power : ResetKind::Pin};
  }
  return std::nullopt;
}

WorldAction worldActionOf(const std::string& line) {
  Words words(line);
  const std::string word = words.take("an action");
  const auto action = readWorldAction(word, words);
  if (!action) {
    throw ScenarioError("'" + word + "' is not an action of the world");
  }
  if (!words.done()) {
    throw ScenarioError("'" + words.take("") + "' is a superfluous word");
  }
  return *action;
}

void act(const WorldAction& action, RobotSession& robot) {
  std::visit(Actor{robot}, action);
}

}  // namespace wr::scenario
