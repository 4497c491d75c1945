#include "sim/emulator/processor/Core.hpp"
#include "sim/emulator/processor/Encoding.hpp"

namespace wr::emulator {

namespace {

void raiseUndefined(Core& core, const Instruction& /*in*/) {
  core.trap(Trap::Undefined);
}

// A5.2.5
Instruction shortMiscellaneous(Encoding code) {
  switch (code.field(11, 8)) {
    case 0b0000: {
      const std::uint32_t distance = code.field(6, 0) * 4;
      return addToStackPointer(Registers::kStack, Registers::kStack,
                               code.bit(7) ? 0 - distance : distance);
    }
    case 0b0001:
    case 0b0011:
    case 0b1001:
    case 0b1011:
      return compareAndBranch(code);
    case 0b0010:
    case 0b1010:
      return shortExtendOrReverse(code);
    case 0b0100:
    case 0b0101:
    case 0b1100:
    case 0b1101:
      return shortLoadStoreMultiple(code);
    default:
      return shortSystem(code);
  }
}

// A5.2
Instruction decodeShort(Encoding code) {
  switch (code.field(15, 12)) {
    case 0b0000:
    case 0b0001:
    case 0b0010:
    case 0b0011:
      return shortDataProcessing(code);
    case 0b0100:
      if (code.bit(11)) {
        return shortLoadStore(code);
      }
      return code.field(10, 8) == 0b111 ? branchAndExchange(code) : shortDataProcessing(code);
    case 0b0101:
    case 0b0110:
    case 0b0111:
    case 0b1000:
    case 0b1001:
      return shortLoadStore(code);
    case 0b1010:
      return code.bit(11) ? addToStackPointer(code.low(8), Registers::kStack, code.field(7, 0) * 4)
                          : addToPc(code.low(8), code.field(7, 0) * 4);
    case 0b1011:
      return shortMiscellaneous(code);
    case 0b1100:
      return shortLoadStoreMultiple(code);
    case 0b1101:
      return code.field(11, 9) == 0b111 ? shortSystem(code) : shortBranch(code);
    default:
      return shortBranch(code);
  }
}

// A5.3.12
Instruction registers(Encoding code) {
  if (code.field(15, 12) != 15) {
    return undefined();
  }
  if (!code.bit(23)) {
    return code.bit(7) ? extend(code) : code.field(6, 4) == 0 ? shiftByRegister(code) : undefined();
  }
  if (!code.bit(7)) {
    return parallelAddition(code);
  }
  return code.bit(6) ? undefined() : miscellaneous(code);
}

// A5.3
Instruction decodeLong(Encoding code) {
  switch (code.field(28, 27)) {
    case 0b01:
      if (code.bit(26)) {
        return coprocessor(code);
      }
      if (code.bit(25)) {
        return dataProcessingRegister(code);
      }
      return code.bit(22) ? loadStoreDual(code) : loadStoreMultiple(code);
    case 0b10:
      if (!code.bit(15)) {
        return code.bit(25) ? plainImmediate(code) : dataProcessingImmediate(code);
      }
      return !code.bit(14) && !code.bit(12) && code.field(25, 23) == 0b111 ? system(code)
                                                                           : branch(code);
    default:
      if (code.bit(26)) {
        return coprocessor(code);
      }
      if (!code.bit(25)) {
        return loadStoreSingle(code);
      }
      if (!code.bit(24)) {
        return registers(code);
      }
      return code.bit(23) ? longMultiply(code) : multiply(code);
  }
}

}  // namespace

Instruction undefined() {
  return {.run = raiseUndefined};
}

Instruction decode(Encoding code, bool wide) {
  return wide ? decodeLong(code) : decodeShort(code);
}

}  // namespace wr::emulator
