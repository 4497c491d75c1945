#include "torture/VirtualProcessor.hpp"

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "sim/emulator/CortexM4.hpp"

namespace wr::torture {
namespace {

using emulator::CortexM4;

constexpr unsigned kLines = 32;
constexpr unsigned kPriorityBits = 4;
constexpr std::uint64_t kMostCycles = 100'000'000;

// Operations of the semihosting specification of Arm.
constexpr std::uint32_t kOpen = 0x01;
constexpr std::uint32_t kWrite = 0x05;
constexpr std::uint32_t kExit = 0x18;

/// @brief The semihosting requests of the program to the emulator: write bytes, and end the
/// program.
class Semihosting {
 public:
  void serve(CortexM4& processor) {
    const std::uint32_t parameters = processor.core(1);
    switch (processor.core(0)) {
      case kOpen:
        processor.setCore(0, 1);
        break;
      case kWrite:
        write(processor, processor.word(parameters + 4), processor.word(parameters + 8));
        processor.setCore(0, 0);
        break;
      case kExit:
        processor.exit();
        break;
      default:
        processor.report("semihosting", "unknown operation");
        break;
    }
  }

  [[nodiscard]] const std::vector<std::uint8_t>& written() const { return written_; }

 private:
  void write(const CortexM4& processor, std::uint32_t address, std::uint32_t size) {
    for (std::uint32_t i = 0; i < size; i += 4) {
      const std::uint32_t word = processor.word(address + i);
      for (unsigned shift = 0; shift < 32; shift += 8) {
        written_.push_back(static_cast<std::uint8_t>(word >> shift));
      }
    }
  }

  std::vector<std::uint8_t> written_;
};

std::string reason(const CortexM4& processor, CortexM4::Stop stop) {
  if (stop == CortexM4::Stop::Problem && processor.problem()) {
    return processor.problem()->id + ": " + processor.problem()->what + ", at " +
           std::to_string(processor.problem()->pc);
  }
  return stop == CortexM4::Stop::Sleep ? "it sleeps, and no exception wakes it" : "it does not end";
}

}  // namespace

Records VirtualProcessor::run(const Image& image) {
  Semihosting semihosting;
  CortexM4 processor(kLines, kPriorityBits);
  processor.mapMemory(0, kCodeSize, CortexM4::Access::ReadExecute);
  processor.mapMemory(kRamStart, kRamSize, CortexM4::Access::ReadWrite);
  processor.setFaultsAreProblems(false);
  processor.onSemihosting([&semihosting](CortexM4& caller) { semihosting.serve(caller); });
  processor.load(0, image);
  processor.reset();
  const CortexM4::Stop stop = processor.run(kMostCycles);
  if (stop != CortexM4::Stop::Exit) {
    throw std::runtime_error("the torture program on the virtual K64: " + reason(processor, stop));
  }
  return recordsIn(semihosting.written());
}

}  // namespace wr::torture
