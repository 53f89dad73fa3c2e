// Words that the GNU assembler made, with its text beside them.
#include "lab/a9_model/decode.hpp"

#include <gtest/gtest.h>
#include <span>

namespace iog::a9_model {
namespace {

constexpr CoreSet r(unsigned index) { return core_bit(index); }
constexpr CoreSet kF = core_bit(kFlags);

struct CoreCase {
  std::uint32_t word;
  const char* text;
  Kind kind;
  CoreSet reads;
  CoreSet writes;
};

TEST(Decode, DataProcessing) {
  const CoreCase cases[] = {
      {0xe0821003, "add r1, r2, r3", Kind::kAlu, r(2) | r(3), r(1)},
      {0xe2921004, "adds r1, r2, #4", Kind::kAlu, r(2), r(1) | kF},
      {0xe0821283, "add r1, r2, r3, lsl #5", Kind::kAluShift, r(2) | r(3), r(1)},
      {0xe0821413, "add r1, r2, r3, lsl r4", Kind::kAluRegisterShift, r(2) | r(3) | r(4), r(1)},
      {0xe1a01002, "mov r1, r2", Kind::kMove, r(2), r(1)},
      {0xe1a01182, "mov r1, r2, lsl #3", Kind::kMove, r(2), r(1)},
      {0xe1a01062, "rrx r1, r2", Kind::kMove, r(2) | kF, r(1)},
      {0xe1a01312, "mov r1, r2, lsl r3", Kind::kMoveRegisterShift, r(2) | r(3), r(1)},
      {0xe1e01002, "mvn r1, r2", Kind::kAlu, r(2), r(1)},
      {0xe3510007, "cmp r1, #7", Kind::kAlu, r(1), kF},
      {0xe0a21003, "adc r1, r2, r3", Kind::kAlu, r(2) | r(3) | kF, r(1)},
      {0xe30014d2, "movw r1, #1234", Kind::kMove, 0, r(1)},
      {0xe34014d2, "movt r1, #1234", Kind::kMove, r(1), r(1)},
      {0xe16f1f12, "clz r1, r2", Kind::kMove, r(2), r(1)},
      {0xe1031052, "qadd r1, r2, r3", Kind::kSaturatingAdd, r(2) | r(3), r(1)},
      {0xe1431052, "qdadd r1, r2, r3", Kind::kSaturate, r(2) | r(3), r(1)},
      {0xe6621f93, "uqadd8 r1, r2, r3", Kind::kSaturatingAdd, r(2) | r(3), r(1)},
      {0xe6521f93, "uadd8 r1, r2, r3", Kind::kAlu, r(2) | r(3), r(1) | kF},
      {0xe6821fb3, "sel r1, r2, r3", Kind::kAlu, r(2) | r(3) | kF, r(1)},
      {0xe6e81012, "usat r1, #8, r2", Kind::kSaturate, r(2), r(1)},
      {0xe6e81f32, "usat16 r1, #8, r2", Kind::kAlu, r(2), r(1)},
      {0xe6821013, "pkhbt r1, r2, r3", Kind::kAlu, r(2) | r(3), r(1)},
      {0xe6ef1072, "uxtb r1, r2", Kind::kExtend, r(2), r(1)},
      {0xe6b21073, "sxtah r1, r2, r3", Kind::kExtendAdd, r(2) | r(3), r(1)},
      {0xe7e311d2, "ubfx r1, r2, #3, #4", Kind::kBitField, r(2), r(1)},
      {0xe7c61192, "bfi r1, r2, #3, #4", Kind::kBitField, r(1) | r(2), r(1)},
      {0xe7c6119f, "bfc r1, #3, #4", Kind::kBitField, r(1), r(1)},
      {0xe0010392, "mul r1, r2, r3", Kind::kMultiply, r(2) | r(3), r(1)},
      {0xe0214392, "mla r1, r2, r3, r4", Kind::kMultiply, r(2) | r(3) | r(4), r(1)},
      {0xe0821493, "umull r1, r2, r3, r4", Kind::kMultiplyLong, r(3) | r(4), r(1) | r(2)},
      {0xe0e21493, "smlal r1, r2, r3, r4", Kind::kMultiplyLong, r(1) | r(2) | r(3) | r(4),
       r(1) | r(2)},
      {0xe1610382, "smulbb r1, r2, r3", Kind::kMultiply16, r(2) | r(3), r(1)},
      {0xe1014382, "smlabb r1, r2, r3, r4", Kind::kMultiply16, r(2) | r(3) | r(4), r(1) | kF},
      {0xe7014312, "smlad r1, r2, r3, r4", Kind::kMultiply16, r(2) | r(3) | r(4), r(1)},
      {0xe751f312, "smmul r1, r2, r3", Kind::kMultiply, r(2) | r(3), r(1)},
      {0xe7f000f0, "udf #0", Kind::kUnknown, 0, 0},
  };
  for (const CoreCase& expected : cases) {
    const Instruction got = decode(expected.word);
    EXPECT_EQ(got.kind, expected.kind) << expected.text;
    EXPECT_EQ(got.reads, expected.reads) << expected.text;
    EXPECT_EQ(got.writes, expected.writes) << expected.text;
    EXPECT_EQ(got.flow, Flow::kNone) << expected.text;
    EXPECT_FALSE(got.conditional) << expected.text;
  }
}

// What is not executed leaves the old value: it is an operand, like the flags.
TEST(Decode, AConditionMakesFlagsAndTheOldValueOperands) {
  const Instruction addne = decode(0x10821003);  // addne r1, r2, r3
  EXPECT_TRUE(addne.conditional);
  EXPECT_EQ(addne.reads, r(1) | r(2) | r(3) | kF);
}

struct MemoryCase {
  std::uint32_t word;
  const char* text;
  Kind kind;
  CoreSet address;
  CoreSet data;  // read by a store, written by a load
  CoreSet base;  // written back
};

TEST(Decode, LoadsAndStores) {
  const MemoryCase cases[] = {
      {0xe5921000, "ldr r1, [r2]", Kind::kLoad, r(2), r(1), 0},
      {0xe5b21004, "ldr r1, [r2, #4]!", Kind::kLoad, r(2), r(1), r(2)},
      {0xe4921004, "ldr r1, [r2], #4", Kind::kLoad, r(2), r(1), r(2)},
      {0xe7921103, "ldr r1, [r2, r3, lsl #2]", Kind::kLoad, r(2) | r(3), r(1), 0},
      {0xe5d21000, "ldrb r1, [r2]", Kind::kLoadNarrow, r(2), r(1), 0},
      {0xe19210d3, "ldrsb r1, [r2, r3]", Kind::kLoadNarrow, r(2) | r(3), r(1), 0},
      {0xe1c420d0, "ldrd r2, r3, [r4]", Kind::kLoadMultiple, r(4), r(2) | r(3), 0},
      {0xe1e420f8, "strd r2, r3, [r4, #8]!", Kind::kStoreMultiple, r(4), r(2) | r(3), r(4)},
      {0xe5821004, "str r1, [r2, #4]", Kind::kStore, r(2), r(1), 0},
      {0xe4c21001, "strb r1, [r2], #1", Kind::kStoreNarrow, r(2), r(1), r(2)},
      {0xe18210b3, "strh r1, [r2, r3]", Kind::kStoreNarrow, r(2) | r(3), r(1), 0},
      {0xe8b1003c, "ldm r1!, {r2-r5}", Kind::kLoadMultiple, r(1), r(2) | r(3) | r(4) | r(5), r(1)},
      {0xe1921f9f, "ldrex r1, [r2]", Kind::kLoad, r(2), r(1), 0},
      {0xf5d1f040, "pld [r1, #64]", Kind::kPreload, r(1), 0, 0},
  };
  for (const MemoryCase& expected : cases) {
    const Instruction got = decode(expected.word);
    EXPECT_EQ(got.kind, expected.kind) << expected.text;
    EXPECT_EQ(got.address_reads, expected.address) << expected.text;
    EXPECT_EQ(got.reads | got.writes, expected.data) << expected.text;
    EXPECT_EQ(got.base_writes, expected.base) << expected.text;
  }
}

TEST(Decode, OnlyAShiftByTwoIsFreeInAnAddress) {
  EXPECT_FALSE(decode(0xe7921003).scaled_index);  // ldr r1, [r2, r3]
  EXPECT_FALSE(decode(0xe7921103).scaled_index);  // ldr r1, [r2, r3, lsl #2]
  EXPECT_TRUE(decode(0xe7921183).scaled_index);   // ldr r1, [r2, r3, lsl #3]
}

TEST(Decode, Branches) {
  EXPECT_EQ(decode(0xeafffffe).flow, Flow::kJump);          // b
  EXPECT_EQ(decode(0xebfffffe).flow, Flow::kCall);          // bl
  EXPECT_EQ(decode(0xe12fff1e).flow, Flow::kReturn);        // bx lr
  EXPECT_EQ(decode(0xe12fff11).flow, Flow::kIndirect);      // bx r1
  EXPECT_EQ(decode(0xe12fff31).flow, Flow::kIndirectCall);  // blx r1
  EXPECT_EQ(decode(0xe1a0f00e).flow, Flow::kReturn);        // mov pc, lr
  EXPECT_EQ(decode(0xe592f000).flow, Flow::kIndirect);      // ldr pc, [r2]
  EXPECT_EQ(decode(0xe49df004).flow, Flow::kReturn);        // pop {pc}
  EXPECT_EQ(decode(0xe8bd8010).flow, Flow::kReturn);        // pop {r4, pc}
  const Instruction beq = decode(0x0afffffe);
  EXPECT_TRUE(beq.conditional);
  EXPECT_EQ(beq.reads, kF);
}

TEST(Decode, HintsBarriersAndMarkers) {
  EXPECT_EQ(decode(0xe320f000).kind, Kind::kNop);  // nop
  EXPECT_EQ(decode(0xe320f000).marker, Instruction::kNoMarker);
  EXPECT_EQ(decode(0xe320f0f5).marker, 5);            // dbg #5
  EXPECT_EQ(decode(0xf57ff05f).kind, Kind::kSystem);  // dmb
  EXPECT_EQ(decode(0xee111f10).kind, Kind::kSystem);  // mrc p15
  EXPECT_EQ(decode(0xe10f1000).kind, Kind::kMove);    // mrs r1, cpsr
}

struct VectorCase {
  std::uint32_t word;
  const char* text;
  Kind kind;
  VectorSet reads;
  VectorSet writes;
};

void expect(std::span<const VectorCase> cases) {
  for (const VectorCase& expected : cases) {
    const Instruction got = decode(expected.word);
    EXPECT_EQ(got.kind, expected.kind) << expected.text;
    EXPECT_EQ(got.vector_reads, expected.reads) << expected.text;
    EXPECT_EQ(got.vector_writes, expected.writes) << expected.text;
  }
}

VectorSet d(unsigned first, unsigned count = 1) { return doubles(first, count); }
VectorSet s(unsigned first, unsigned count = 1) { return singles(first, count); }

TEST(Decode, FloatingPoint) {
  const VectorSet flags = vector_bit(kVectorFlags);
  const VectorCase cases[] = {
      {0xee710a21, "vadd.f32 s1, s2, s3", Kind::kVfpAdd, s(2, 2), s(1)},
      {0xee721b03, "vadd.f64 d17, d2, d3", Kind::kVfpAdd, d(2, 2), d(17)},
      {0xee610a21, "vmul.f32 s1, s2, s3", Kind::kVfpMultiplySingle, s(2, 2), s(1)},
      {0xee410a21, "vmla.f32 s1, s2, s3", Kind::kVfpMultiplyAddSingle, s(1, 3), s(1)},
      {0xee821b03, "vdiv.f64 d1, d2, d3", Kind::kVfpDivideDouble, d(2, 2), d(1)},
      {0xeef10ac1, "vsqrt.f32 s1, s2", Kind::kVfpRootSingle, s(2), s(1)},
      {0xeeb71b00, "vmov.f64 d1, #1.0", Kind::kVfpMove, 0, d(1)},
      {0xeef40a41, "vcmp.f32 s1, s2", Kind::kVfpCompare, s(1, 2), flags},
      {0xeeb51b40, "vcmp.f64 d1, #0", Kind::kVfpCompare, d(1), flags},
      {0xeef80ac1, "vcvt.f32.s32 s1, s2", Kind::kVfpConvert, s(2), s(1)},
      {0xeefd0bc2, "vcvt.s32.f64 s1, d2", Kind::kVfpConvert, d(2), s(1)},
      {0xeeb71ac1, "vcvt.f64.f32 d1, s2", Kind::kVfpConvert, s(2), d(1)},
      {0xee001a90, "vmov s1, r1", Kind::kCoreToVector, 0, s(1)},
      {0xec521b13, "vmov r1, r2, d3", Kind::kVectorToCore, d(3), 0},
      {0xee011b10, "vmov.32 d1[0], r1", Kind::kCoreToVector, d(1), d(1)},
      {0xeee21b10, "vdup.8 q1, r1", Kind::kCoreToVector, 0, d(2, 2)},
      {0xeef1fa10, "vmrs apsr_nzcv, fpscr", Kind::kVectorToCore, flags, 0},
      {0xecb12b08, "vldm r1!, {d2-d5}", Kind::kVectorLoad, 0, d(2, 4)},
      {0xed811b02, "vstr d1, [r1, #8]", Kind::kVectorStore, d(1), 0},
  };
  expect(cases);
  EXPECT_EQ(decode(0xeef1fa10).writes, kF);
}

TEST(Decode, AdvancedSimd) {
  const VectorCase cases[] = {
      {0xf2042846, "vadd.i8 q1, q2, q3", Kind::kNeonSimple, d(4, 4), d(2, 2)},
      {0xf3042846, "vsub.i8 q1, q2, q3", Kind::kNeonShift, d(4, 4), d(2, 2)},
      {0xf2042156, "vand q1, q2, q3", Kind::kNeonSimple, d(4, 4), d(2, 2)},
      {0xf3142156, "vbsl q1, q2, q3", Kind::kNeonSimple, d(2, 6), d(2, 2)},
      {0xf3021213, "vqsub.u8 d1, d2, d3", Kind::kNeonCompare, d(2, 2), d(1)},
      {0xf2042646, "vmax.s8 q1, q2, q3", Kind::kNeonCompare, d(4, 4), d(2, 2)},
      {0xf3042756, "vaba.u8 q1, q2, q3", Kind::kNeonAccumulate, d(2, 6), d(2, 2)},
      {0xf2142956, "vmul.i16 q1, q2, q3", Kind::kNeonMultiply, d(4, 4), d(2, 2)},
      {0xf2021d13, "vmla.f32 d1, d2, d3", Kind::kNeonFloatMultiplyAdd, d(1, 3), d(1)},
      {0xf3842805, "vmlal.u8 q1, d4, d5", Kind::kNeonMultiplyAdd, d(2, 4), d(2, 2)},
      {0xf2841406, "vaddhn.i16 d1, q2, q3", Kind::kNeonShift, d(4, 4), d(1)},
      {0xf394284b, "vmul.i16 q1, q2, d3[1]", Kind::kNeonMultiply, d(3, 3), d(2, 2)},
      {0xf2b42446, "vext.8 q1, q2, q3, #4", Kind::kNeonPermute, d(4, 4), d(2, 2)},
      {0xf3b21904, "vtbl.8 d1, {d2, d3}, d4", Kind::kNeonPermute, d(2, 3), d(1)},
      {0xf3b220c4, "vtrn.8 q1, q2", Kind::kNeonPermute, d(2, 4), d(2, 4)},
      {0xf3b21204, "vmovn.i16 d1, q2", Kind::kNeonShift, d(4, 2), d(1)},
      {0xf3882a14, "vmovl.u8 q1, d4", Kind::kNeonShift, d(4), d(2, 2)},
      {0xf38d2154, "vsra.u8 q1, q2, #3", Kind::kNeonAccumulate, d(2, 4), d(2, 2)},
      {0xf28d1914, "vqshrn.s16 d1, q2, #3", Kind::kNeonSaturatingShift, d(4, 2), d(1)},
      {0xf2802e50, "vmov.i8 q1, #0", Kind::kNeonShift, 0, d(2, 2)},
      {0xf2802951, "vorr.i16 q1, #1", Kind::kNeonShift, d(2, 2), d(2, 2)},
      {0xf3b72c44, "vdup.8 q1, d4[3]", Kind::kNeonPermute, d(4), d(2, 2)},
      {0xf4212a0d, "vld1.8 {d2-d3}, [r1]!", Kind::kVectorLoad, 0, d(2, 2)},
      {0xf4a1288f, "vld1.32 {d2[1]}, [r1]", Kind::kVectorLoad, d(2), d(2)},
      {0xf4012a02, "vst1.8 {d2-d3}, [r1], r2", Kind::kVectorStore, d(2, 2), 0},
      {0xf421200f, "vld4.8 {d2-d5}, [r1]", Kind::kVectorLoad, 0, d(2, 4)},
  };
  expect(cases);
  EXPECT_EQ(decode(0xf4212a0d).base_writes, r(1));
  EXPECT_EQ(decode(0xf4012a02).address_reads, r(1) | r(2));
}

}  // namespace
}  // namespace iog::a9_model
