#include "can/CanPort.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "k64/K64Board.hpp"
#include "k64/Register.hpp"
#include "k64/core.hpp"

namespace wr {

namespace {

// Source of the registers: reference manual K64P144M120SF5RM, chapters SIM and CAN (FlexCAN).
inline constexpr Register<std::uint32_t, 0x4004803C> SCGC6;
constexpr auto SCGC6_FLEXCAN0 = SCGC6.bit(4);
inline constexpr Register<std::uint32_t, 0x40024000> MCR;
constexpr auto MCR_MDIS = MCR.bit(31);
constexpr auto MCR_FRZ = MCR.bit(30);
constexpr auto MCR_HALT = MCR.bit(28);
constexpr auto MCR_NOTRDY = MCR.bit(27);
constexpr auto MCR_FRZACK = MCR.bit(24);
constexpr auto MCR_SRXDIS = MCR.bit(17);
inline constexpr Register<std::uint32_t, 0x40024004> CTRL1;
inline constexpr Register<std::uint32_t, 0x40024008, Access::Read> TIMER;
inline constexpr Register<std::uint32_t, 0x40024028> IMASK1;
inline constexpr Register<std::uint32_t, 0x40024030, Access::Flags> IFLAG1;
inline constexpr std::uint32_t kBuffer = 0x10;  // distance between two message buffers [byte]
inline constexpr Register<std::uint32_t, 0x40024080, Access::Flags> CS;
inline constexpr Register<std::uint32_t, 0x40024084, Access::Flags> ID;
inline constexpr Register<std::uint32_t, 0x40024088, Access::Flags> DATA;  // two words of 32 bits

constexpr unsigned kCodeAt = 24;
constexpr unsigned kLengthAt = 16;
constexpr unsigned kStandardAt = 18;
constexpr auto CS_CODE = CS.field(0xF, kCodeAt);
constexpr auto CS_CODE_BUSY = CS.field(0x1, kCodeAt);
constexpr auto CS_CODE_EMPTY = CS.field(0x4, kCodeAt);
constexpr auto CS_CODE_OVERRUN = CS.field(0x6, kCodeAt);
constexpr auto CS_CODE_INACTIVE = CS.field(0x8, kCodeAt);
constexpr auto CS_CODE_DATA = CS.field(0xC, kCodeAt);

// Erratum 5829 of the controller: if a buffer is activated in a certain clock period of the
// arbitration, its frame is not sent. The workaround reserves the first buffer. After each
// activation of a buffer, the code INACTIVE is written to the first buffer twice.
constexpr unsigned kReserved = 0;
constexpr unsigned kReceiver = 1;
constexpr unsigned kSender = 2;
constexpr std::uint32_t kBuffers = 3;
constexpr std::size_t kMost = 8;  // greatest number of bytes in a frame

// A bit has 20 time quanta: 1 for the synchronisation, PROPSEG + 1 = 8, PSEG1 + 1 = 8, and PSEG2 +
// 1 = 3. The controller samples a bit after 85 % of the time of the bit.
constexpr std::uint32_t kQuanta = 20;
constexpr std::uint32_t kBitRate = 500'000;  // [bit/s]
constexpr std::uint32_t kDivider = K64Board::kBusClock / (kBitRate * kQuanta);
static_assert(kDivider * kBitRate * kQuanta == K64Board::kBusClock);
constexpr auto kClockOfBus = CTRL1.bit(13);  // CLKSRC: the bus clock is used
constexpr auto kTiming = CTRL1.field(kDivider - 1, 24) | CTRL1.field(2, 22) | CTRL1.field(7, 19) |
                         CTRL1.field(2, 16) | kClockOfBus | CTRL1.field(7, 0);

// Greatest number of reads while the port waits for the controller. The controller confirms a
// change of its mode within a few bit times. If it does not confirm the change, the port sends
// nothing, and no PC can connect.
constexpr int kMostReads = 10'000;

void await(decltype(MCR)::Bits flag, bool wanted) {
  for (int read = 0; read < kMostReads && (MCR.read() & flag).any() != wanted; ++read) {
  }
}

// Byte 0 of a frame is the most significant byte of its first word.
constexpr unsigned shiftOf(std::size_t byte) {
  return static_cast<unsigned>(24 - 8 * (byte % 4));
}

constexpr std::uint32_t bufferAt(unsigned number) {
  return number * kBuffer;
}

}  // namespace

// This constructor is not defined in the header. Otherwise the compiler could initialise the object
// at compile time, and the empty buffers would use space in the flash.
CanPort::CanPort(const Timebase& clock) : clock_(clock) {}

void CanPort::start() {
  SCGC6.set(SCGC6_FLEXCAN0);
  CTRL1.write(kClockOfBus);  // this bit must be set while the controller is disabled
  MCR.write(MCR_FRZ | MCR_HALT | MCR_SRXDIS | MCR.field(kBuffers - 1, 0));
  await(MCR_FRZACK, true);
  CTRL1.write(kTiming);
  for (unsigned buffer = 0; buffer < kBuffers; ++buffer) {
    CS.at(bufferAt(buffer)).write({0});
  }
  CS.at(bufferAt(kReserved)).write(CS_CODE_INACTIVE);
  ID.at(bufferAt(kReceiver)).write(ID.field(kToRobot, kStandardAt));
  ID.at(bufferAt(kSender)).write(ID.field(kFromRobot, kStandardAt));
  CS.at(bufferAt(kReceiver)).write(CS_CODE_EMPTY);
  IMASK1.write(IMASK1.bit(kReceiver) | IMASK1.bit(kSender));
  MCR.write(MCR_SRXDIS | MCR.field(kBuffers - 1, 0));
  await(MCR_NOTRDY, false);
}

void CanPort::serve() {
  const auto flags = IFLAG1.read();
  if ((flags & IFLAG1.bit(kReceiver)).any()) {
    receive();
  }
  if ((flags & IFLAG1.bit(kSender)).any()) {
    IFLAG1.write(IFLAG1.bit(kSender));
    sending_ = false;
    send();
  }
}

// Reading the control word locks the buffer, and reading the timer unlocks the buffer. If a frame
// arrives between these two accesses, it waits. When the buffer is unlocked, this frame is moved
// into the buffer and sets the flag. Therefore the flag is cleared before the buffer is unlocked.
// The code BUSY shows that the controller is just moving a frame into the buffer.
void CanPort::receive() {
  auto control = CS.at(bufferAt(kReceiver)).read();
  for (int read = 0; read < kMostReads && (control & CS_CODE_BUSY).any(); ++read) {
    control = CS.at(bufferAt(kReceiver)).read();
  }
  const std::array<std::uint32_t, 2> words{DATA.at(bufferAt(kReceiver)).read().value,
                                           DATA.at(bufferAt(kReceiver) + 4).read().value};
  IFLAG1.write(IFLAG1.bit(kReceiver));
  static_cast<void>(TIMER.read());
  if ((control & CS_CODE) == CS_CODE_OVERRUN) {
    lose();  // at least one byte of the previous frame is lost
  }
  const std::size_t length = std::min<std::size_t>((control.value >> kLengthAt) & 0xF, kMost);
  for (std::size_t byte = 0; byte < length; ++byte) {
    store(static_cast<std::uint8_t>(words[byte / 4] >> shiftOf(byte)), clock_.now());
  }
}

// Sends the next frame if no frame is being sent and there are bytes to send.
void CanPort::send() {
  const std::size_t length = std::min(toSend().count(), kMost);
  if (sending_ || length == 0) {
    return;
  }
  std::array<std::uint32_t, 2> words{};
  for (std::size_t byte = 0; byte < length; ++byte) {
    words[byte / 4] |= static_cast<std::uint32_t>(toSend().take()) << shiftOf(byte);
  }
  sending_ = true;
  DATA.at(bufferAt(kSender)).write({words[0]});
  DATA.at(bufferAt(kSender) + 4).write({words[1]});
  CS.at(bufferAt(kSender))
      .write(CS_CODE_DATA | CS.field(static_cast<std::uint32_t>(length), kLengthAt));
  CS.at(bufferAt(kReserved)).write(CS_CODE_INACTIVE);
  CS.at(bufferAt(kReserved)).write(CS_CODE_INACTIVE);
}

// The interrupt handler also calls send(). Therefore interrupts are blocked here.
void CanPort::beginSending() {
  const InterruptLock lock;
  send();
}

}  // namespace wr
