// Fuzzes the serial line of the PC and the signed serial line of a Bluetooth device. The inputs are
// short. Therefore many inputs run in a second. A byte of an input selects an operation, and the
// next bytes may be its data. An operation is a good frame, a frame with one error, raw bytes, a
// step of time, or a control cycle. The oracles were written only from docs/protocol.rst and
// docs/bluetooth.rst.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "bluetooth/RandomSource.hpp"
#include "bluetooth/SignedPort.hpp"
#include "bluetooth/SipHash.hpp"
#include "devices/SerialPort.hpp"
#include "fuzz/LinkOracle.hpp"
#include "fuzz/PcLine.hpp"
#include "fuzz/compare.hpp"
#include "fuzz/expect.hpp"
#include "services/StartRecord.hpp"
#include "services/assertion.hpp"

namespace wr::fuzz {
namespace {

using test::Bytes;
using Time = LinkOracle::Time;

constexpr Time kCycle = 100'000;                       // [us]
constexpr std::array<std::int64_t, 8> kTimes{1'000,    // [us] near the time limits of the protocol
                                             50'000,   //
                                             100'000,  //
                                             199'999,  //
                                             200'001,  //
                                             999'999,  //
                                             1'000'000, 1'000'001};
constexpr std::array<std::uint8_t, 8> kAhead{1, 1, 1, 0, 2, 127, 128, 255};  // sequence steps
constexpr std::array<std::size_t, 4> kLengths{21, 21, 20, 24};  // of an order; 21 is valid
constexpr std::size_t kMostPending = 900;  // bytes; one cycle reads all of them
constexpr std::size_t kMostEnds = 30;      // zero bytes among the pending bytes
constexpr std::uint64_t kStart = 0x0123456789abcdef;
constexpr SipHash::Key kKey = {7, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
constexpr std::size_t kTrailer = 24;
constexpr std::size_t kLongestSigned = 207 + kTrailer;

class Start final : public RandomSource {
 public:
  [[nodiscard]] std::optional<std::uint64_t> draw() override { return kStart; }
};

// A serial port. Each byte has the time at which it was received. A read ends after a zero byte.
class Port final : public SerialPort {
 public:
  Port() {
    received.reserve(128);
    sent.reserve(128);
  }

  std::size_t read(std::span<std::uint8_t> bytes) override {
    std::size_t count = 0;
    bool ended = false;
    while (!ended && count < bytes.size() && next_ < received.size()) {
      bytes[count] = received[next_].first;
      at_ = received[next_].second;
      ended = bytes[count] == 0;
      ++next_;
      ++count;
    }
    return count;
  }
  [[nodiscard]] Instant receivedAt() const override { return Instant() + Microseconds(at_); }
  [[nodiscard]] std::size_t free() const override { return room ? 4096 : 0; }
  bool write(std::span<const std::uint8_t> bytes) override {
    if (room) {
      sent.insert(sent.end(), bytes.begin(), bytes.end());
    }
    return room;
  }
  [[nodiscard]] std::uint16_t lostBytes() const override { return 0; }

  [[nodiscard]] bool drained() const { return next_ == received.size(); }
  void clear() {
    received.clear();
    next_ = 0;
  }

  std::vector<std::pair<std::uint8_t, Time>> received;
  Bytes sent;
  bool room = true;

 private:
  std::size_t next_ = 0;
  Time at_ = 0;
};

void appendDigits(Bytes& bytes, std::uint64_t number, unsigned digits) {
  for (unsigned left = digits; left != 0; --left) {
    bytes.push_back(static_cast<std::uint8_t>("0123456789abcdef"[number >> 4 * (left - 1) & 0xFU]));
  }
}

// Returns the counter and the tag of a frame, as docs/bluetooth.rst defines them.
Bytes trailerOf(char direction, std::uint32_t counter, std::span<const std::uint8_t> coded) {
  Bytes covered;
  covered.reserve(coded.size() + 13);
  for (unsigned byte = 0; byte != 8; ++byte) {
    covered.push_back(static_cast<std::uint8_t>(kStart >> 8 * byte));
  }
  covered.push_back(static_cast<std::uint8_t>(direction));
  for (unsigned byte = 0; byte != 4; ++byte) {
    covered.push_back(static_cast<std::uint8_t>(counter >> 8 * byte));
  }
  covered.insert(covered.end(), coded.begin(), coded.end());
  SipHash hash(kKey);
  hash.add(covered);
  Bytes trailer;
  trailer.reserve(kTrailer);
  appendDigits(trailer, counter, 8);
  appendDigits(trailer, hash.tag(), 16);
  return trailer;
}

// The rules of the signed serial line, from docs/bluetooth.rst. With these rules, the oracle
// decides which frames the connection receives, and counts the challenges that are due.
class SignedOracle {
 public:
  SignedOracle() { line_.reserve(kLongestSigned + 1); }

  void receive(std::uint8_t byte, Time at, LinkOracle& link) {
    if (byte != 0) {
      line_.push_back(byte);
      return;
    }
    if (accepts()) {
      for (const std::uint8_t coded : std::span(line_).first(line_.size() - kTrailer)) {
        link.receive(coded, at);
      }
      link.receive(0, at);
    } else {
      challenges += line_.empty() ? 0 : 1;
    }
    line_.clear();
  }

  int challenges = 0;  // challenges that are due

 private:
  [[nodiscard]] bool accepts() {
    if (line_.size() <= kTrailer || line_.size() > kLongestSigned) {
      return false;
    }
    const auto coded = std::span(line_).first(line_.size() - kTrailer);
    const auto trailer = std::span(line_).last(kTrailer);
    std::uint64_t counter = 0;
    for (const std::uint8_t digit : trailer.first(8)) {
      const bool letter = digit >= 'a' && digit <= 'f';
      if (!letter && (digit < '0' || digit > '9')) {
        return false;
      }
      counter = counter * 16 + static_cast<std::uint64_t>(letter ? digit - 'a' + 10 : digit - '0');
    }
    if (counter <= last_ ||
        !std::ranges::equal(trailer, trailerOf('D', static_cast<std::uint32_t>(counter), coded))) {
      return false;
    }
    last_ = counter;
    return true;
  }

  Bytes line_;
  std::uint64_t last_ = 0;
};

class Link {
 public:
  explicit Link(bool isSigned)
      : signed_(isSigned),
        connection_(isSigned ? static_cast<SerialPort&>(signedPort_) : port_, reader_,
                    states_.disconnected, start_) {}

  // Runs the operations of an input.
  void run(std::span<const std::uint8_t> input) {
    input_ = input;
    while (!input_.empty()) {
      operation(next());
      if (port_.received.size() > kMostPending || ends_ > kMostEnds) {
        cycle(false);
      }
    }
  }

  // Checks that Hello, Confirm and Order work again after any input.
  void recover() {
    port_.room = true;
    damage_ = 0;
    arrive(Bytes{0});
    send(kHello, {});
    cycle(true);
    send(kConfirm, {session_});
    cycle(true);
    expect(connection_.connected(), "valid frames connect the PC");
    send(kOrder, Bytes(21, 0));
    cycle(false);
    expect(reader_.available(), "a valid order can be read");
    expect(!reader_.stopOrdered(), "a neutral order releases the stop");
  }

 private:
  std::uint8_t next() {
    if (input_.empty()) {
      return 0;
    }
    const std::uint8_t byte = input_.front();
    input_ = input_.subspan(1);
    return byte;
  }

  Bytes take(std::size_t count) {
    const auto bytes = input_.first(std::min(count, input_.size()));
    input_ = input_.subspan(bytes.size());
    return {bytes.begin(), bytes.end()};
  }

  void operation(std::uint8_t code) {
    const std::uint8_t chosen = code >> 3U;
    switch (code & 7U) {
      case 0:
        arrive(take(chosen + std::size_t{1}));
        break;
      case 1:
        repeat(next(), 8 * (chosen + std::size_t{1}));
        break;
      case 2:
        send(kHello, {}, chosen == 0 ? 2 : chosen);
        break;
      case 3:
        send(chosen == 31 ? 0x07 : kConfirm, {chosen == 0 ? session_ : chosen});
        break;
      case 4:
        sequence_ += kAhead[chosen & 7U] - 1;
        send(kKeepAlive, {}, chosen < 24 ? 2 : 3);
        break;
      case 5:
        order(chosen);
        break;
      case 6:
        if (chosen < 24) {
          now_ += kTimes[chosen & 7U];
        } else if (chosen < 28) {
          port_.room = chosen != 24;
        } else if (chosen < 30) {
          damage_ = next();
        } else {
          arrive(Bytes(last_));
        }
        break;
      default:
        now_ += kCycle;
        cycle((chosen & 1U) == 0);
    }
  }

  void repeat(std::uint8_t byte, std::size_t count) { arrive(Bytes(byte == 0 ? 1 : count, byte)); }

  void order(std::uint8_t chosen) {
    sequence_ += kAhead[chosen & 7U] - 1;
    Bytes payload = take(21);
    payload.resize(21);
    payload.resize(kLengths[chosen >> 3U]);
    send(kOrder, payload);
  }

  void send(std::uint8_t type, const Bytes& payload, std::uint8_t version = 2) {
    Bytes line = test::lineBytes(type, sequence_++, payload, version);
    if (signed_) {
      line.pop_back();
      const Bytes trailer = trailerOf('D', ++counter_, line);
      line.insert(line.end(), trailer.begin(), trailer.end());
      line.push_back(0);
    }
    if (damage_ != 0) {
      line[damage_ % line.size()] ^= static_cast<std::uint8_t>(1U << (damage_ & 7U));
      damage_ = 0;
    }
    arrive(line);
    last_ = std::move(line);
  }

  void arrive(const Bytes& bytes) {
    for (const std::uint8_t byte : bytes) {
      port_.received.emplace_back(byte, now_);
      ends_ += byte == 0 ? 1 : 0;
    }
  }

  // Runs a control cycle, and compares the link with the oracles.
  void cycle(bool readsOrder) {
    for (const auto& [byte, at] : port_.received) {
      if (signed_) {
        signedOracle_.receive(byte, at, oracle_);
      } else {
        oracle_.receive(byte, at);
      }
    }
    const bool due = oracle_.endService(now_);
    connection_.beginCycle(Instant() + Microseconds(now_));
    connection_.service();
    expect(port_.drained(), "one cycle reads all bytes of the serial line");
    port_.clear();
    ends_ = 0;
    const std::optional<std::uint8_t> session = takeSent();
    expect(session.has_value() == (due && port_.room),
           "a Welcome is sent exactly when it is due and there is space");
    oracle_.serviceEnded();
    if (session) {
      oracle_.welcomeSent(*session, now_);
      session_ = *session;
    }
    compare(connection_, reader_, oracle_, now_);
    if (readsOrder && reader_.available()) {
      readAndCompare(reader_, oracle_, now_);
    }
  }

  // Checks the sent bytes. Returns the session of a Welcome.
  std::optional<std::uint8_t> takeSent() {
    std::optional<std::uint8_t> session;
    int challenged = 0;
    auto left = std::span<const std::uint8_t>(port_.sent);
    while (!left.empty()) {
      const auto end = std::ranges::find(left, std::uint8_t{0});
      expect(end != left.end(), "each frame ends with a zero byte");
      const auto line = left.first(static_cast<std::size_t>(end - left.begin()));
      left = left.subspan(line.size() + 1);
      if (line.empty()) {
        continue;
      }
      const bool trailed = signed_ && line.size() > kTrailer && isWelcome(line);
      const auto coded = trailed ? line.first(line.size() - kTrailer) : line;
      if (trailed) {
        expect(std::ranges::equal(line.last(kTrailer), trailerOf('R', ++answered_, coded)),
               "a sent frame has the next counter and a correct tag");
      }
      Bytes whole(coded.begin(), coded.end());
      whole.push_back(0);
      const Bytes body = test::bodies(whole).front();
      expect(body.size() > 5 && test::withCrc({body.begin(), body.end() - 2}) == body,
             "a sent frame has a correct CRC");
      if (body[1] == kChallenge) {
        ++challenged;
        continue;
      }
      expect(body[1] == kWelcome && body[2] == sent_ && !session,
             "at most one Welcome is sent in a cycle, with the next sequence number");
      ++sent_;
      session = body[3];
    }
    port_.sent.clear();
    expect(challenged == (port_.room ? signedOracle_.challenges : 0),
           "each dropped frame of the signed line is answered with a challenge");
    signedOracle_.challenges = 0;
    return session;
  }

  // Returns true if a coded frame is a Welcome. A coded frame begins with the distance to the next
  // zero byte, followed by the version and the type. The byte stuffing replaces only zero bytes,
  // and the version and the type are never 0. Therefore the third byte of the coded frame is the
  // type.
  [[nodiscard]] static bool isWelcome(std::span<const std::uint8_t> line) {
    return line[2] == kWelcome;
  }

  static constexpr std::uint8_t kChallenge = 0x83;

  bool signed_;
  Port port_;
  Start random_;
  SignedPort signedPort_{port_, kKey, random_};
  States states_;
  SerialReader reader_;
  StartRecord start_;
  PcConnection connection_;
  LinkOracle oracle_;
  SignedOracle signedOracle_;
  std::span<const std::uint8_t> input_;
  Time now_ = kCycle;
  std::size_t ends_ = 0;        // zero bytes that were not read yet
  std::uint8_t sequence_ = 0;   // sequence number of the next frame to the robot
  std::uint8_t session_ = 0;    // session of the newest Welcome
  std::uint8_t sent_ = 0;       // sequence number of the next frame from the robot
  std::uint32_t counter_ = 0;   // counter of the newest signed frame to the robot
  std::uint32_t answered_ = 0;  // counter of the newest signed frame from the robot
  Bytes last_;                  // the newest frame to the robot
  std::uint8_t damage_ = 0;     // position and bit of the error in the next frame; 0: no error
};

}  // namespace
}  // namespace wr::fuzz

// The fuzzer need not record the call stack of each allocation, because the firmware allocates no
// memory.
extern "C" const char* __asan_default_options() {
  return "malloc_context_size=0:quarantine_size_mb=1:detect_stack_use_after_return=0";
}

namespace wr {

// Each target defines this function. Here, the function ends the program. The fuzzer then keeps the
// input.
void assertionFailed(AssertId /*id*/) {
  std::fputs("the fuzzer found an assertion that fails\n", stderr);
  std::abort();
}

}  // namespace wr

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size != 0) {
    wr::fuzz::Link link(
        (data[0] & 3U) ==
        3);  // only a quarter of the inputs use the signed line, because its tags need much time
    link.run(std::span(data, size).subspan(1));
    if ((data[0] & 28U) ==
        0) {  // recover() runs only for an eighth of the inputs, because it takes as long as run()
      link.recover();
    }
  }
  return 0;
}
