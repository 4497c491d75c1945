#include "sim/gdb/Commands.hpp"

#include <array>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <optional>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "sim/gdb/hexBytes.hpp"
#include "sim/gdb/targetDescription.hpp"

namespace wr::gdb {

namespace {

using emulator::DebugPort;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr std::string_view kDone = "OK";
constexpr std::string_view kWrong = "E01";  // the packet is invalid
constexpr std::string_view kFault = "E14";  // there is no memory at the address
constexpr std::string_view kFeatures = "PacketSize=4000;QStartNoAckMode+;qXfer:features:read+";
constexpr std::string_view kWaysBack = ";ReverseStep+;ReverseContinue+";
constexpr std::size_t kMostBytes =
    0x1F00;                             // maximum number of bytes in the answer to a memory read
constexpr microseconds kPatience{200};  // time between two reads of the serial line to GDB

// Splits a text like "a,b" or "a=b" into its two parts.
std::pair<std::string_view, std::string_view> divided(std::string_view text, char at) {
  const std::size_t place = text.find(at);
  return place == std::string_view::npos ? std::pair(text, std::string_view())
                                         : std::pair(text.substr(0, place), text.substr(place + 1));
}

std::span<const std::uint8_t> bytesOfRegister(const std::uint64_t& value, std::size_t number) {
  return std::span(reinterpret_cast<const std::uint8_t*>(&value), sizeof value)
      .first(DebugPort::registers()[number].bits / 8);
}

std::uint64_t valueOf(std::span<const std::uint8_t> bytes) {
  std::uint64_t value = 0;
  std::memcpy(&value, bytes.data(), bytes.size());
  return value;
}

std::string part(const std::string& text, std::string_view range) {
  const auto [offset, length] = divided(range, ',');
  const auto from = numberOf(offset);
  const auto count = numberOf(length);
  if (!from || !count) {
    return std::string(kWrong);
  }
  if (*from >= text.size()) {
    return "l";
  }
  const std::string found = text.substr(*from, *count);
  return (*from + found.size() < text.size() ? "m" : "l") + found;
}

}  // namespace

Commands::Commands(programs::SerialLine& line, std::function<bool()> ends, bool goesBack)
    : stream_(line),
      ends_(std::move(ends)),
      goesBack_(goesBack),
      debugger_([this](const std::string& why) { serve(why); }, [this] { return asked(); }) {}

// Returns true if the program shall stop. There are two reasons: bytes have arrived, or this
// process shall end. The bytes are Ctrl-C, or the first bytes of another GDB.
bool Commands::asked() {
  return stream_.takeInterrupt() || stream_.waiting() || ends_();
}

void Commands::glance() {
  const std::uint64_t position = debugger_.port().instructions();
  if (std::exchange(seenPosition_, position) == position && asked()) {
    debugger_.stopHere("02");
  }
}

void Commands::serve(const std::string& why) {
  why_ = "T" + why;
  static_cast<void>(stream_.takeInterrupt());  // discards a request that arrived too late
  const Owed owed = std::exchange(owed_, Owed::Nothing);
  if (owed != Owed::Nothing) {
    stream_.send(owed == Owed::Stop ? why_ : hexOf(std::string_view(timeText())));
  }
  while (true) {
    if (ends_()) {
      throw Killed();
    }
    const std::optional<std::string> packet = stream_.take();
    if (!packet) {
      std::this_thread::sleep_for(kPatience);
    } else if (obey(*packet)) {
      return;
    }
  }
}

// Executes a command. Returns true if the program continues.
bool Commands::obey(std::string_view packet) {
  constexpr std::string_view kMonitor = "qRcmd,";
  if (packet == "k" || packet.starts_with("vKill")) {
    if (packet != "k") {
      stream_.send(kDone);
    }
    throw Killed();
  }
  if (packet.starts_with(kMonitor)) {
    const auto bytes = bytesOf(packet.substr(kMonitor.size()));
    return monitor(bytes ? std::string(bytes->begin(), bytes->end()) : "");
  }
  const bool backwards = goesBack_ && (packet == "bs" || packet == "bc");
  if (backwards || packet.starts_with("c") || packet.starts_with("s")) {
    if (debugger_.ended() && !backwards) {
      stream_.send("W00");
      throw Killed();
    }
    owed_ = Owed::Stop;
    resume(packet);
    return true;
  }
  const std::string reply = answer(packet);
  stream_.send(reply);
  if (packet == "QStartNoAckMode") {
    stream_.stopAcknowledging();
  }
  return std::exchange(leaves_, false);
}

void Commands::resume(std::string_view packet) {
  if (packet == "bs") {
    debugger_.stepBack();
  } else if (packet == "bc") {
    debugger_.resumeBack();
  }
  if (const auto address = numberOf(packet.substr(1))) {
    debugger_.write(DebugPort::kPc, *address);
  }
  if (packet.front() == 's') {
    debugger_.step();
  }
}

std::string Commands::answer(std::string_view packet) {
  const std::string_view rest = packet.empty() ? packet : packet.substr(1);
  switch (packet.empty() ? '\0' : packet.front()) {
    case '?':
      return why_;
    case 'g':
      return readRegisters();
    case 'G':
      return writeRegisters(rest);
    case 'p':
      return readRegister(rest);
    case 'P':
      return writeRegister(rest);
    case 'm':
      return readMemory(rest);
    case 'M':
      return writeMemory(rest);
    case 'z':
    case 'Z':
      return setRule(packet);
    case 'q':
    case 'Q':
      return query(packet);
    case 'H':
    case 'T':
      return std::string(kDone);
    case 'D':
      debugger_.leave();
      leaves_ = true;
      return std::string(kDone);
    default:
      return "";  // the packet is not supported
  }
}

std::string Commands::query(std::string_view packet) {
  constexpr std::string_view kDescription = "qXfer:features:read:target.xml:";
  if (packet.starts_with("qSupported")) {
    return std::string(kFeatures) + std::string(goesBack_ ? kWaysBack : "");
  }
  if (packet.starts_with(kDescription)) {
    return part(targetDescription(), packet.substr(kDescription.size()));
  }
  if (packet.starts_with("qAttached")) {
    return "1";
  }
  return packet == "QStartNoAckMode" ? std::string(kDone) : "";
}

std::string Commands::readRegisters() const {
  std::string text;
  for (std::size_t i = 0; i < DebugPort::registers().size(); ++i) {
    const std::uint64_t value = debugger_.port().read(i);
    text += hexOf(bytesOfRegister(value, i));
  }
  return text;
}

std::string Commands::writeRegisters(std::string_view digits) {
  const auto bytes = bytesOf(digits);
  std::size_t place = 0;
  for (std::size_t i = 0; bytes && i < DebugPort::registers().size(); ++i) {
    const std::size_t size = DebugPort::registers()[i].bits / 8;
    if (place + size > bytes->size()) {
      break;
    }
    debugger_.write(i, valueOf(std::span(*bytes).subspan(place, size)));
    place += size;
  }
  return std::string(bytes ? kDone : kWrong);
}

std::string Commands::readRegister(std::string_view number) const {
  const auto index = numberOf(number);
  if (!index || *index >= DebugPort::registers().size()) {
    return std::string(kWrong);
  }
  const std::uint64_t value = debugger_.port().read(*index);
  return hexOf(bytesOfRegister(value, *index));
}

std::string Commands::writeRegister(std::string_view assignment) {
  const auto [number, digits] = divided(assignment, '=');
  const auto index = numberOf(number);
  const auto bytes = bytesOf(digits);
  if (!index || *index >= DebugPort::registers().size() || !bytes ||
      bytes->size() != DebugPort::registers()[*index].bits / 8) {
    return std::string(kWrong);
  }
  debugger_.write(*index, valueOf(*bytes));
  return std::string(kDone);
}

std::string Commands::readMemory(std::string_view range) const {
  const auto [first, length] = divided(range, ',');
  const auto address = numberOf(first);
  const auto count = numberOf(length);
  if (!address || !count) {
    return std::string(kWrong);
  }
  std::vector<std::uint8_t> bytes(std::min<std::size_t>(*count, kMostBytes));
  const std::size_t done = debugger_.port().readMemory(*address, bytes);
  return done == 0 && *count != 0 ? std::string(kFault) : hexOf(std::span(bytes).first(done));
}

std::string Commands::writeMemory(std::string_view packet) {
  const auto [range, digits] = divided(packet, ':');
  const auto [first, length] = divided(range, ',');
  const auto address = numberOf(first);
  const auto bytes = bytesOf(digits);
  if (!address || !bytes || numberOf(length) != bytes->size()) {
    return std::string(kWrong);
  }
  return std::string(debugger_.writeMemory(*address, *bytes) ? kDone : kFault);
}

std::string Commands::setRule(std::string_view packet) {
  const bool sets = packet.front() == 'Z';
  const auto [kind, place] = divided(packet.substr(1), ',');
  const auto [first, length] = divided(place, ',');
  const auto address = numberOf(first);
  const auto size = numberOf(divided(length, ';').first);
  const auto number = numberOf(kind);
  if (!address || !size || !number) {
    return std::string(kWrong);
  }
  constexpr std::array<Watch, 3> kWatches{Watch::Write, Watch::Read, Watch::Access};
  StopRules& rules = debugger_.rules();
  if (*number < 2) {
    sets ? rules.addBreakpoint(*address) : rules.removeBreakpoint(*address);
  } else if (*number < 2 + kWatches.size()) {
    const Watch watch = kWatches.at(*number - 2);
    sets ? rules.addWatchpoint(watch, *address, *size)
         : rules.removeWatchpoint(watch, *address, *size);
    debugger_.rulesChanged();
  } else {
    return "";
  }
  return std::string(kDone);
}

std::string Commands::timeText() const {
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), "%.6f ms, %llu instructions\n",
                std::chrono::duration<double, std::milli>(debugger_.port().now()).count(),
                static_cast<unsigned long long>(debugger_.port().instructions()));
  return text.data();
}

bool Commands::monitor(const std::string& words) {
  constexpr std::string_view kRunTo = "run-to ";
  owed_ = Owed::Monitor;
  if (goesBack_ && words == "reset") {
    debugger_.restart();
  }
  if (words.starts_with(kRunTo)) {
    double ms = -1;
    const std::string_view number = std::string_view(words).substr(kRunTo.size());
    const auto read = std::from_chars(number.data(), number.data() + number.size(), ms);
    const auto time =
        std::chrono::duration_cast<nanoseconds>(std::chrono::duration<double, std::milli>(ms));
    if (read.ec == std::errc() && ms >= 0 && (goesBack_ || time > debugger_.port().now())) {
      debugger_.runTo(time);
      return true;
    }
  }
  owed_ = Owed::Nothing;
  const std::string text =
      words == "time" ? timeText()
                      : "time: show the time of the board and the number of executed instructions\n"
                        "reset: restart the run\n"
                        "run-to MS: run forwards or backwards to this time of the board in ms\n"
                        "After 'reset' and 'run-to', enter: maintenance flush register-cache\n";
  stream_.send(hexOf(std::string_view(text)));
  return false;
}

}  // namespace wr::gdb
