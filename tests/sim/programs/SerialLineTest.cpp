#include "sim/programs/SerialLine.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <thread>

#include "sim/programs/PseudoTerminal.hpp"
#include "sim/programs/TcpLine.hpp"
#include "sim/programs/signals.hpp"
#include "support/LineBytes.hpp"

namespace wr::test {
namespace {

// Reads until the given number of bytes was received or a second has passed.
Bytes readAll(programs::SerialLine& line, std::size_t count) {
  Bytes all;
  Bytes read(4096);
  for (int tries = 0; all.size() < count && tries < 1000; ++tries) {
    const std::size_t got = line.read(read);
    all.insert(all.end(), read.begin(), read.begin() + static_cast<std::ptrdiff_t>(got));
    if (got == 0) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  return all;
}

// A program at the other end of a serial line.
class Client {
 public:
  explicit Client(const std::string& path) : file_(open(path.c_str(), O_RDWR | O_NOCTTY)) {}
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;
  ~Client() { close(file_); }

  void send(const Bytes& bytes) const {
    EXPECT_EQ(::write(file_, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  }
  [[nodiscard]] Bytes receive(std::size_t count) const {
    Bytes bytes(count);
    const ssize_t got = ::read(file_, bytes.data(), bytes.size());
    bytes.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    return bytes;
  }

 private:
  int file_;
};

/// @brief All 256 byte values pass the pseudo-terminal unchanged in both directions.
TEST(PseudoTerminalTest, PassesEveryByteValue) {
  programs::PseudoTerminal port;
  const Client client(port.name());
  client.send(counting(256));
  EXPECT_EQ(readAll(port, 256), counting(256));
  EXPECT_TRUE(port.write(counting(256)));
  EXPECT_EQ(client.receive(300), counting(256));
}

/// @brief A client can disconnect, and another client can connect.
TEST(PseudoTerminalTest, SurvivesAClientThatLeaves) {
  programs::PseudoTerminal port;
  Bytes read(8);
  for (int i = 0; i < 3; ++i) {
    const Client client(port.name());
    client.send({1, 2, 3});
    EXPECT_EQ(port.read(read), 3U);
    EXPECT_TRUE(port.write(counting(4)));
    EXPECT_EQ(client.receive(8), counting(4));
  }
  EXPECT_EQ(port.read(read), 0U);
}

/// @brief When the other end does not read, the buffer of the port becomes full. Then each write is
/// rejected as a whole, and no call blocks.
TEST(PseudoTerminalTest, RefusesWhatHasNoRoom) {
  programs::PseudoTerminal port;
  int written = 0;
  while (port.write(counting(100)) && written < 10'000) {
    ++written;
  }
  EXPECT_LT(written, 10'000);
  const Client client(port.name());
  EXPECT_EQ(client.receive(100), counting(100));
}

// A client of a TCP port.
class TcpClient {
 public:
  explicit TcpClient(const std::string& name)
      : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port =
        htons(static_cast<std::uint16_t>(std::stoi(name.substr(name.rfind(':') + 1))));
    EXPECT_EQ(connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  TcpClient(const TcpClient&) = delete;
  TcpClient& operator=(const TcpClient&) = delete;
  ~TcpClient() { close(socket_); }

  void send(const Bytes& bytes) const {
    EXPECT_EQ(::send(socket_, bytes.data(), bytes.size(), 0), static_cast<ssize_t>(bytes.size()));
  }
  [[nodiscard]] Bytes receive(std::size_t count) const {
    Bytes bytes(count);
    const ssize_t got = recv(socket_, bytes.data(), bytes.size(), MSG_WAITALL);
    bytes.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    return bytes;
  }

 private:
  int socket_;
};

/// @brief All 256 byte values pass a TCP line unchanged in both directions, for one client after
/// another. Without a client, bytes are lost.
TEST(TcpLineTest, PassesEveryByteValueToEachClient) {
  programs::TcpLine line(0);
  EXPECT_FALSE(line.write(counting(1)));
  for (int i = 0; i < 2; ++i) {
    const TcpClient client(line.name());
    client.send(counting(256));
    EXPECT_EQ(readAll(line, 256), counting(256));
    EXPECT_TRUE(line.write(counting(256)));
    EXPECT_EQ(client.receive(256), counting(256));
  }
}

/// @brief A TCP port that is in use causes an error. The message contains the number of the port.
TEST(TcpLineTest, NamesAPortThatIsInUse) {
  const programs::TcpLine line(0);
  const std::string port = line.name().substr(line.name().rfind(':') + 1);
  try {
    static_cast<void>(programs::openLine("tcp:" + port));
    ADD_FAILURE() << "two lines have the same port";
  } catch (const std::system_error& error) {
    EXPECT_NE(std::string(error.what()).find("TCP port " + port), std::string::npos);
  }
}

/// @brief The kinds of serial lines are pty, stdout and tcp with a port from 0 to 65535.
TEST(SerialLineTest, HasThreeKinds) {
  for (const char* kind : {"pty", "stdout", "tcp:0", "tcp:65535"}) {
    EXPECT_TRUE(programs::isLineKind(kind)) << kind;
  }
  for (const char* kind : {"", "tty", "tcp:", "tcp:65536", "tcp:-1", "tcp:1x"}) {
    EXPECT_FALSE(programs::isLineKind(kind)) << kind;
  }
}

/// @brief The text of a voltage contains the converter, the input and the volts. Each of these
/// parts is limited to a range.
TEST(SignalsTest, ReadsVoltages) {
  const programs::AnalogSignal signal = programs::analogSignalOf("ADC1_SE23=3.3");
  EXPECT_EQ(signal.converter, 1);
  EXPECT_EQ(signal.channel, 23);
  EXPECT_DOUBLE_EQ(signal.volts, 3.3);
  for (const char* text :
       {"ADC2_SE1=1", "ADC0_SE24=1", "ADC0_SE1=3.4", "ADC0_SE1=-1", "ADC0_SE1"}) {
    EXPECT_ANY_THROW(static_cast<void>(programs::analogSignalOf(text))) << text;
  }
}

/// @brief The text of a level contains the port, the pin and the level. Each of these parts is
/// limited to a range.
TEST(SignalsTest, ReadsLevels) {
  const programs::DigitalSignal signal = programs::digitalSignalOf("PTE31=1");
  EXPECT_EQ(signal.port, 'E');
  EXPECT_EQ(signal.pin, 31);
  EXPECT_TRUE(signal.level);
  EXPECT_FALSE(programs::digitalSignalOf("PTA0=0").level);
  for (const char* text : {"PTF1=1", "PTA32=1", "PTA1=2", "PTA1", "A1=1"}) {
    EXPECT_ANY_THROW(static_cast<void>(programs::digitalSignalOf(text))) << text;
  }
}

}  // namespace
}  // namespace wr::test
