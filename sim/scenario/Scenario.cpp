#include "sim/scenario/Scenario.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "sim/plant/Plant.hpp"

namespace wr::scenario {

namespace {

using Time = Scenario::Time;

constexpr Time kCycle{100};
constexpr Time kToFirstOrder{
    200};  // time from Hello to the first order: Welcome and Confirm take two cycles
// Number of orders that is sufficient to arm the robot. The robot does not read the first orders,
// and must read several neutral orders before it is armed.
constexpr int kNeutralOrders = 13;

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
  for (std::size_t wheel = 1; wheel < plant::kWheels; ++wheel) {
    order.wheels[wheel].value = words.value();
  }
}

Scenario::Action readOrder(Words& words) {
  PcOrder order;
  while (!words.done()) {
    const std::string word = words.take("a field of the order");
    if (word == "stop") {
      order.stop = true;
    } else if (word == "acknowledge") {
      order.acknowledge = true;
    } else if (word == "steering") {
      order.steering = words.value();
    } else if (const auto quantity = quantityOf(word)) {
      readWheels(words, *quantity, order);
    } else {
      throw Scenario::Error("an order has no field '" + word + "'");
    }
  }
  return Scenario::Order{order};
}

Scenario::Action readBytes(Words& words) {
  Scenario::Raw raw;
  do {
    raw.bytes.push_back(words.byte());
  } while (!words.done());
  return raw;
}

// Converts the next word to a number. For a field of a frame, the word may also be a name that this
// field defines. A true value of the plant has no field, and its word must be a number.
std::int64_t readNumber(Words& words, const std::string& name, const FrameField* field) {
  const std::string word = words.take("the value of " + name);
  const auto number = numberOf(field != nullptr ? *field : FrameField{}, word);
  if (!number) {
    throw Scenario::Error("'" + word + "' is not a value of " + name);
  }
  return *number;
}

void readRange(Words& words, const std::string& name, const FrameField* field,
               Scenario::Expect& expect) {
  if (words.takeIf("between")) {
    expect.low = readNumber(words, name, field);
    expect.high = readNumber(words, name, field);
    if (expect.low > expect.high) {
      throw Scenario::Error("no value of " + name + " is in this range");
    }
    expect.words = "between " + std::to_string(expect.low) + " and " + std::to_string(expect.high);
    return;
  }
  expect.words = words.next();
  expect.low = readNumber(words, name, field);
  expect.high = expect.low;
}

std::optional<Scenario::Limit> readLimit(Words& words) {
  if (!words.takeIf("within")) {
    return std::nullopt;
  }
  const double amount = words.number("a time or a distance");
  if (amount <= 0) {
    throw Scenario::Error("an expectation needs a time or a distance greater than 0");
  }
  const bool isWay = words.takeIf("mm");
  if (!isWay) {
    words.skip("ms");
  }
  return Scenario::Limit{.amount = amount, .isWay = isWay};
}

Scenario::Action readExpectation(Words& words) {
  const std::string name = words.take("the name of a field");
  const FrameField* const field = findField(name);
  const TruthField* const truth = findTruth(name);
  if (field == nullptr && truth == nullptr) {
    throw Scenario::Error("'" + name +
                          "' is not a field of Welcome or Report, and not a true value");
  }
  Scenario::Expect expect{};
  if (field != nullptr) {
    expect.field = field;
  } else {
    expect.field = truth;
  }
  readRange(words, name, field, expect);
  expect.within = readLimit(words);
  return expect;
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
  if (word == "replay") {
    return Scenario::Replay{};
  }
  if (word == "mark") {
    return Scenario::Mark{};
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
  if (const auto action = readWorldAction(word, words)) {
    return *action;
  }
  throw Scenario::Error("there is no action '" + word + "'");
}

// Greatest number of repetitions of one scenario line. This is enough for an action every 100 ms
// for an hour.
constexpr int kMostTimes = 100'000;

// The times at which the action of a scenario line is executed. A line has one time or repeated
// times.
struct Times {
  Time first;
  Time last;
  Time step;
};

Times readTimes(Words& words) {
  if (words.takeIf("at")) {
    const Time at = words.time();
    return {.first = at, .last = at, .step = Time(1)};
  }
  if (!words.takeIf("from")) {
    throw Scenario::Error("a line begins with 'at TIME' or 'from TIME to TIME every TIME'");
  }
  Times times{};
  times.first = words.time();
  words.skip("to");
  times.last = words.time();
  words.skip("every");
  times.step = words.time();
  if (times.last < times.first || times.step == Time(0)) {
    throw Scenario::Error("there are no times between these limits");
  }
  if ((times.last - times.first) / times.step >= kMostTimes) {
    throw Scenario::Error("this line is executed more than " + std::to_string(kMostTimes) +
                          " times");
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
    throw Error(name_ + ":" + std::to_string(steps_.back().line) + ": this time is after the end");
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
  if (words.nextIs("seed") || words.nextIs("plant")) {
    readHead(words);
  } else {
    readTimed(words, number, ended);
  }
  if (!words.done()) {
    throw Error("'" + words.take("") + "' is a superfluous word");
  }
}

void Scenario::readHead(Words& words) {
  const std::string word = words.take("an action");
  if (!steps_.empty()) {
    throw Error("a line with " + word + " must be before all lines that have a time");
  }
  if (word == "seed") {
    seed_ = words.natural("a seed");
  } else {
    plant_.push_back(*readWorldAction(word, words));
  }
}

void Scenario::readTimed(Words& words, int number, bool& ended) {
  const Times times = readTimes(words);
  const std::string word = words.take("an action");
  ended = word == "end";
  if (ended) {
    end_ = times.first;
  } else if (word == "arm") {
    addArming(times.first, number);
  } else {
    const Action action = readAction(word, words);
    for (Time at = times.first; at <= times.last; at += times.step) {
      steps_.push_back({at, number, action});
    }
  }
}

void Scenario::addArming(Time at, int number) {
  steps_.push_back({at, number, Connect{}});
  for (int order = 0; order < kNeutralOrders; ++order) {
    at += order == 0 ? kToFirstOrder : kCycle;
    steps_.push_back({at, number, Order{}});
  }
}

}  // namespace wr::scenario
