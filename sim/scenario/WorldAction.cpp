#include "sim/scenario/WorldAction.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

namespace wr {

namespace {

// The sticks go to the end of their way at the greatest values that can be ordered.
constexpr double kFullVelocity = 3000;
constexpr double kFullSteering = 3200;
constexpr double kPercent = 100;
constexpr double kThousand = 1000;

template <class Value>
struct Named {
  std::string_view word;
  Value value;
};

constexpr auto kPositions = std::to_array<Named<sim::EnablePosition>>({
    {"stop", sim::EnablePosition::Stop},
    {"pc", sim::EnablePosition::Pc},
    {"drive", sim::EnablePosition::Drive},
});

constexpr auto kFailSafes = std::to_array<Named<sim::FailSafe>>({
    {"none", sim::FailSafe::None},
    {"hold", sim::FailSafe::Hold},
    {"neutral", sim::FailSafe::Neutral},
});

constexpr auto kSwitch = std::to_array<Named<bool>>({{"on", true}, {"off", false}});

constexpr auto kClock = std::to_array<Named<bool>>({{"lost", false}, {"back", true}});

struct ParameterWord {
  sim::Parameter parameter;
  double unit;  ///< values of the text for one of the plant
};

constexpr auto kParameters = std::to_array<Named<ParameterWord>>({
    {"supply", {sim::Parameter::Supply, kThousand}},
    {"battery", {sim::Parameter::Battery, kThousand}},
    {"mass", {sim::Parameter::Mass, kPercent}},
    {"inertia", {sim::Parameter::Inertia, kPercent}},
    {"resistance", {sim::Parameter::Resistance, kPercent}},
    {"motor-constant", {sim::Parameter::MotorConstant, kPercent}},
    {"friction", {sim::Parameter::Friction, kPercent}},
    {"rolling", {sim::Parameter::Rolling, kPercent}},
    {"current-gain", {sim::Parameter::CurrentGain, kPercent}},
    {"angle-gain", {sim::Parameter::AngleGain, kPercent}},
});

struct FaultWord {
  sim::Fault fault;
  bool ofWheel;
  bool hasValue;
};

constexpr auto kFaults = std::to_array<Named<FaultWord>>({
    {"hall", {sim::Fault::Hall, true, false}},
    {"hall-a", {sim::Fault::HallA, true, false}},
    {"hall-b", {sim::Fault::HallB, true, false}},
    {"hall-swapped", {sim::Fault::HallSwapped, true, false}},
    {"hall-misplaced", {sim::Fault::HallMisplaced, true, true}},
    {"hall-glitches", {sim::Fault::HallGlitches, true, true}},
    {"hall-losses", {sim::Fault::HallLosses, true, true}},
    {"leads", {sim::Fault::Leads, true, false}},
    {"block", {sim::Fault::Block, true, false}},
    {"current", {sim::Fault::Current, true, false}},
    {"current-stuck", {sim::Fault::CurrentStuck, true, false}},
    {"current-offset", {sim::Fault::CurrentOffset, true, true}},
    {"angle", {sim::Fault::Angle, false, false}},
    {"angle-open", {sim::Fault::AngleOpen, false, false}},
    {"angle-stuck", {sim::Fault::AngleStuck, false, false}},
    {"angle-drift", {sim::Fault::AngleDrift, false, true}},
    {"stall", {sim::Fault::Stall, false, false}},
    {"left-end", {sim::Fault::LeftEnd, false, false}},
    {"right-end", {sim::Fault::RightEnd, false, false}},
});

template <class Value>
std::string listOf(std::span<const Named<Value>> names) {
  std::string list;
  for (const Named<Value>& name : names) {
    list += (list.empty() ? "" : ", ") + std::string(name.word);
  }
  return list;
}

// Takes a word that has a value. Others are an error that lists those that have one.
template <class Value, std::size_t count>
Value take(Words& words, const std::string& what, const std::array<Named<Value>, count>& names) {
  const std::string word = words.take(what);
  const auto found = std::ranges::find(names, word, &Named<Value>::word);
  if (found == names.end()) {
    throw ScenarioError("'" + word + "' is not " + what + ": " +
                        listOf(std::span<const Named<Value>>(names)));
  }
  return found->value;
}

WorldAction readRemoteControl(Words& words) {
  if (words.takeIf("off")) {
    return world::RemoteControl{};
  }
  if (words.takeIf("enable")) {
    return world::Enable{take(words, "a position of the enable switch", kPositions)};
  }
  if (words.takeIf("failsafe")) {
    return world::FailSafe{take(words, "a fail-safe of the receiver", kFailSafes)};
  }
  if (words.takeIf("tremor")) {
    return world::Tremor{words.number("a change in us")};
  }
  if (words.takeIf("coincident")) {
    return world::Coincident{take(words, "on or off", kSwitch)};
  }
  sim::Sticks sticks;
  words.skip("velocity");
  sticks.velocity = words.value() / kFullVelocity;
  words.skip("steering");
  sticks.steering = words.value() / kFullSteering;
  return world::RemoteControl{sticks};
}

WorldAction readFault(Words& words, bool present) {
  const FaultWord fault = take(words, "a fault", kFaults);
  const std::size_t wheel = fault.ofWheel ? words.wheel() : 0;
  const double value = fault.hasValue && present ? words.number("the size of the fault") : 0.0;
  return world::Fault{.fault = fault.fault, .wheel = wheel, .present = present, .value = value};
}

WorldAction readPlant(Words& words) {
  if (words.takeIf("nominal")) {
    return world::VariedPlant{false};
  }
  if (words.takeIf("varied")) {
    return world::VariedPlant{true};
  }
  const ParameterWord parameter = take(words, "a parameter of the robot", kParameters);
  const double value = words.number("the value of the parameter");
  if (value <= 0) {
    throw ScenarioError("a parameter of the robot is greater than 0");
  }
  return world::PlantParameter{.parameter = parameter.parameter, .value = value / parameter.unit};
}

WorldAction readEmergencyStop(Words& words) {
  if (words.takeIf("release")) {
    return world::EmergencyStop{sim::EmergencyStop::Released};
  }
  words.skip("press");
  return world::EmergencyStop{words.takeIf("brake") ? sim::EmergencyStop::Brake
                                                    : sim::EmergencyStop::Coast};
}

WorldAction readGround(const std::string& word, Words& words) {
  if (word == "slope") {
    return world::Slope{words.number("a slope in percent")};
  }
  return world::Grip{words.number("a grip in percent") / kPercent};
}

// Lets each action happen.
struct Actor {
  RobotLine& robot;

  void operator()(const world::RemoteControl& action) const {
    robot.remoteControl().set(action.sticks);
  }
  void operator()(const world::Enable& action) const {
    robot.remoteControl().setEnable(action.position);
  }
  void operator()(const world::FailSafe& action) const {
    robot.remoteControl().setFailSafe(action.kind);
  }
  void operator()(const world::Tremor& action) const {
    robot.remoteControl().setTremor(action.microseconds);
  }
  void operator()(const world::Coincident& action) const {
    robot.remoteControl().setCoincident(action.on);
  }
  void operator()(const world::Slope& action) const { robot.robot().setSlope(action.percent); }
  void operator()(const world::Grip& action) const { robot.robot().setGrip(action.share); }
  void operator()(const world::Noise& action) const {
    robot.robot().setNoise(action.on);
    robot.remoteControl().setNoise(action.on);
  }
  void operator()(const world::Fault& action) const {
    robot.robot().setFault(action.fault, action.wheel, action.present, action.value);
  }
  void operator()(const world::EmergencyStop& action) const {
    robot.robot().setEmergencyStop(action.state);
  }
  void operator()(const world::VariedPlant& action) const { robot.robot().vary(action.varied); }
  void operator()(const world::PlantParameter& action) const {
    robot.robot().setParameter(action.parameter, action.value);
  }
  void operator()(const world::Clock& action) const { robot.setExternalClock(action.present); }
  void operator()(const world::Reset& action) const { robot.reset(action.kind); }
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
    return world::Noise{take(words, "on or off", kSwitch)};
  }
  if (word == "fault" || word == "mend") {
    return readFault(words, word == "fault");
  }
  if (word == "estop") {
    return readEmergencyStop(words);
  }
  if (word == "plant") {
    return readPlant(words);
  }
  if (word == "clock") {
    return world::Clock{take(words, "a state of the external clock", kClock)};
  }
  if (word == "reset") {
    return world::Reset{words.takeIf("power") ? ResetKind::Power : ResetKind::Pin};
  }
  return std::nullopt;
}

WorldAction worldActionOf(const std::string& line) {
  Words words(line);
  const std::string word = words.take("an action");
  const auto action = readWorldAction(word, words);
  if (!action) {
    throw ScenarioError("the world has no action '" + word + "'");
  }
  if (!words.done()) {
    throw ScenarioError("'" + words.take("") + "' is too much");
  }
  return *action;
}

void act(const WorldAction& action, RobotLine& robot) {
  std::visit(Actor{robot}, action);
}

}  // namespace wr
