#include "decode.hpp"

#include <array>
#include <capstone/capstone.h>
#include <span>
#include <stdexcept>

#include "kinds.hpp"

namespace iog::a9_model {
namespace {

// Registers by their number in capstone, where those of a file follow one another.
CoreSet core_set(int reg) {
  if (reg >= ARM_REG_R0 && reg <= ARM_REG_R12) {
    return core_bit(static_cast<unsigned>(reg - ARM_REG_R0));
  }
  switch (reg) {
    case ARM_REG_SP:
      return core_bit(kStackPointer);
    case ARM_REG_LR:
      return core_bit(kLinkRegister);
    case ARM_REG_PC:
      return core_bit(kProgramCounter);
    case ARM_REG_APSR:
    case ARM_REG_APSR_NZCV:
      return core_bit(kFlags);
    default:
      return 0;
  }
}

VectorSet vector_set(int reg) {
  if (reg >= ARM_REG_S0 && reg <= ARM_REG_S31) {
    return singles(static_cast<unsigned>(reg - ARM_REG_S0), 1);
  }
  if (reg >= ARM_REG_D0 && reg <= ARM_REG_D31) {
    return doubles(static_cast<unsigned>(reg - ARM_REG_D0), 1);
  }
  if (reg >= ARM_REG_Q0 && reg <= ARM_REG_Q15) {
    return doubles(2 * static_cast<unsigned>(reg - ARM_REG_Q0), 2);
  }
  const bool is_status = reg == ARM_REG_FPSCR || reg == ARM_REG_FPSCR_NZCV;
  return is_status ? vector_bit(kVectorFlags) : 0;
}

bool is_quad(const cs_arm_op& operand) {
  return operand.type == ARM_OP_REG && operand.reg >= ARM_REG_Q0 && operand.reg <= ARM_REG_Q15;
}
bool is_whole_double(const cs_arm_op& operand) {
  return operand.type == ARM_OP_REG && operand.reg >= ARM_REG_D0 && operand.reg <= ARM_REG_D31 &&
         operand.vector_index < 0;
}

bool is_memory(Kind kind) { return kind >= Kind::kLoad && kind <= Kind::kVectorStore; }

constexpr std::uint8_t kRead = CS_AC_READ;
constexpr std::uint8_t kWritten = CS_AC_WRITE;
constexpr std::uint8_t kBoth = CS_AC_READ | CS_AC_WRITE;

void add_register(Instruction& result, int reg, std::uint8_t access) {
  if ((access & kRead) != 0) {
    result.reads |= core_set(reg);
    result.vector_reads |= vector_set(reg);
  }
  if ((access & kWritten) != 0) {
    result.writes |= core_set(reg);
    result.vector_writes |= vector_set(reg);
  }
}

class Decoder {
 public:
  Decoder() : insn_(cs_malloc(capstone_)) {}
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;
  ~Decoder() {
    cs_free(insn_, 1);
    cs_close(&capstone_);
  }

  Instruction decode(std::uint32_t word);

 private:
  static csh opened() {
    csh capstone = 0;
    if (cs_open(CS_ARCH_ARM, CS_MODE_ARM, &capstone) != CS_ERR_OK ||
        cs_option(capstone, CS_OPT_DETAIL, CS_OPT_ON) != CS_ERR_OK) {
      throw std::runtime_error("this capstone knows no A32");
    }
    return capstone;
  }
  [[nodiscard]] std::span<const cs_arm_op> operands() const {
    return std::span(insn_->detail->arm.operands).first(insn_->detail->arm.op_count);
  }
  [[nodiscard]] std::uint8_t access_of(const cs_arm_op& operand) const;
  [[nodiscard]] std::uint8_t access_of_data(const cs_arm_op& operand) const;
  void add_memory(Instruction& result) const;
  void add_operands(Instruction& result) const;
  void add_flags(Instruction& result) const;
  [[nodiscard]] Flow flow_of(const Instruction& decoded) const;

  csh capstone_ = opened();
  cs_insn* insn_;
  Kinds kinds_{capstone_};
  Mnemonics data_processing_{capstone_,
                             "and eor sub rsb add adc sbc rsc tst teq cmp cmn orr mov bic mvn ssat "
                             "usat ssat16 usat16"};
  Mnemonics sum_{capstone_,
                 "umlal smlal umaal smlalbb smlalbt smlaltb smlaltt smlald smlaldx smlsld smlsldx"};
  Mnemonics exchange_{capstone_, "vswp vtrn vuzp vzip"};
  Mnemonics base_first_{capstone_,
                        "ldm ldmda ldmdb ldmib stm stmda stmdb stmib vldmia vldmdb vstmia vstmdb"};
  Mnemonics stack_{capstone_, "push pop vpush vpop"};
  Mnemonics sign_extending_{capstone_, "ldrsb ldrsbt ldrsh ldrsht"};
  Mnemonics with_carry_{capstone_, "adc sbc rsc"};
  Mnemonics of_flags_{capstone_, "adc sbc rsc rrx sel mrs"};
  Mnemonics to_flags_{capstone_, "smlabb smlabt smlatb smlatt smlawb smlawt msr"};  // Q, or all
};

// What capstone 4 says, and what it leaves out.
std::uint8_t Decoder::access_of(const cs_arm_op& operand) const {
  if (exchange_.has(*insn_)) {
    return kBoth;
  }
  if (sum_.has(*insn_) && (operand.access & kWritten) != 0) {
    return kBoth;
  }
  if (insn_->id == ARM_INS_VMRS) {
    return vector_set(operand.reg) != 0 ? kRead : kWritten;
  }
  return operand.access == 0 ? kRead : operand.access;
}

// Of loads and stores. A load of one lane leaves the others as they are.
std::uint8_t Decoder::access_of_data(const cs_arm_op& operand) const {
  if (vector_set(operand.reg) == 0) {
    return operand.access;
  }
  if (kinds_.of(*insn_) == Kind::kVectorStore) {
    return kRead;
  }
  return operand.neon_lane >= 0 ? kBoth : kWritten;
}

// Base, index, and what is loaded or stored.
void Decoder::add_memory(Instruction& result) const {
  const bool is_of_stack = stack_.has(*insn_);
  const bool has_list = is_of_stack || base_first_.has(*insn_);
  CoreSet base = is_of_stack ? core_bit(kStackPointer) : 0;
  bool writes_back = is_of_stack || insn_->detail->arm.writeback;
  for (const cs_arm_op& operand : operands()) {
    if (operand.type == ARM_OP_MEM) {
      base = core_set(operand.mem.base);
      result.address_reads |= core_set(operand.mem.index);
    } else if (operand.type == ARM_OP_REG && has_list && base == 0) {
      base = core_set(operand.reg);
    } else if (operand.type == ARM_OP_REG && (has_list || base == 0)) {
      add_register(result, operand.reg, access_of_data(operand));
    } else if (operand.type == ARM_OP_REG) {  // added to the base after the access
      result.address_reads |= core_set(operand.reg);
      writes_back = true;
    }
    const bool is_by_four = operand.shift.type == ARM_SFT_LSL && operand.shift.value == 2;
    result.scaled_index |= operand.shift.type != ARM_SFT_INVALID && !is_by_four;
  }
  result.address_reads |= base;
  result.base_writes = writes_back ? base : 0;
  result.scaled_index &= result.kind != Kind::kPreload;
  result.late_result = sign_extending_.has(*insn_);
}

void Decoder::add_operands(Instruction& result) const {
  bool has_double = false;
  for (const cs_arm_op& operand : operands()) {
    if (operand.type == ARM_OP_REG) {
      add_register(result, operand.reg, access_of(operand));
    }
    if (operand.shift.type >= ARM_SFT_ASR_REG) {  // its amount is the number of a register
      result.reads |= core_set(static_cast<int>(operand.shift.value));
    }
    has_double |= is_whole_double(operand);
  }
  result.quad = insn_->id == ARM_INS_VTBL || insn_->id == ARM_INS_VTBX ||
                (!operands().empty() && is_quad(operands()[0]) && !has_double);
  result.fast_forward = data_processing_.has(*insn_) && shift_of(*insn_) == Shift::kNone;
}

// capstone takes every ADC for one that sets the flags.
void Decoder::add_flags(Instruction& result) const {
  const cs_detail& detail = *insn_->detail;
  const bool has_s = (insn_->bytes[2] & 0x10u) != 0;
  const bool sets = with_carry_.has(*insn_) ? has_s : detail.arm.update_flags;
  result.writes |= sets || to_flags_.has(*insn_) ? core_bit(kFlags) : 0;
  result.reads |= of_flags_.has(*insn_) ? core_bit(kFlags) : 0;
  for (const std::uint16_t reg : std::span(detail.regs_write).first(detail.regs_write_count)) {
    result.vector_writes |= vector_set(reg);
  }
  for (const std::uint16_t reg : std::span(detail.regs_read).first(detail.regs_read_count)) {
    result.vector_reads |= vector_set(reg);
  }
}

// Where the target of a jump comes from decides whether the return stack predicts it.
Flow Decoder::flow_of(const Instruction& decoded) const {
  constexpr CoreSet kLink = core_bit(kLinkRegister);
  constexpr CoreSet kStack = core_bit(kStackPointer);
  switch (insn_->id) {
    case ARM_INS_B:
      return Flow::kJump;
    case ARM_INS_BL:
      return Flow::kCall;
    case ARM_INS_BLX:
      return decoded.reads == 0 ? Flow::kCall : Flow::kIndirectCall;
    case ARM_INS_BX:
      return decoded.reads == kLink ? Flow::kReturn : Flow::kIndirect;
    default:
      break;
  }
  if ((decoded.writes & core_bit(kProgramCounter)) == 0) {
    return Flow::kNone;
  }
  const bool is_popped =
      decoded.address_reads == kStack && (decoded.base_writes == kStack || base_first_.has(*insn_));
  return is_popped || (insn_->id == ARM_INS_MOV && decoded.reads == kLink) ? Flow::kReturn
                                                                           : Flow::kIndirect;
}

// What is not executed leaves the old value, which is therefore an operand.
void add_condition(Instruction& result) {
  result.conditional = true;
  result.reads |= core_bit(kFlags);
  if (!is_memory(result.kind)) {
    result.reads |= result.writes & ~core_bit(kProgramCounter);
    result.vector_reads |= result.vector_writes;
  }
}

Instruction Decoder::decode(std::uint32_t word) {
  const std::array<std::uint8_t, 4> bytes{
      static_cast<std::uint8_t>(word), static_cast<std::uint8_t>(word >> 8),
      static_cast<std::uint8_t>(word >> 16), static_cast<std::uint8_t>(word >> 24)};
  const std::uint8_t* at = bytes.data();
  std::size_t left = bytes.size();
  std::uint64_t address = 0;
  Instruction result;
  if (!cs_disasm_iter(capstone_, &at, &left, &address, insn_)) {
    return result;
  }
  result.kind = kinds_.of(*insn_);
  if (insn_->id == ARM_INS_DBG) {
    result.marker = static_cast<std::uint8_t>(operands()[0].imm);
  }
  if (is_memory(result.kind)) {
    add_memory(result);
  } else if (result.kind > Kind::kSystem) {
    add_operands(result);
    add_flags(result);
  }
  if (insn_->id == ARM_INS_BL || insn_->id == ARM_INS_BLX) {
    result.writes |= core_bit(kLinkRegister);
  }
  result.flow = flow_of(result);
  const arm_cc condition = insn_->detail->arm.cc;
  if (condition != ARM_CC_AL && condition != ARM_CC_INVALID) {
    add_condition(result);
  }
  return result;
}

}  // namespace

Instruction decode(std::uint32_t word) {
  static Decoder decoder;
  return decoder.decode(word);
}

}  // namespace iog::a9_model
