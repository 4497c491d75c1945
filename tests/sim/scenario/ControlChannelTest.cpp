#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <string>

#include "sim/host_robot/HostSession.hpp"
#include "sim/scenario/ControlChannel.hpp"

namespace wr::test {
namespace {

using testing::HasSubstr;

// The operator's end of the channel. This end has a named socket that sends actions and receives
// answers.
class Operator {
 public:
  Operator(const std::string& path, const std::string& channel) : path_(path) {
    socket_ = socket(AF_UNIX, SOCK_DGRAM, 0);
    const sockaddr_un own = addressOf(path);
    const sockaddr_un other = addressOf(channel);
    EXPECT_EQ(bind(socket_, reinterpret_cast<const sockaddr*>(&own), sizeof own), 0);
    EXPECT_EQ(connect(socket_, reinterpret_cast<const sockaddr*>(&other), sizeof other), 0);
  }
  Operator(const Operator&) = delete;
  Operator& operator=(const Operator&) = delete;
  ~Operator() {
    close(socket_);
    std::filesystem::remove(path_);
  }

  void say(const std::string& words) const { send(socket_, words.data(), words.size(), 0); }

  [[nodiscard]] std::string answer() const {
    std::array<char, 512> text{};
    const ssize_t count = recv(socket_, text.data(), text.size(), MSG_DONTWAIT);
    return count < 0 ? "nothing" : std::string(text.data(), static_cast<std::size_t>(count));
  }

 private:
  static sockaddr_un addressOf(const std::string& path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.copy(static_cast<char*>(address.sun_path), sizeof address.sun_path - 1);
    return address;
  }

  std::string path_;
  int socket_;
};

class ControlChannelTest : public testing::Test {
 protected:
  ControlChannelTest() { robot.start(); }
  ~ControlChannelTest() override { std::filesystem::remove_all(folder); }

  /// Runs the robot for 2 s.
  void rest() {
    for (int step = 0; step <= 2000; ++step) {
      (void)robot.robot().step();
    }
  }

  host_robot::HostSession robot;
  const std::string folder =
      std::filesystem::temp_directory_path() / ("wr-control-" + std::to_string(getpid()));
  const std::string path = folder + "/channel";
  const bool made = std::filesystem::create_directory(folder);
};

/// @brief An action changes the simulated robot or the ground. A second action of the same kind
/// replaces the first action. A slope has its full value after 2 s.
TEST_F(ControlChannelTest, ActionsActOnTheRobotThatRuns) {
  scenario::ControlChannel channel("", robot);
  EXPECT_EQ(channel.perform("slope 10"), "ok");
  EXPECT_EQ(channel.perform("fault current 0"), "ok");
  rest();
  EXPECT_DOUBLE_EQ(robot.robot().slope(), 10);
  EXPECT_EQ(channel.perform("slope -5"), "ok");
  rest();
  EXPECT_DOUBLE_EQ(robot.robot().slope(), -5);
}

/// @brief The time of the robot does not advance during an action.
TEST_F(ControlChannelTest, AnActionTakesNoTime) {
  scenario::ControlChannel channel("", robot);
  const scenario::RobotSession::Time before = robot.now();
  EXPECT_EQ(channel.perform("noise off"), "ok");
  EXPECT_EQ(robot.now(), before);
}

/// @brief If an expectation about the robot is met, the channel answers "ok". Otherwise, the
/// channel answers with an error.
TEST_F(ControlChannelTest, AnExpectationIsAnswered) {
  scenario::ControlChannel channel("", robot);
  EXPECT_EQ(channel.perform("expect true_velocity0 between -1 1"), "ok");
  EXPECT_THAT(channel.perform("expect true_velocity0 between 5 100"),
              HasSubstr("true_velocity0 is 0.0, not between 5 and 100"));
}

/// @brief If a text is not an action, the answer is an error.
TEST_F(ControlChannelTest, WordsThatAreNoActionAreRefused) {
  scenario::ControlChannel channel("", robot);
  EXPECT_THAT(channel.perform("fly"), HasSubstr("there is no action 'fly'"));
  EXPECT_THAT(channel.perform(""), HasSubstr("missing"));
  EXPECT_THAT(channel.perform("slope 1\nat 0 slope 2"), HasSubstr("one line"));
}

/// @brief Actions of the PC are rejected, because another program may already use the PC link.
/// Other actions that need a scenario are rejected too.
TEST_F(ControlChannelTest, ActionsOfThePcAreRefused) {
  scenario::ControlChannel channel("", robot);
  for (const char* words : {"connect", "hello", "order velocity 5", "bytes 00", "mark", "arm"}) {
    EXPECT_THAT(channel.perform(words), HasSubstr("only possible in a scenario")) << words;
  }
  EXPECT_EQ(robot.takeSent().size(), 0U);
}

/// @brief A sender with a bound socket gets an answer to each datagram. When the channel is
/// destroyed, its socket is removed.
TEST_F(ControlChannelTest, TheSocketAnswersItsSender) {
  {
    scenario::ControlChannel channel(path, robot);
    const Operator person(folder + "/operator", path);
    channel.serve();
    EXPECT_EQ(person.answer(), "nothing");
    person.say("slope 3");
    person.say("fly");
    channel.serve();
    EXPECT_EQ(person.answer(), "ok");
    EXPECT_THAT(person.answer(), HasSubstr("there is no action"));
    rest();
    EXPECT_DOUBLE_EQ(robot.robot().slope(), 3);
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

/// @brief The channel replaces a socket that an earlier simulator has left behind. A file of
/// another kind is not replaced.
TEST_F(ControlChannelTest, AnOldSocketIsReplacedAndAnotherFileIsNot) {
  const int old = socket(AF_UNIX, SOCK_DGRAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.copy(static_cast<char*>(address.sun_path), sizeof address.sun_path - 1);
  ASSERT_EQ(bind(old, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  close(old);
  { const scenario::ControlChannel channel(path, robot); }
  std::FILE* const file = std::fopen(path.c_str(), "w");
  std::fclose(file);
  EXPECT_ANY_THROW(scenario::ControlChannel(path, robot));
  EXPECT_TRUE(std::filesystem::exists(path));
}

/// @brief A path that is too long for a socket is rejected.
TEST_F(ControlChannelTest, APathThatIsTooLongIsRefused) {
  EXPECT_THROW(scenario::ControlChannel(folder + "/" + std::string(200, 'x'), robot),
               std::invalid_argument);
}

}  // namespace
}  // namespace wr::test
