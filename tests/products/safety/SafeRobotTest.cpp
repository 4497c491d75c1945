#include "products/safety/SafeRobot.hpp"

namespace wr::test {
namespace {

/// Probe.
TEST_F(SafeRobot, Probe) {
  armByPc();
  std::printf("armed %d inhibit %d cause %d state %d mode %d\n", protection().armed,
              int(protection().inhibit), int(protection().cause), report.state, report.mode);
  const auto show = [&](const char* name) {
    std::printf("%s rpm %.1f %.1f cause %d wheel %d meas %d tension %d cur %d\n", name, rpm(0),
                rpm(3), int(protection().cause), protection().wheel, report.velocity[0],
                report.tension[0], report.current[0]);
  };
  for (int v : {1500, 3000, 0, -3000, 3000, 50, 0}) {
    for (int i = 0; i < 40; ++i) {
      order(1, v);
      if (i % 10 == 9) show("vel");
    }
  }
  for (int v : {24000, 0, -24000, 0, 3000, 0}) {
    for (int i = 0; i < 30; ++i) {
      order(1, v, 1);
      if (i % 5 == 4) show("ten");
    }
  }
  for (int v : {10000, -10000, 0}) {
    for (int i = 0; i < 30; ++i) {
      order(1, v, 2);
      if (i % 5 == 4) show("cur");
    }
  }
  order(50, 0);
  show("end");
}

}  // namespace
}  // namespace wr::test
