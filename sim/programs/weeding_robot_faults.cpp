#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>

#include "sim/emulator/Image.hpp"
#include "sim/faults/FaultRun.hpp"
#include "sim/programs/CampaignOptions.hpp"
#include "sim/programs/Program.hpp"

namespace wr::programs {

namespace {

// One line of JSON; no text has a character that JSON would have to escape.
void print(const faults::Result& result) {
  std::printf(
      R"({"kind": "%s", "at": %d, "place": %u, "bit": %u, "value": %d, "pc": %u, "outcome": "%s", )"
      R"("safe_after": %d, "wrong_for": %d, "stop": "%s"})"
      "\n",
      std::string(nameOf(result.fault.kind)).c_str(), result.at, result.fault.place,
      result.fault.bit, result.fault.value, result.pc,
      std::string(nameOf(result.verdict.outcome)).c_str(), result.verdict.safeAfter,
      result.verdict.wrongFor, result.stop.c_str());
  std::fflush(stdout);  // a copy of this process must not print this text again
}

Exit run(const CampaignOptions& settings) {
  faults::FaultRun drive(emulator::readImage(settings.image), settings.elf, settings.seed);
  faults::Random random(settings.seed);
  drive.injectAll(settings.count, random, print);
  return Exit::Done;
}

}  // namespace

}  // namespace wr::programs

int main(int count, char** arguments) try {
  wr::programs::CampaignOptions settings;
  CLI::App app(
      "Runs a random drive of a raw image of a K64 on the virtual board, and copies of it with "
      "one\n"
      "injected fault each. Prints a line of JSON for each fault.",
      "weeding_robot_faults");
  settings.addTo(app);
  return wr::programs::runProgram(app, count, arguments,
                                  [&settings] { return wr::programs::run(settings); });
} catch (const std::exception& error) {
  std::fprintf(stderr, "weeding_robot_faults: %s\n", error.what());
  return EXIT_FAILURE;
} catch (...) {
  return EXIT_FAILURE;
}
