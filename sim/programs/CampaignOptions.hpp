#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "sim/programs/Program.hpp"

namespace wr::programs {

/// @brief The options of a program that runs random cases for a campaign. A case is a drive, or a
/// fault that is injected into a drive.
struct CampaignOptions {
  std::string image;       ///< file with the content of the flash
  std::string elf;         ///< ELF file of the firmware image, with its symbols
  std::uint64_t seed = 1;  ///< seed of the random choice of the cases
  int count = 1;           ///< number of cases

  /// @brief Adds the options of a campaign to the options of a program.
  /// @param app options of the program
  void addTo(CLI::App& app) {
    app.add_option("--image", image, "file with the content of the flash from address 0")
        ->required()
        ->type_name("PATH")
        ->check(CLI::ExistingFile);
    app.add_option("--elf", elf, "ELF file with the symbols of the firmware image")
        ->required()
        ->type_name("PATH")
        ->check(CLI::ExistingFile);
    app.add_option("--seed", seed, "chooses the cases [1]")->type_name("NUMBER");
    app.add_option("--count", count, "number of cases [1]")
        ->type_name("NUMBER")
        ->check(greaterThanZero());
  }
};

}  // namespace wr::programs
