// Triggers random exceptions. Only the program causes exceptions, because no timer runs. Both
// emulators must handle the exceptions in the same sequence.
#include "torture/program/Log.hpp"
#include "torture/program/Probe.hpp"
#include "torture/program/processor.hpp"

namespace wr::torture {
namespace {

constexpr std::uint32_t kNmi = 2;
constexpr std::uint32_t kHardFault = 3;
constexpr std::uint32_t kFirstLine = 16;
constexpr std::uint32_t kMostPerAction = 150;
constexpr std::uint16_t kUndefined = 0xDE00;  // UDF 0
constexpr std::uint16_t kLoad = 0x6802;       // LDR R2, [R0]

constinit Log log{};
constinit std::uint32_t randomState{};
constinit std::uint32_t depth{};
constinit std::uint32_t links{};       // low byte of EXC_RETURN of the running exception
constinit std::uint32_t unmaskable{};  // active exceptions that only NMI preempts
constinit std::uint32_t entered{};     // exceptions since the last action of thread mode

std::uint32_t random() {
  randomState ^= randomState << 13;
  randomState ^= randomState >> 17;
  randomState ^= randomState << 5;
  return randomState;
}

std::uint32_t random(std::uint32_t below) {
  return (random() >> 8) % below;
}

std::uint32_t randomPriority() {
  return random(16) << 4;
}

constexpr std::uint32_t bit(std::uint32_t number) {
  return std::uint32_t{1} << number;
}

/// @brief Returns one to four interrupt lines, as bits. These lines often include the interrupt
/// line whose handler runs.
std::uint32_t randomLines() {
  std::uint32_t lines = bit(random(32));
  if (random(3) == 0) {
    lines |= bit(random(32)) | bit(random(32));
  }
  const std::uint32_t running = exceptionNumber();
  if (running >= kFirstLine && random(4) == 0) {
    lines |= bit(running - kFirstLine);
  }
  return lines;
}

void note(Kind kind, std::uint32_t detail) {
  // ICSR is compared without the bits that processors may compute in different ways. VECTPENDING
  // may be computed with or without BASEPRI, and ISRPENDING with or without the lines that are not
  // enabled. RETTOBASE may differ in thread mode.
  const std::uint32_t controlBits = depth == 0 ? 0x940001FF : 0x940009FF;
  const Masks now = masks();
  log.add({kind,
           static_cast<std::uint8_t>(detail),
           static_cast<std::uint8_t>(depth),
           static_cast<std::uint8_t>(links),
           {read(kInterruptControl) & controlBits, read(kSystemHandlers), read(kActive),
            read(kSetPending),
            now.basePriority | now.interrupts << 8 | now.faults << 9 | control() << 16}});
}

void note(Action action) {
  note(Kind::Acted, static_cast<std::uint32_t>(action));
}

void noteFailure(std::uint32_t check, std::uint32_t wanted, std::uint32_t found) {
  log.add({Kind::CheckFailed,
           static_cast<std::uint8_t>(check),
           static_cast<std::uint8_t>(depth),
           static_cast<std::uint8_t>(links),
           {wanted, found}});
}

void check(std::uint32_t what, std::uint32_t wanted, std::uint32_t found) {
  if (wanted != found) {
    noteFailure(what, wanted, found);
  }
}

void check(Check what, std::uint32_t wanted, std::uint32_t found) {
  check(static_cast<std::uint32_t>(what), wanted, found);
}

/// @brief Returns random values for all registers except R0 and R1.
Probe filled(std::uint32_t r0, std::uint32_t r1) {
  Probe probe;
  for (std::uint32_t& value : probe.core) {
    value = random();
  }
  probe.core[0] = r0;
  probe.core[1] = r1;
  probe.flags = random() & 0xF80F0000;
  probe.pad = random(2) * 4;
  probe.usesFp = random(2);
  probe.fpStatus = random() & 0xF7C0009F;
  for (std::uint32_t& value : probe.fp) {
    value = random();
  }
  return probe;
}

void checkRegisters(const Probe& probe) {
  for (std::uint32_t i = 0; i < probe.core.size(); ++i) {
    check(i, probe.core[i], probe.coreAfter[i]);
  }
  check(Check::Flags, probe.flags, probe.flagsAfter);
  check(Check::StackPointer, probe.stackBefore, probe.stackAfter);
  if (probe.usesFp == 0) {
    return;
  }
  check(Check::FpStatus, probe.fpStatus, probe.fpStatusAfter);
  log.add({Kind::FpMode,
           static_cast<std::uint8_t>(exceptionNumber()),
           static_cast<std::uint8_t>(depth),
           static_cast<std::uint8_t>(links),
           {probe.fpStatusAtStart & 0x07C00000}});
  for (std::uint32_t i = 0; i < probe.fp.size(); ++i) {
    check(32 + i, probe.fp[i], probe.fpAfter[i]);
  }
}

void store(std::uint32_t address, std::uint32_t value) {
  Probe probe = filled(address, value);
  probeStore(probe);
  checkRegisters(probe);
}

void storeInItBlock(std::uint32_t address, std::uint32_t value) {
  Probe probe = filled(address, value);
  probe.flags |= bit(30);  // Z
  probeItBlock(probe);
  probe.core[2] = probe.core[3];
  checkRegisters(probe);
}

void cause(void (*fault)(Probe&)) {
  Probe probe = filled(kNoMemory, random());
  fault(probe);
  checkRegisters(probe);
}

void pendSystem() {
  constexpr std::uint32_t kBits[] = {bit(31), bit(28), bit(28), bit(28) | bit(26),
                                     bit(26), bit(26), bit(27), bit(25)};
  store(kInterruptControl, kBits[random(8)]);
}

/// @brief Sets a random priority for one of these exceptions: memory fault, bus fault, usage fault,
/// SVC, PendSV and SysTick.
void setSystemPriority() {
  constexpr std::uint8_t kOffsets[] = {0, 1, 2, 7, 10, 11};
  at<std::uint8_t>(kSystemPriority + kOffsets[random(6)]) =
      static_cast<std::uint8_t>(randomPriority());
  synchronize();
}

void setPriority() {
  at<std::uint8_t>(kPriority + random(32)) = static_cast<std::uint8_t>(randomPriority());
  synchronize();
}

/// @brief Sets the priorities of four interrupt lines in one access.
void setPriorities() {
  write(kPriority + random(8) * 4, random() & 0xF0F0F0F0);
}

/// @brief Enables or disables the separate handlers of the memory, bus and usage faults. Without
/// its handler, a fault becomes a hard fault.
void enableFaults() {
  const std::uint32_t others = read(kSystemHandlers) & ~(bit(16) | bit(17) | bit(18));
  write(kSystemHandlers, others | random(8) << 16);
}

void setGrouping() {
  const std::uint32_t grouping = random(2) == 0 ? 0 : random(8);
  write(kReset, 0x05FA0000 | grouping << 8);
}

void act(std::uint32_t inner);

void actWhileMasked(std::uint32_t inner) {
  for (std::uint32_t i = random(4); i > 0; --i) {
    act(inner + 1);
  }
}

void raiseBasePriority(std::uint32_t inner) {
  const std::uint32_t before = masks().basePriority;
  const std::uint32_t wanted = randomPriority();
  if (random(2) == 0) {
    torture::raiseBasePriority(wanted);
  } else {
    setBasePriority(wanted);
  }
  actWhileMasked(inner);
  setBasePriority(before);
}

void maskInterrupts(std::uint32_t inner) {
  const std::uint32_t before = masks().interrupts;
  setInterruptMask(1);
  actWhileMasked(inner);
  setInterruptMask(before);
}

/// @brief Masks faults. Sometimes the handler of an exception returns while the mask is set. This
/// return clears the mask.
void maskFaults(std::uint32_t inner) {
  if (unmaskable > 0) {
    return;
  }
  const std::uint32_t before = masks().faults;
  setFaultMask(1);
  actWhileMasked(inner);
  if (depth == 0 || random(4) != 0) {
    setFaultMask(before);
  }
}

/// @brief Puts thread mode to sleep while an interrupt is pending, as an idle loop with masked
/// interrupts does.
void sleep() {
  const Masks now = masks();
  if (depth > 0 || now.basePriority + now.interrupts + now.faults > 0) {
    return;
  }
  const std::uint32_t line = random(32);
  setInterruptMask(1);
  at<std::uint8_t>(kPriority + line) = 0x40;
  write(kSetEnable, bit(line));
  write(kSetPending, bit(line));
  waitForInterrupt();
  setInterruptMask(0);
}

/// @brief Clears the flag which shows that the floating-point registers are in use. The next
/// exception then does not preserve these registers.
void forgetFloatingPoint() {
  if (depth == 0) {
    setControl(control() & ~bit(2));
  }
}

bool mayFault() {
  return unmaskable == 0 && masks().faults == 0;
}

void perform(Action action, std::uint32_t inner) {
  switch (action) {
    case Action::PendLines:
      store(kSetPending, randomLines());
      break;
    case Action::PendSystem:
      pendSystem();
      break;
    case Action::PendByNumber:
      store(kTrigger, random(32));
      break;
    case Action::ClearPending:
      store(kClearPending, random() & random());
      break;
    case Action::CallSupervisor:
      if (mayFault()) cause(probeSupervisor);
      break;
    case Action::UndefinedInstruction:
      if (mayFault()) cause(probeUndefined);
      break;
    case Action::BusError:
      if (mayFault()) cause(probeBusError);
      break;
    case Action::PendInItBlock:
      storeInItBlock(kSetPending, randomLines());
      break;
    case Action::SetPriority:
      setPriority();
      break;
    case Action::SetSystemPriority:
      setSystemPriority();
      break;
    case Action::SetPriorities:
      setPriorities();
      break;
    case Action::EnableLines:
      write(kSetEnable, random() | random());
      break;
    case Action::DisableLines:
      write(kClearEnable, random() & random() & random());
      break;
    case Action::EnableFaults:
      enableFaults();
      break;
    case Action::SetGrouping:
      setGrouping();
      break;
    case Action::RaiseBasePriority:
      raiseBasePriority(inner);
      break;
    case Action::MaskInterrupts:
      maskInterrupts(inner);
      break;
    case Action::MaskFaults:
      maskFaults(inner);
      break;
    case Action::ForgetFloatingPoint:
      forgetFloatingPoint();
      break;
    case Action::WaitForInterrupt:
      sleep();
      break;
    case Action::End:
      break;
  }
}

Action randomAction(std::uint32_t inner) {
  const std::uint32_t choice = random(64);
  if (choice < 20) {
    return Action::PendLines;
  }
  if (choice < 26) {
    return Action::PendSystem;
  }
  // A section is an action that runs other actions inside. Sections are nested at most twice.
  const auto kinds = static_cast<std::uint32_t>(Action::End);
  const auto action = static_cast<Action>(choice - 26 < kinds ? choice - 26 : random(kinds));
  const bool section = action == Action::RaiseBasePriority || action == Action::MaskInterrupts ||
                       action == Action::MaskFaults;
  return section && inner > 1 ? Action::PendLines : action;
}

void act(std::uint32_t inner) {
  if (entered > kMostPerAction) {
    return;
  }
  const Action action = randomAction(inner);
  perform(action, inner);
  note(action);
}

/// @brief Records the state after a fault, and clears this state. The program then continues after
/// the instruction that caused the fault.
void settleFault(std::uint32_t* frame) {
  const std::uint32_t status = read(kFaultStatus);
  const std::uint32_t address = (status & bit(15)) != 0 ? read(kBusFaultAddress) : 0;
  log.add({Kind::Fault,
           static_cast<std::uint8_t>(exceptionNumber()),
           static_cast<std::uint8_t>(depth),
           static_cast<std::uint8_t>(links),
           {status, read(kHardFaultStatus), address, frame[6], frame[7] & ~std::uint32_t{0xFE00}}});
  write(kFaultStatus, status);
  write(kHardFaultStatus, read(kHardFaultStatus));
  const std::uint16_t instruction = *reinterpret_cast<const std::uint16_t*>(frame[6]);
  if (instruction == kUndefined || instruction == kLoad) {
    frame[6] += 2;
  }
}

}  // namespace

extern "C" {

void handle(std::uint32_t link, std::uint32_t* frame) {
  const std::uint32_t exception = exceptionNumber();
  const std::uint32_t linkBefore = links;
  const bool hard = exception == kNmi || exception == kHardFault;
  links = link & 0xFF;
  ++depth;
  ++entered;
  unmaskable += hard ? 1 : 0;
  note(Kind::Entered, exception);
  if (exception >= kHardFault && exception <= 6) {
    settleFault(frame);
  }
  constexpr std::uint8_t kActions[] = {0, 0, 0, 1, 1, 1, 2, 3};
  for (std::uint32_t i = kActions[random(8)]; i > 0; --i) {
    act(0);
  }
  note(Kind::Left, exception);
  unmaskable -= hard ? 1 : 0;
  --depth;
  links = linkBefore;
}

[[noreturn]] void run() {
  randomState = read(kSeedAddress) * 2654435761U | 1;
  for (std::uint32_t i = 0; i < 8; ++i) {
    write(kPriority + i * 4, random() & 0xF0F0F0F0);
  }
  write(kSetEnable, random() | random());
  for (std::uint32_t left = read(kActionsAddress); left > 0; --left) {
    entered = 0;
    act(0);
    log.hand();
  }
  write(kSetEnable, 0xFFFFFFFF);
  note(Action::End);
  log.end();
  while (true) {
  }
}
}

}  // namespace wr::torture
