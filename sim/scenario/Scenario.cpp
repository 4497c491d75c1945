#include "sim/scenario/Scenario.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

namespace wr {

namespace {

using Time = Scenario::Time;

constexpr std::size_t kWheels = 4;

// The number that a word is, if it is one. How numbers are written may be a base.
template <class Number, class... Form>
std::optional<Number> parse(std::string_view word, Form... form) {
  Number number{};
  const auto [end, error] =
      std::from_chars(word.data(), word.data() + word.size(), number, form...);
  if (error != std::errc() || end != word.data() + word.size()) {
    return std::nullopt;
  }
  return number;
}

// The words of one line, taken one after the other. What is wrong is thrown as Scenario::Error.
class Words {
 public:
  explicit Words(const std::string& line) {
    std::istringstream text(line.substr(0, line.find('#')));
    for (std::string word; text >> word;) {
      words_.push_back(word);
    }
  }

  [[nodiscard]] bool done() const { return next_ == words_.size(); }
  [[nodiscard]] bool nextIs(std::string_view word) const {
    return !done() && words_[next_] == word;
  }

  std::string take(const std::string& what) {
    if (done()) {
      throw Scenario::Error(what + " is missing");
    }
    return words_[next_++];
  }

  [[nodiscard]] std::string next() const { return done() ? "" : words_[next_]; }

  void skip(const std::string& word) {
    const std::string found = take("'" + word + "'");
    if (found != word) {
      throw Scenario::Error("'" + word + "' is expected here, not '" + found + "'");
    }
  }

  Time time() {
    const std::string word = take("a time in ms");
    const auto number = parse<std::int32_t>(word);
    if (!number || *number < 0) {
      throw Scenario::Error("'" + word + "' is no time in ms");
    }
    return Time(*number);
  }

  // A number that a field of 16 bits holds.
  std::int16_t value() {
    const std::string word = take("a number");
    const auto number = parse<std::int16_t>(word);
    if (!number) {
      throw Scenario::Error("'" + word + "' is no number from -32768 to 32767");
    }
    return *number;
  }

  double percent() {
    const std::string word = take("a slope in percent");
    const auto number = parse<double>(word);
    if (!number) {
      throw Scenario::Error("'" + word + "' is no slope in percent");
    }
    return *number;
  }

  std::size_t wheel() {
    const std::string word = take("the number of a wheel");
    const auto number = parse<std::size_t>(word);
    if (!number || *number >= kWheels) {
      throw Scenario::Error("'" + word + "' is no wheel from 0 to 3");
    }
    return *number;
  }

  [[nodiscard]] bool nextIsNumber() const {
    return !done() && parse<std::int64_t>(words_[next_]).has_value();
  }

 private:
  std::vector<std::string> words_;
  std::size_t next_ = 0;
};

std::optional<std::uint8_t> quantityOf(std::string_view word) {
  if (word == "velocity") {
    return std::uint8_t{0};
  }
  if (word == "tension") {
    return std::uint8_t{1};
  }
  if (word == "current") {
    return std::uint8_t{2};
  }
  return std::nullopt;
}

void readWheels(Words& words, std::uint8_t quantity, PcOrder& order) {
  const std::int16_t first = words.value();
  order.wheels.fill({quantity, first});
  if (!words.nextIsNumber()) {
    return;
  }
  for (std::size_t wheel = 1; wheel < kWheels; ++wheel) {
    order.wheels[wheel].value = words.value();
  }
}

Scenario::Action readOrder(Words& words) {
  PcOrder order;
  while (!words.done()) {
    const std::string word = words.take("a part of the order");
    if (word == "stop") {
      order.stop = true;
    } else if (word == "steering") {
      order.steering = words.value();
    } else if (const auto quantity = quantityOf(word)) {
      readWheels(words, *quantity, order);
    } else {
      throw Scenario::Error("an order has no '" + word + "'");
    }
  }
  return Scenario::Order{order};
}

Scenario::Action readBytes(Words& words) {
  Scenario::Raw raw;
  do {
    const std::string word = words.take("a byte in hexadecimal");
    const auto byte = parse<std::uint8_t>(word, 16);
    if (!byte || word.size() != 2) {
      throw Scenario::Error("'" + word + "' is not a byte of two hexadecimal digits");
    }
    raw.bytes.push_back(*byte);
  } while (!words.done());
  return raw;
}

// The number that a word stands for in a field. A true value has no words.
std::int64_t readNumber(Words& words, const std::string& name, const FrameField* field) {
  const std::string word = words.take("the value of " + name);
  const auto number = field != nullptr ? numberOf(*field, word) : parse<std::int64_t>(word);
  if (!number) {
    throw Scenario::Error("'" + word + "' is no value of " + name);
  }
  return *number;
}

Scenario::Action readExpectation(Words& words) {
  const std::string name = words.take("the name of a field");
  const FrameField* const field = findField(name);
  const TruthField* const truth = findTruth(name);
  if (field == nullptr && truth == nullptr) {
    throw Scenario::Error("neither Welcome nor Report nor the robot has a field '" + name + "'");
  }
  Scenario::Expect expect{};
  if (field != nullptr) {
    expect.field = field;
  } else {
    expect.field = truth;
  }
  if (words.nextIs("between")) {
    words.skip("between");
    expect.low = readNumber(words, name, field);
    expect.high = readNumber(words, name, field);
    expect.words = "between " + std::to_string(expect.low) + " and " + std::to_string(expect.high);
    return expect;
  }
  expect.words = words.next();
  expect.low = readNumber(words, name, field);
  expect.high = expect.low;
  return expect;
}

// The sticks go to the end of their way at the greatest values that can be ordered.
constexpr double kFullVelocity = 3000;
constexpr double kFullSteering = 3200;

Scenario::Action readRemoteControl(Words& words) {
  if (words.nextIs("off")) {
    words.skip("off");
    return Scenario::RemoteControl{};
  }
  sim::Sticks sticks;
  words.skip("velocity");
  sticks.velocity = words.value() / kFullVelocity;
  words.skip("steering");
  sticks.steering = words.value() / kFullSteering;
  return Scenario::RemoteControl{sticks};
}

Scenario::Action readNoise(Words& words) {
  const bool on = words.nextIs("on");
  words.skip(on ? "on" : "off");
  return Scenario::Noise{on};
}

struct FaultWord {
  std::string_view word;
  sim::Fault fault;
  bool ofWheel;
};

constexpr std::array<FaultWord, 6> kFaults{{
    {"hall", sim::Fault::Hall, true},
    {"hall-b", sim::Fault::HallB, true},
    {"current", sim::Fault::Current, true},
    {"angle", sim::Fault::Angle, false},
    {"stall", sim::Fault::Stall, false},
    {"block", sim::Fault::Block, true},
}};

Scenario::Action readFault(Words& words, bool present) {
  const std::string word = words.take("what breaks");
  const auto found = std::ranges::find(kFaults, word, &FaultWord::word);
  if (found == kFaults.end()) {
    throw Scenario::Error("nothing that can break is called '" + word + "'");
  }
  const std::size_t wheel = found->ofWheel ? words.wheel() : 0;
  return Scenario::Fault{.fault = found->fault, .wheel = wheel, .present = present};
}

// What the world does; nothing if a word is no action of the world.
std::optional<Scenario::Action> readWorld(const std::string& word, Words& words) {
  if (word == "rc") {
    return readRemoteControl(words);
  }
  if (word == "slope") {
    return Scenario::Slope{words.percent()};
  }
  if (word == "noise") {
    return readNoise(words);
  }
  if (word == "fault" || word == "mend") {
    return readFault(words, word == "fault");
  }
  if (word == "mark") {
    return Scenario::Mark{};
  }
  return std::nullopt;
}

Scenario::Action readAction(const std::string& word, Words& words) {
  if (word == "connect") {
    return Scenario::Connect{};
  }
  if (word == "hello") {
    return Scenario::Hello{};
  }
  if (word == "confirm") {
    return Scenario::Confirm{};
  }
  if (word == "keepalive") {
    return Scenario::KeepAlive{};
  }
  if (word == "order") {
    return readOrder(words);
  }
  if (word == "bytes") {
    return readBytes(words);
  }
  if (word == "expect") {
    return readExpectation(words);
  }
  if (word == "expect-silence") {
    return Scenario::ExpectSilence{words.time()};
  }
  if (word == "expect-finding") {
    return Scenario::ExpectFinding{words.take("the id of a finding")};
  }
  if (const auto action = readWorld(word, words)) {
    return *action;
  }
  throw Scenario::Error("there is no action '" + word + "'");
}

std::uint32_t readSeed(Words& words) {
  words.skip("seed");
  const std::string word = words.take("a number");
  const auto seed = parse<std::uint32_t>(word);
  if (!seed) {
    throw Scenario::Error("'" + word + "' is no seed");
  }
  return *seed;
}

// When a line acts: once, or again and again.
struct Times {
  Time first;
  Time last;
  Time step;
};

Times readTimes(Words& words) {
  if (words.nextIs("at")) {
    words.skip("at");
    const Time at = words.time();
    return {.first = at, .last = at, .step = Time(1)};
  }
  if (!words.nextIs("from")) {
    throw Scenario::Error("a line begins with 'at TIME' or 'from TIME to TIME every TIME'");
  }
  words.skip("from");
  Times times{};
  times.first = words.time();
  words.skip("to");
  times.last = words.time();
  words.skip("every");
  times.step = words.time();
  if (times.last < times.first || times.step == Time(0)) {
    throw Scenario::Error("these times never come");
  }
  return times;
}

}  // namespace

Scenario::Scenario(std::istream& text, std::string name) : name_(std::move(name)) {
  bool ended = false;
  int number = 0;
  for (std::string line; std::getline(text, line);) {
    ++number;
    try {
      readLine(line, number, ended);
    } catch (const Error& error) {
      throw Error(name_ + ":" + std::to_string(number) + ": " + error.what());
    }
  }
  if (!ended) {
    throw Error(name_ + ":" + std::to_string(number) + ": the last line must be 'at TIME end'");
  }
  std::ranges::stable_sort(steps_, {}, &Step::at);
  if (!steps_.empty() && steps_.back().at > end_) {
    throw Error(name_ + ":" + std::to_string(steps_.back().line) + ": this is after the end");
  }
}

void Scenario::readLine(const std::string& line, int number, bool& ended) {
  Words words(line);
  if (words.done()) {
    return;
  }
  if (ended) {
    throw Error("nothing may follow 'end'");
  }
  if (words.nextIs("seed")) {
    if (!steps_.empty()) {
      throw Error("a seed stands before all lines that have a time");
    }
    seed_ = readSeed(words);
  } else {
    const Times times = readTimes(words);
    const std::string word = words.take("an action");
    ended = word == "end";
    if (ended) {
      end_ = times.first;
    } else {
      const Action action = readAction(word, words);
      for (Time at = times.first; at <= times.last; at += times.step) {
        steps_.push_back({at, number, action});
      }
    }
  }
  if (!words.done()) {
    throw Error("'" + words.take("") + "' is too much");
  }
}

Scenario Scenario::load(const std::filesystem::path& file) {
  std::ifstream text(file);
  if (!text) {
    throw Error(file.string() + ":0: the file cannot be read");
  }
  return {text, file.string()};
}

}  // namespace wr
