// The robot of the system tests is the image of the firmware on the virtual K64.

#include "sim/scenario/BoardLine.hpp"
#include "support/image.hpp"
#include "system/SteppedRobot.hpp"

namespace wr::test {

std::unique_ptr<RobotLine> switchOn() {
  return std::make_unique<BoardLine>(readImage(imageFile()), k64::Options{.elf = elfFile()});
}

int referenceSequences() {
  return 300;
}

}  // namespace wr::test
