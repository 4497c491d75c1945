#include <fstream>

#include "sim/scenario/Scenario.hpp"

namespace wr::scenario {

Scenario Scenario::load(const std::filesystem::path& file) {
  std::ifstream text(file);
  if (!text) {
    throw Error(file.string() + ":0: the file cannot be read");
  }
  return {text, file.string()};
}

}  // namespace wr::scenario
