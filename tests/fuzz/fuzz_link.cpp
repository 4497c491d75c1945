// Fuzzes the connection to the PC, including its encoder and its decoder. The input selects the
// bytes of the PC, and the time between two steps. An oracle receives the same bytes. The oracle
// was written only from docs/protocol.rst.

#include <fuzzer/FuzzedDataProvider.h>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <span>

#include "communication/pc_connection/PcConnection.hpp"
#include "communication/serialization/ReportMessage.hpp"
#include "communication/serialization/SerialReader.hpp"
#include "fuzz/LinkOracle.hpp"
#include "fuzz/PcLine.hpp"
#include "fuzz/compare.hpp"
#include "fuzz/expect.hpp"

namespace wr::fuzz {
namespace {

constexpr std::int64_t kCycle = 100'000;  // [us]
constexpr std::size_t kMostInCycle = 1216;
constexpr std::size_t kRoomForWelcome = 64;

// A serial port. Each byte has the time at which it was received.
class Port final : public SerialPort {
 public:
  struct Received {
    std::uint8_t byte;
    std::int64_t at;
  };

  std::size_t read(std::span<std::uint8_t> bytes) override {
    std::size_t count = 0;
    bool ended = false;
    while (!ended && count < bytes.size() && !received.empty()) {
      bytes[count] = received.front().byte;
      at_ = received.front().at;
      ended = bytes[count] == 0;
      received.pop_front();
      ++count;
    }
    return count;
  }
  [[nodiscard]] Instant receivedAt() const override { return Instant() + Microseconds(at_); }
  [[nodiscard]] std::size_t free() const override { return room; }
  bool write(std::span<const std::uint8_t> bytes) override {
    if (bytes.size() > room) {
      return false;
    }
    room -= bytes.size();
    sent.insert(sent.end(), bytes.begin(), bytes.end());
    return true;
  }
  [[nodiscard]] std::uint16_t lostBytes() const override { return 0; }

  std::deque<Received> received;
  test::Bytes sent;
  std::size_t room = std::numeric_limits<std::size_t>::max();

 private:
  std::int64_t at_ = 0;
};

class Link {
 public:
  void arrive(const test::Bytes& bytes) {
    for (const std::uint8_t byte : bytes) {
      port.received.push_back({byte, now_});
    }
  }

  void pass(std::int64_t duration) { now_ += duration; }

  // Runs a control cycle, and compares the link with the oracle.
  void cycle(bool readOrder) {
    const std::size_t taken = std::min(port.received.size(), kMostInCycle);
    for (std::size_t i = 0; i < taken; ++i) {
      oracle_.receive(port.received[i].byte, port.received[i].at);
    }
    const bool due = oracle_.endService(now_);
    const std::size_t room = port.room;
    connection_.beginCycle(Instant() + Microseconds(now_));
    connection_.service();
    const std::optional<std::uint8_t> session = takeSent(kWelcome);
    expect(due || !session, "a Welcome is sent only as the answer to a Hello");
    expect(!due || session || room < kRoomForWelcome, "a Hello is answered when there is space");
    oracle_.serviceEnded();
    if (session) {
      oracle_.welcomeSent(*session, now_);
      pc.session = *session;
    }
    report();
    compare();
    if (readOrder && reader_.available()) {
      readAndCompare(reader_, oracle_, now_);
    }
  }

  [[nodiscard]] bool orderAvailable() const { return reader_.available(); }
  [[nodiscard]] bool connected() const { return connection_.connected(); }

  Port port;
  PcLine pc;

 private:
  void report() {
    ReportData data;
    const bool sent = connection_.sendReport(ReportMessage(data));
    expect(!sent || oracle_.connected(), "the firmware sends reports only to a connected PC");
    reportsLost_ += !sent && oracle_.connected() ? 1U : 0U;
    expect(takeSent(kReport).has_value() == sent, "a report is sent as a whole or not at all");
  }

  // Checks that the firmware sent only whole frames of one type, with consecutive numbers. Returns
  // the first byte of the payload.
  std::optional<std::uint8_t> takeSent(std::uint8_t type) {
    std::optional<std::uint8_t> first;
    expect(port.sent.empty() || port.sent.back() == 0, "each frame ends with a zero byte");
    for (const test::Bytes& body : test::bodies(port.sent)) {
      expect(body.size() > 5 && body[0] == 2 && body[1] == type,
             "a sent frame has the expected version and type");
      expect(test::withCrc({body.begin(), body.end() - 2}) == body,
             "a sent frame has a correct CRC");
      expect(body[2] == sequence_, "a sent frame has the next sequence number");
      ++sequence_;
      expect(!first, "at most one frame of a type is sent in a cycle");
      first = body[3];
    }
    port.sent.clear();
    return first;
  }

  void compare() const {
    fuzz::compare(connection_, reader_, oracle_, now_);
    expect(connection_.counts().reportsNotSent == std::min(reportsLost_, 65535U),
           "reports that are not sent are counted");
  }

  States states_;
  SerialReader reader_;
  StartRecord start_;
  PcConnection connection_{port, reader_, states_.disconnected, start_};
  LinkOracle oracle_;
  std::int64_t now_ = kCycle;
  std::uint8_t sequence_ = 0;
  unsigned reportsLost_ = 0;
};

void fuzz(FuzzedDataProvider& input) {
  Link link;
  while (input.remaining_bytes() > 0) {
    switch (input.ConsumeIntegralInRange(0, 7)) {
      case 0:
        link.pass(input.ConsumeIntegralInRange<std::int64_t>(0, 1'200'000));
        break;
      case 1:
        link.port.room = input.ConsumeIntegralInRange<std::size_t>(0, 512);
        break;
      case 2:
      case 3:
        link.pass(kCycle);
        link.cycle(input.ConsumeBool());
        break;
      default:
        link.arrive(link.pc.next(input));
    }
  }
  // Checks that Hello, Confirm and Order work again after any input, each in one cycle.
  constexpr int kMostCycles = 100;
  for (int i = 0; i < kMostCycles && !link.port.received.empty(); ++i) {
    link.cycle(false);
  }
  link.port.room = std::numeric_limits<std::size_t>::max();
  link.arrive({0});
  link.arrive(link.pc.good(kHello));
  link.cycle(false);
  link.arrive(link.pc.good(kConfirm, {link.pc.session}));
  link.cycle(true);
  expect(link.connected(), "valid frames connect the PC");
  link.arrive(link.pc.drive(100));
  link.cycle(false);
  expect(link.orderAvailable(), "a valid order can be read");
}

}  // namespace
}  // namespace wr::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FuzzedDataProvider input(data, size);
  wr::fuzz::fuzz(input);
  return 0;
}
