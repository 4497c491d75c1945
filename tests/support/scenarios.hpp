#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace wr::test {

/// @brief Returns the files of all scenarios, sorted by folder and name.
inline std::vector<std::filesystem::path> allScenarios() {
  const auto folder = std::filesystem::path(WR_SOURCE_DIR) / "sim/scenario";
  std::vector<std::filesystem::path> files;
  for (const auto& file : std::filesystem::recursive_directory_iterator(folder)) {
    if (file.path().extension() == ".scenario") {
      files.push_back(file.path());
    }
  }
  std::ranges::sort(files);
  return files;
}

/// @brief Returns true if a scenario is only for the paper's design. In such a scenario, safety
/// functions would stop the robot, or limit its acceleration or its current.
/// @param file file of the scenario
inline bool isOfThePaperAlone(const std::filesystem::path& file) {
  constexpr std::array<const char*, 4> kNames{"one_hall_sensor", "reversal", "sensors_broken",
                                              "wheel_blocked"};
  return std::ranges::find(kNames, file.stem().string()) != kNames.end();
}

}  // namespace wr::test
