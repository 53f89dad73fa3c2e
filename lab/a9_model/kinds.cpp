#include "kinds.hpp"

#include <algorithm>
#include <ranges>
#include <span>
#include <stdexcept>
#include <string>

namespace iog::a9_model {
namespace {

struct Line {
  Kind kind;
  std::string_view names;
};

constexpr Line kAll[] = {
    {Kind::kNop, "nop yield wfe wfi sev dbg hint pli"},
    {Kind::kSystem,
     "clrex dmb dsb isb bkpt smc svc cps setend rfeda rfedb rfeia rfeib srsda srsdb srsia srsib "
     "mcr mcr2 mcrr mcrr2 mrc mrc2 mrrc mrrc2 cdp cdp2 msr vmsr"},
    {Kind::kBranch, "b bl blx bx"},
    {Kind::kMove, "mov movt movw lsl lsr asr ror rrx clz rev rev16 revsh rbit mrs"},
    {Kind::kAlu,
     "and eor sub rsb add adc sbc rsc tst teq cmp cmn orr bic mvn adr pkhbt pkhtb sel ssat16 "
     "usat16 sadd8 sadd16 sasx ssax ssub8 ssub16 uadd8 uadd16 uasx usax usub8 usub16"},
    {Kind::kSaturatingAdd,
     "qadd qsub qadd8 qadd16 qasx qsax qsub8 qsub16 uqadd8 uqadd16 uqasx uqsax uqsub8 uqsub16 "
     "shadd8 shadd16 shasx shsax shsub8 shsub16 uhadd8 uhadd16 uhasx uhsax uhsub8 uhsub16"},
    {Kind::kSaturate, "ssat usat qdadd qdsub"},
    {Kind::kExtend, "sxtb sxtb16 sxth uxtb uxtb16 uxth"},
    {Kind::kExtendAdd, "sxtab sxtab16 sxtah uxtab uxtab16 uxtah"},
    {Kind::kBitField, "bfc bfi sbfx ubfx"},
    {Kind::kMultiply, "mul mla mls smmul smmulr smmla smmlar smmls smmlsr"},
    {Kind::kMultiplyLong, "umull umlal umaal smull smlal smlald smlaldx smlsld smlsldx"},
    {Kind::kMultiply16,
     "smulbb smulbt smultb smultt smulwb smulwt smlabb smlabt smlatb smlatt smlawb smlawt smlalbb "
     "smlalbt smlaltb smlaltt smuad smuadx smusd smusdx smlad smladx smlsd smlsdx usad8 usada8"},
    {Kind::kLoad, "ldr ldrt ldrex ldrexb ldrexh"},
    {Kind::kLoadNarrow, "ldrb ldrbt ldrh ldrht ldrsb ldrsbt ldrsh ldrsht"},
    {Kind::kLoadMultiple, "ldrd ldrexd ldm ldmda ldmdb ldmib pop"},
    {Kind::kStore, "str strt strex strexb strexd strexh"},
    {Kind::kStoreNarrow, "strb strbt strh strht"},
    {Kind::kStoreMultiple, "strd stm stmda stmdb stmib push"},
    {Kind::kPreload, "pld pldw"},
    {Kind::kVectorLoad, "vldr vldmia vldmdb vpop vld1 vld2 vld3 vld4"},
    {Kind::kVectorStore, "vstr vstmia vstmdb vpush vst1 vst2 vst3 vst4"},
    {Kind::kNeonSimple, "vand vbic vorr vorn veor vbsl vbit vbif vadd"},
    {Kind::kNeonShift,
     "vmov vmvn vsub vpadd vshl vshr vshrn vshll vmovl vmovn vsri vsli vcls vclz vcnt vaddl vaddw "
     "vsubl vsubw vaddhn vabdl vsubhn vpaddl vraddhn vrsubhn vqabs vqneg"},
    {Kind::kNeonCompare,
     "vhadd vqadd vrhadd vhsub vqsub vcgt vcge vceq vcle vclt vtst vmax vmin vabd vpmax vpmin vabs "
     "vneg"},
    {Kind::kNeonSaturatingShift,
     "vqshl vqshlu vrshl vqrshl vrshr vrshrn vqshrn vqshrun vqrshrn vqrshrun vqmovn vqmovun"},
    {Kind::kNeonAccumulate, "vaba vabal vsra vrsra vpadal"},
    {Kind::kNeonMultiply, "vmul vmull vqdmulh vqrdmulh vqdmull"},
    {Kind::kNeonMultiplyAdd, "vmla vmls vmlal vmlsl vqdmlal vqdmlsl"},
    {Kind::kNeonPermute, "vext vtrn vzip vuzp vswp vrev16 vrev32 vrev64 vtbl vtbx vdup"},
};

constexpr Line kFloats[] = {
    {Kind::kNeonShift, "vmov"},  // of a constant
    {Kind::kNeonFloatAdd,
     "vadd vsub vabd vpadd vceq vcge vcgt vcle vclt vacge vacgt vmax vmin vpmax vpmin vabs vneg "
     "vcvt vrecpe vrsqrte"},
    {Kind::kNeonFloatMultiply, "vmul"},
    {Kind::kNeonFloatMultiplyAdd, "vmla vmls"},
    {Kind::kNeonReciprocalStep, "vrecps vrsqrts"},
};

constexpr Line kVfp[] = {
    {Kind::kVfpMove, "vmov vabs vneg"},
    {Kind::kVfpAdd, "vadd vsub"},
    {Kind::kVfpConvert, "vcvt vcvtr vcvtb vcvtt"},
    {Kind::kVfpCompare, "vcmp vcmpe"},
};
constexpr Line kInSingle[] = {
    {Kind::kVfpMultiplySingle, "vmul vnmul"},
    {Kind::kVfpMultiplyAddSingle, "vmla vmls vnmla vnmls"},
    {Kind::kVfpDivideSingle, "vdiv"},
    {Kind::kVfpRootSingle, "vsqrt"},
};
constexpr Line kInDouble[] = {
    {Kind::kVfpMultiplyDouble, "vmul vnmul"},
    {Kind::kVfpMultiplyAddDouble, "vmla vmls vnmla vnmls"},
    {Kind::kVfpDivideDouble, "vdiv"},
    {Kind::kVfpRootDouble, "vsqrt"},
};

void fill(std::span<Kind> table, csh capstone, std::span<const Line> lines) {
  for (const Line& line : lines) {
    const Mnemonics names(capstone, line.names);
    for (unsigned id = 0; id < table.size(); ++id) {
      table[id] = names.has(id) ? line.kind : table[id];
    }
  }
}

unsigned id_of(csh capstone, std::string_view name) {
  for (unsigned id = ARM_INS_INVALID + 1; id < ARM_INS_ENDING; ++id) {
    if (name == cs_insn_name(capstone, id)) {
      return id;
    }
  }
  throw std::invalid_argument("capstone knows no " + std::string(name));
}

std::span<const cs_arm_op> operands_of(const cs_insn& insn) {
  const cs_arm& arm = insn.detail->arm;
  return std::span(arm.operands).first(arm.op_count);
}

bool is_core_register(const cs_arm_op& operand) {
  return operand.type == ARM_OP_REG && ((operand.reg >= ARM_REG_R0 && operand.reg <= ARM_REG_R12) ||
                                        operand.reg == ARM_REG_LR || operand.reg == ARM_REG_SP);
}

// Where the word lies: ARM ARM (DDI 0406), chapters A5 and A7.
bool is_simd(const cs_insn& insn) { return (insn.bytes[3] & 0xfeu) == 0xf2; }
bool is_vfp(const cs_insn& insn) {
  return (insn.bytes[3] & 0xfu) == 0xe && (insn.bytes[1] & 0xeu) == 0xa;
}
bool is_double(const cs_insn& vfp) { return (vfp.bytes[1] & 1u) != 0; }
bool is_single_word(const cs_insn& insn) { return (insn.bytes[3] & 0xcu) == 4; }
bool is_of_flags_alone(const cs_insn& msr) { return (msr.bytes[2] & 0x43u) == 0; }

}  // namespace

Mnemonics::Mnemonics(csh capstone, std::string_view names) {
  for (const auto name : std::views::split(names, ' ')) {
    ids_.set(id_of(capstone, std::string_view(name.begin(), name.end())));
  }
}

Shift shift_of(const cs_insn& insn) {
  for (const cs_arm_op& operand : operands_of(insn)) {
    if (operand.shift.type != ARM_SFT_INVALID) {
      return operand.shift.type >= ARM_SFT_ASR_REG ? Shift::kByRegister : Shift::kByConstant;
    }
  }
  const bool is_named_shift = insn.id == ARM_INS_LSL || insn.id == ARM_INS_LSR ||
                              insn.id == ARM_INS_ASR || insn.id == ARM_INS_ROR ||
                              insn.id == ARM_INS_RRX;  // MOV with a shift
  if (!is_named_shift) {
    return Shift::kNone;
  }
  return operands_of(insn).size() == 3 ? Shift::kByRegister : Shift::kByConstant;
}

Kinds::Kinds(csh capstone) {
  fill(all_, capstone, kAll);
  fill(floats_, capstone, kFloats);
  for (Table* const table : {&singles_, &doubles_}) {
    fill(*table, capstone, kVfp);
  }
  fill(singles_, capstone, kInSingle);
  fill(doubles_, capstone, kInDouble);
}

Kind Kinds::of(const cs_insn& insn) const {
  if (insn.id == ARM_INS_VMRS) {
    return Kind::kVectorToCore;
  }
  const std::span operands = operands_of(insn);
  if ((insn.id == ARM_INS_VMOV || insn.id == ARM_INS_VDUP) &&
      std::ranges::any_of(operands, is_core_register)) {
    return is_core_register(operands[0]) ? Kind::kVectorToCore : Kind::kCoreToVector;
  }
  if (is_simd(insn)) {
    return of_simd(insn);
  }
  if (is_vfp(insn) && insn.id != ARM_INS_VMSR) {
    return is_double(insn) ? doubles_[insn.id] : singles_[insn.id];
  }
  return of_core(insn);
}

Kind Kinds::of_simd(const cs_insn& insn) const {
  if (insn.detail->arm.vector_data >= ARM_VECTORDATA_F32) {
    return floats_[insn.id];
  }
  const bool merges_constant = (insn.id == ARM_INS_VORR || insn.id == ARM_INS_VBIC) &&
                               operands_of(insn).back().type == ARM_OP_IMM;
  return merges_constant ? Kind::kNeonShift : all_[insn.id];
}

Kind Kinds::of_core(const cs_insn& insn) const {
  const Kind kind = all_[insn.id];
  const Shift shift = shift_of(insn);
  switch (kind) {
    case Kind::kMove:
      return shift == Shift::kByRegister ? Kind::kMoveRegisterShift : kind;
    case Kind::kAlu:
      return shift == Shift::kByRegister   ? Kind::kAluRegisterShift
             : shift == Shift::kByConstant ? Kind::kAluShift
                                           : kind;
    case Kind::kLoadMultiple:  // POP of one register
      return is_single_word(insn) ? Kind::kLoad : kind;
    case Kind::kStoreMultiple:
      return is_single_word(insn) ? Kind::kStore : kind;
    default:
      return insn.id == ARM_INS_MSR && is_of_flags_alone(insn) ? Kind::kMove : kind;
  }
}

}  // namespace iog::a9_model
