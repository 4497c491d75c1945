#include "sim/scenario/Words.hpp"

#include <charconv>
#include <optional>
#include <sstream>

#include "sim/plant/Plant.hpp"

namespace wr::scenario {

namespace {

// Returns the number that a word contains; nothing if the word is not a number. The optional
// argument is the base of the number.
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

}  // namespace

Words::Words(const std::string& line) {
  std::istringstream text(line.substr(0, line.find('#')));
  for (std::string word; text >> word;) {
    words_.push_back(word);
  }
}

bool Words::nextIsNumber() const {
  return !done() && parse<std::int64_t>(words_[next_]).has_value();
}

std::string Words::take(const std::string& name) {
  if (done()) {
    throw ScenarioError(name + " is missing");
  }
  return words_[next_++];
}

void Words::skip(const std::string& word) {
  const std::string found = take("'" + word + "'");
  if (found != word) {
    throw ScenarioError("'" + word + "' is expected here, not '" + found + "'");
  }
}

bool Words::takeIf(std::string_view word) {
  const bool found = nextIs(word);
  if (found) {
    ++next_;
  }
  return found;
}

std::chrono::milliseconds Words::time() {
  const std::string word = take("a time in ms");
  const auto number = parse<std::int32_t>(word);
  if (!number || *number < 0) {
    throw ScenarioError("'" + word + "' is not a time in ms");
  }
  return std::chrono::milliseconds(*number);
}

std::int16_t Words::value() {
  const std::string word = take("a number");
  const auto number = parse<std::int16_t>(word);
  if (!number) {
    throw ScenarioError("'" + word + "' is not a number from -32768 to 32767");
  }
  return *number;
}

double Words::number(const std::string& name) {
  const std::string word = take(name);
  std::istringstream text(word);
  double number = 0;
  if (!(text >> number) || !text.eof()) {
    throw ScenarioError("'" + word + "' is not " + name);
  }
  return number;
}

std::size_t Words::wheel() {
  const std::string word = take("the number of a wheel");
  const auto number = parse<std::size_t>(word);
  if (!number || *number >= plant::kWheels) {
    throw ScenarioError("'" + word + "' is not a wheel from 0 to 3");
  }
  return *number;
}

std::uint32_t Words::natural(const std::string& name) {
  const std::string word = take("a number");
  const auto number = parse<std::uint32_t>(word);
  if (!number) {
    throw ScenarioError("'" + word + "' is not " + name);
  }
  return *number;
}

std::uint8_t Words::byte() {
  const std::string word = take("a byte in hexadecimal");
  const auto byte = parse<std::uint8_t>(word, 16);
  if (!byte || word.size() != 2) {
    throw ScenarioError("'" + word + "' is not a byte of two hexadecimal digits");
  }
  return *byte;
}

}  // namespace wr::scenario
