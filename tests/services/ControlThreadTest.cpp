#include "services/ControlThread.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace wr {
namespace {

/// @brief A thread for tests. The test replaces the platform: the thread runs when the test calls
/// dispatch().
class TestThread final : public ControlThread {
 public:
  void dispatch() { run(); }

  /// @brief Runs the thread until all its triggers are served.
  void dispatchAll() {
    while (pended > 0) {
      --pended;
      run();
    }
  }

  std::atomic<int> pended = 0;

 private:
  void pend() override { ++pended; }
};

/// @brief The body of a thread, which is the command that the thread runs. The body counts its
/// activations. In its first activation, the body posts its own thread a number of times.
class Body final : public Command {
 public:
  explicit Body(ControlThread& thread, int posts = 0) : thread_(thread), posts_(posts) {}

  void execute() override {
    ++runs;
    for (; posts_ > 0; --posts_) {
      thread_.post();
    }
  }

  int runs = 0;

 private:
  ControlThread& thread_;
  int posts_;
};

/// @brief A thread without a body rejects posts. A spurious dispatch has no effect.
/// @verifies FR-172
TEST(ControlThread, IsNotPostedBeforeItHasABody) {
  TestThread thread;
  EXPECT_FALSE(thread.post());
  EXPECT_EQ(thread.pended, 0);
  thread.dispatch();
  EXPECT_EQ(thread.overruns(), 0U);
}

/// @brief After each post to an idle thread, the body runs once.
/// @verifies FR-1
/// @verifies FR-172
TEST(ControlThread, RunsItsBodyOncePerPost) {
  TestThread thread;
  Body body(thread);
  thread.start(body);
  EXPECT_TRUE(thread.post());
  thread.dispatchAll();
  EXPECT_TRUE(thread.post());
  thread.dispatchAll();
  EXPECT_EQ(body.runs, 2);
  EXPECT_EQ(thread.overruns(), 0U);
}

/// @brief If a post occurs while the body runs, it is an overrun. The body runs once more.
/// @verifies FR-4
/// @verifies FR-172
TEST(ControlThread, FR4_PostWhileRunningIsCountedAndKept) {
  TestThread thread;
  Body body(thread, 1);
  thread.start(body);
  thread.post();
  thread.dispatchAll();
  EXPECT_EQ(body.runs, 2);
  EXPECT_EQ(thread.overruns(), 1U);
}

/// @brief The thread is posted several times while its body runs. Each post is an overrun, and the
/// body runs once more.
/// @verifies FR-4
/// @verifies FR-172
TEST(ControlThread, FR4_OnlyOnePostIsKept) {
  TestThread thread;
  Body body(thread, 5);
  thread.start(body);
  thread.post();
  thread.dispatchAll();
  EXPECT_EQ(body.runs, 2);
  EXPECT_EQ(thread.overruns(), 5U);
}

/// @brief If a second post occurs before the body has begun, it is also an overrun. Both posts are
/// kept: the body runs twice.
/// @verifies FR-4
/// @verifies FR-172
TEST(ControlThread, FR4_PostBeforeTheBodyBeganIsCountedAndKept) {
  TestThread thread;
  Body body(thread);
  thread.start(body);
  thread.post();
  EXPECT_TRUE(thread.post());
  EXPECT_EQ(thread.pended, 1);
  thread.dispatchAll();
  EXPECT_EQ(body.runs, 2);
  EXPECT_EQ(thread.overruns(), 1U);
}

/// @brief If two posts already wait, a third post causes no further activation. The third post
/// counts as an overrun, but returns true like the other posts.
/// @verifies FR-4
/// @verifies FR-172
TEST(ControlThread, FR4_PostThatIsNotKeptIsCounted) {
  TestThread thread;
  Body body(thread);
  thread.start(body);
  thread.post();
  thread.post();
  EXPECT_TRUE(thread.post());
  thread.dispatchAll();
  EXPECT_EQ(body.runs, 2);
  EXPECT_EQ(thread.overruns(), 2U);
}

/// @brief Each overrun is counted, also after 65535 overruns.
/// @verifies FR-4
TEST(ControlThread, FR4_EachOverrunIsCounted) {
  TestThread thread;
  Body body(thread, 65600);
  thread.start(body);
  thread.post();
  thread.dispatchAll();
  EXPECT_EQ(thread.overruns(), 65600U);
  EXPECT_EQ(body.runs, 2);
}

/// @brief The body of a thread can be set only once.
/// @verifies FR-176
TEST(ControlThreadDeathTest, HasOneBody) {
  TestThread thread;
  Body body(thread);
  thread.start(body);
  EXPECT_DEATH(thread.start(body), "assertion 3 failed");
}

/// @brief At any time of an activation, each post causes a run of the body or counts as an overrun.
/// After the last activation, the thread is idle again.
/// @verifies FR-4
/// @verifies FR-172
TEST(ControlThread, FR4_PostsAtAnyMomentAreNeverLost) {
  constexpr int kPosts = 20000;
  TestThread thread;
  Body body(thread);
  thread.start(body);
  std::atomic<bool> done = false;
  std::thread interrupts([&] {
    for (int i = 0; i < kPosts; ++i) {
      thread.post();
    }
    done = true;
  });
  while (!done) {
    thread.dispatchAll();
  }
  interrupts.join();
  thread.dispatchAll();
  EXPECT_GE(body.runs + static_cast<int>(thread.overruns()), kPosts);
  EXPECT_LE(body.runs, kPosts);
  const int before = body.runs;
  thread.post();
  thread.dispatchAll();
  EXPECT_EQ(body.runs, before + 1);
}

}  // namespace
}  // namespace wr
