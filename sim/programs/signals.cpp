#include "sim/programs/signals.hpp"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstddef>
#include <string_view>
#include <system_error>

namespace wr::programs {

namespace {

constexpr double kHighestVolts = 3.3;
constexpr int kLastChannel = 23;
constexpr int kLastPin = 31;

// Reads a text from its beginning. Any error makes the whole text invalid.
class Words {
 public:
  Words(const char* option, const std::string& text) : option_(option), text_(text), rest_(text) {}

  void literal(std::string_view expected) {
    require(rest_.starts_with(expected));
    rest_.remove_prefix(expected.size());
  }

  char letter(char first, char last) {
    require(!rest_.empty() && rest_.front() >= first && rest_.front() <= last);
    const char found = rest_.front();
    rest_.remove_prefix(1);
    return found;
  }

  template <class T>
  T number() {
    T found{};
    require(!rest_.empty() && rest_.front() != '-');
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), found);
    require(error == std::errc());
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return found;
  }

  void end() const { require(rest_.empty()); }

 private:
  void require(bool fits) const {
    if (!fits) {
      throw CLI::ValidationError(option_,
                                 "'" + text_ + "' is not valid. See the example in --help");
    }
  }

  const char* option_;
  const std::string& text_;
  std::string_view rest_;
};

void refuseUnless(bool inRange, const char* option, const std::string& what) {
  if (!inRange) {
    throw CLI::ValidationError(option, what);
  }
}

}  // namespace

AnalogSignal analogSignalOf(const std::string& text) {
  Words words("--analog", text);
  AnalogSignal signal{};
  words.literal("ADC");
  signal.converter = words.letter('0', '1') - '0';
  words.literal("_SE");
  signal.channel = words.number<int>();
  words.literal("=");
  signal.volts = words.number<double>();
  words.end();
  refuseUnless(signal.channel <= kLastChannel, "--analog",
               text + " is not valid. Inputs are SE0 to SE23");
  refuseUnless(signal.volts <= kHighestVolts, "--analog",
               text + " is not valid. Voltages are 0 V to 3.3 V");
  return signal;
}

DigitalSignal digitalSignalOf(const std::string& text) {
  Words words("--level", text);
  DigitalSignal signal{};
  words.literal("PT");
  signal.port = words.letter('A', 'E');
  signal.pin = words.number<int>();
  words.literal("=");
  signal.level = words.letter('0', '1') == '1';
  words.end();
  refuseUnless(signal.pin <= kLastPin, "--level", text + " is not valid. Pins are 0 to 31");
  return signal;
}

}  // namespace wr::programs
