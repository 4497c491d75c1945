#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace wr::fuzz {

/// @brief The behaviour of the PC link as docs/protocol.rst states it. The class uses no code of
/// the firmware.
///
/// The oracle receives the same bytes at the same times as the link. The oracle returns the state
/// that the link must have.
class LinkOracle {
 public:
  /// @brief Time since start [us].
  using Time = std::int64_t;

  /// @brief The counts of dropped frames, as in a report.
  struct Counts {
    unsigned damaged = 0;
    unsigned tooLong = 0;
    unsigned unknownVersion = 0;
    unsigned unknownType = 0;
    unsigned wrongLength = 0;
    unsigned outOfRange = 0;
    unsigned unexpected = 0;
    unsigned sequenceGaps = 0;
    unsigned staleOrders = 0;
    friend bool operator==(const Counts&, const Counts&) = default;
  };

  /// @brief Constructs an oracle without received bytes and without a connection.
  LinkOracle();

  /// @brief Receives a byte.
  /// @param byte the byte
  /// @param at time at which the stop bit of the byte ended [us]
  void receive(std::uint8_t byte, Time at);

  /// @brief Ends the processing of the received bytes in a cycle.
  /// @param pulse clock pulse of the cycle [us]
  /// @return true when a Welcome is due
  bool endService(Time pulse);

  /// @brief Records that the firmware no longer answers the Hellos of this cycle.
  void serviceEnded() { welcomeDue_ = false; }

  /// @brief Records that the Welcome of this cycle was sent.
  /// @param session the session that the Welcome offers
  /// @param pulse clock pulse of the cycle [us]
  void welcomeSent(std::uint8_t session, Time pulse);

  /// @brief Records that the newest order was read.
  void orderRead() { order_.reset(); }

  /// @brief Returns the payload of the order that can be read at a clock pulse.
  /// @param pulse the clock pulse [us]
  /// @return the 21 bytes of the payload, or nothing if no order can be read
  [[nodiscard]] std::optional<std::vector<std::uint8_t>> order(Time pulse) const;

  [[nodiscard]] bool connected() const { return state_ == State::Connected; }
  /// @brief Returns true if a stop is in force in this cycle. A stop is also in force in the cycle
  /// that receives both the stop and its release.
  [[nodiscard]] bool stop() const { return stop_ || stopOfCycle_; }
  [[nodiscard]] const Counts& counts() const { return counts_; }

 private:
  enum class State { Disconnected, Handshaking, Connected };
  using Bytes = std::vector<std::uint8_t>;

  void endFrame(Time at);
  void handle(const Bytes& body, Time at);
  void checkTime(Time at);
  bool answer(std::uint8_t type, std::uint8_t sequence, std::span<const std::uint8_t> payload,
              Time at);
  bool takeOrder(std::uint8_t sequence, std::span<const std::uint8_t> payload, Time at);
  bool unexpected();
  [[nodiscard]] bool isNewer(std::uint8_t sequence) const;

  Counts counts_;
  State state_ = State::Disconnected;
  Bytes line_;  // bytes since the last zero byte
  std::optional<std::uint8_t> offered_;
  bool welcomeDue_ = false;
  Time welcomed_ = 0;
  Time lastAccepted_ = 0;
  std::uint8_t newest_ = 0;
  std::optional<Bytes> order_;
  Time orderAt_ = 0;
  bool stop_ = false;
  bool stopReceived_ = false;  // since the last endService()
  bool stopOfCycle_ = false;   // the bytes of this cycle contained a stop
};

}  // namespace wr::fuzz
