#include <CLI/CLI.hpp>
#include <array>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "sim/emulator/Image.hpp"
#include "sim/faults/FaultRun.hpp"
#include "sim/programs/CampaignOptions.hpp"
#include "sim/programs/Program.hpp"

namespace wr::programs {

namespace {

// Prints a result as one line of JSON. The printed texts contain no character that must be escaped
// in JSON.
void print(const faults::Result& result) {
  std::printf(
      R"({"kind": "%s", "at": %d, "place": %u, "bit": %u, "value": %d, "pc": %u, "outcome": "%s", )"
      R"("safe_after": %d, "wrong_for": %d, "stop": "%s"})"
      "\n",
      std::string(nameOf(result.fault.kind)).c_str(), result.at, result.fault.place,
      result.fault.bit, result.fault.value, result.pc,
      std::string(nameOf(result.verdict.outcome)).c_str(), result.verdict.safeAfter,
      result.verdict.wrongFor, result.stop.c_str());
  std::fflush(stdout);  // otherwise, a copy of this process prints the text again
}

// A case that the option --case repeats: a fault, and the time in the drive at which the fault is
// injected [ms].
struct Case {
  int at;
  faults::InjectedFault fault;
};

Exit run(const CampaignOptions& settings, std::optional<faults::Kind> only,
         const std::vector<Case>& cases) {
  faults::FaultRun drive(emulator::readImage(settings.image), settings.elf, settings.seed);
  for (const Case& repeated : cases) {
    print(drive.injectOne(repeated.fault, repeated.at));
  }
  if (!cases.empty()) {
    return Exit::Done;
  }
  faults::Random random(settings.seed);
  drive.injectAll(settings.count, random, only, print);
  return Exit::Done;
}

}  // namespace

}  // namespace wr::programs

int main(int count, char** arguments) try {
  wr::programs::CampaignOptions settings;
  CLI::App app(
      "Runs a random drive of the robot with a raw firmware image on the virtual K64. Then runs "
      "copies\n"
      "of the drive, each with one injected fault. Prints a line of JSON for each fault.",
      "weeding_robot_faults");
  settings.addTo(app);
  std::string only;
  auto* kinds = app.add_option("--only", only, "kind of all faults [each fault has a random kind]")
                    ->type_name("KIND")
                    ->check([](const std::string& name) {
                      return wr::faults::kindOf(name)
                                 ? ""
                                 : "there is no kind " + name +
                                       "; choose from ram, code, stack, register, flash, "
                                       "interrupt, sensor, serial, clock, supply";
                    });
  std::vector<std::array<std::int64_t, 4>> cases;
  app.add_option(
         "--case", cases,
         "repeat one fault; --only names its kind; NUMBERS are the values of 'at', 'place', 'bit'\n"
         "and 'value' in its line of JSON; may be repeated")
      ->type_name("NUMBERS")
      ->needs(kinds);
  return wr::programs::runProgram(app, count, arguments, [&] {
    const std::optional<wr::faults::Kind> kind = wr::faults::kindOf(only);
    std::vector<wr::programs::Case> repeated;
    repeated.reserve(cases.size());
    for (const auto& [at, place, bit, value] : cases) {
      repeated.push_back({static_cast<int>(at),
                          {kind.value(), static_cast<std::uint32_t>(place),
                           static_cast<std::uint32_t>(bit), static_cast<int>(value)}});
    }
    return wr::programs::run(settings, kind, repeated);
  });
} catch (const std::exception& error) {
  std::fprintf(stderr, "weeding_robot_faults: %s\n", error.what());
  return EXIT_FAILURE;
} catch (...) {
  return EXIT_FAILURE;
}
