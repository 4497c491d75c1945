#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/board_robot/BoardSession.hpp"
#include "sim/faults/InjectedFault.hpp"
#include "sim/faults/Verdict.hpp"
#include "sim/scenario/PcFrames.hpp"

namespace wr::faults {

/// @brief An injected fault and its effects.
struct Result {
  InjectedFault fault;
  int at = 0;            ///< ms since the drive began
  std::uint32_t pc = 0;  ///< address of the instruction at the injection
  Verdict verdict;
  std::string stop;  ///< finding or error that stopped the virtual board, if the outcome is Stopped
};

/// @brief A test drive and copies of this test drive. A firmware image on the virtual board gets
/// random orders. One fault is injected into each copy.
///
/// Each copy is a separate process that begins at the injection of the fault. In this way, a copy
/// need not repeat the earlier part of the test drive.
class FaultRun {
 public:
  static constexpr int kFirst = 1500;  ///< earliest injection [ms since the drive began]
  static constexpr int kLast = 6500;   ///< latest injection [ms since the drive began]

  /// @brief Runs the test drive without a fault. Throws std::runtime_error if the robot does not
  /// drive.
  /// @param image firmware image, which is the content of the flash
  /// @param elf ELF file of the firmware image, with its symbols
  /// @param seed chooses the drive
  FaultRun(std::vector<std::uint8_t> image, const std::filesystem::path& elf, std::uint64_t seed);

  /// @brief Returns the memory and the interrupts that faults can affect.
  [[nodiscard]] const Places& places() const { return places_; }

  /// @brief Injects random faults.
  /// @param count number of faults
  /// @param random source of the random choices
  /// @param only all faults have this kind; without a value, each fault has a random kind
  /// @param take gets each result, in the order of the times of injection
  void injectAll(int count, Random& random, std::optional<Kind> only,
                 const std::function<void(const Result&)>& take);

  /// @brief Injects one fault.
  /// @param fault the fault
  /// @param at ms since the drive began, kFirst to kLast
  [[nodiscard]] Result injectOne(const InjectedFault& fault, int at);

 private:
  class Robot;
  using Choice = std::function<InjectedFault(Robot&)>;

  /// Runs a copy of the robot with the fault that `choice` returns.
  [[nodiscard]] Result observe(Robot& robot, const Choice& choice) const;
  [[nodiscard]] Verdict runCopy(Robot& robot, const InjectedFault& fault, int at,
                                bool silentPc) const;

  std::vector<std::uint8_t> image_;
  std::uint64_t seed_;
  Places places_;
  std::vector<Outputs> reference_;
  std::vector<std::uint64_t> states_;        ///< state of the reference run every 100 ms
  std::vector<scenario::PcReport> reports_;  ///< reports of the reference run
};

}  // namespace wr::faults
