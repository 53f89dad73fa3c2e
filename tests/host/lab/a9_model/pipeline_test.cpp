// Cycles of short loops without end, as the Cortex-A9's manuals give them (DDI 0388 appendix B, DDI
// 0409 chapter 3), and what independence, windows and surprises do to them.
#include "lab/a9_model/pipeline.hpp"

#include <gtest/gtest.h>
#include <vector>

#include "fakes/random.hpp"
#include "lab/a9_model/decode.hpp"

namespace iog::a9_model {
namespace {

constexpr std::uint32_t kCode = 0x1000'8000;
constexpr std::uint32_t kData = 0x1010'0000;

struct Step {
  std::uint32_t word;
  std::vector<MemoryAccess> accesses = {};
};

// Straight-line code that fits the instruction cache, repeated as if it had no end.
class Machine {
 public:
  explicit Machine(const Constants& constants = constants_of(Variant::kNominal))
      : constants_(constants), pipeline_(constants) {}

  void run(const Step& step, std::uint32_t next) {
    const Instruction instruction = decode(step.word);
    pipeline_.execute({.address = address_,
                       .instruction = instruction,
                       .timing = timing_of(instruction, constants_)},
                      step.accesses, next);
    address_ = next;
  }

  // Cycles per repetition, once caches and predictors know it.
  double cycles_of(const std::vector<Step>& steps) {
    constexpr int kTimes = 1000;
    std::uint64_t begin = 0;
    for (int time = 0; time < 2 * kTimes; ++time) {
      begin = time == kTimes ? counters().cycles : begin;
      for (const Step& step : steps) {
        run(step, kCode + (address_ + 4 - kCode) % 512);
      }
    }
    return static_cast<double>(counters().cycles - begin) / kTimes;
  }

  [[nodiscard]] Counters counters() const { return pipeline_.counters(); }

 private:
  Constants constants_;
  Pipeline pipeline_;
  std::uint32_t address_ = kCode;
};

double cycles(const std::vector<Step>& steps) { return Machine().cycles_of(steps); }

constexpr double kLittle = 0.04;  // the jump back to the beginning of the code

TEST(Pipeline, AChainCostsItsLatencies) {
  EXPECT_NEAR(cycles({{0xe0811002}}), 1, kLittle);   // add r1, r1, r2
  EXPECT_NEAR(cycles({{0xe0811082}}), 2, kLittle);   // add r1, r1, r2, lsl #1
  EXPECT_NEAR(cycles({{0xe0811312}}), 3, kLittle);   // add r1, r1, r2, lsl r3
  EXPECT_NEAR(cycles({{0xe6e81011}}), 3, kLittle);   // usat r1, #8, r1
  EXPECT_NEAR(cycles({{0xe0010391}}), 4, kLittle);   // mul r1, r1, r3
  EXPECT_NEAR(cycles({{0xee300a20}}), 4, kLittle);   // vadd.f32 s0, s0, s1
  EXPECT_NEAR(cycles({{0xee200a20}}), 5, kLittle);   // vmul.f32 s0, s0, s1
  EXPECT_NEAR(cycles({{0xee800a20}}), 15, kLittle);  // vdiv.f32 s0, s0, s1
  EXPECT_NEAR(cycles({{0xf2000842}}), 2, kLittle);   // vadd.i8 q0, q0, q1
}

TEST(Pipeline, IndependentInstructionsAreLimitedByDispatchAndPipelines) {
  const Step add1{0xe0811002};
  const Step add3{0xe0833002};
  EXPECT_NEAR(cycles({add1, add3, add1, add3}), 2, kLittle);
  // Four multiplications into different registers: two cycles each.
  EXPECT_NEAR(cycles({{0xe0010392}, {0xe0040392}, {0xe0050392}, {0xe0060392}}), 8, kLittle);
  // vadd.i8 into q0 and q2 in turn.
  EXPECT_NEAR(cycles({{0xf2000842}, {0xf2044842}}), 2, kLittle);
}

TEST(Pipeline, TwoChainsOverlap) {
  const Step mul1{0xe0010391};
  const Step mul4{0xe0040394};
  EXPECT_NEAR(cycles({mul1}), 4, kLittle);
  EXPECT_NEAR(cycles({mul1, mul4}), 4, kLittle);
}

TEST(Pipeline, LoadsHitAfterFourCyclesOrThreeForTheAlu) {
  const std::vector<MemoryAccess> word{{kData, 4}};
  EXPECT_NEAR(cycles({{0xe5900000, word}}), 4, kLittle);                // ldr r0, [r0]
  EXPECT_NEAR(cycles({{0xe5901000, word}, {0xe0810002}}), 4, kLittle);  // ... add r0, r1, r2
  // ldr r1, [r0]; add r0, r1, r2, lsl #1: a shift takes the value as late as anybody, and two
  // cycles.
  EXPECT_NEAR(cycles({{0xe5901000, word}, {0xe0810082}}), 6, kLittle);
  EXPECT_NEAR(cycles({{0xe5d01000, {{kData, 1}}}}), 2, kLittle);  // ldrb r1, [r0]
}

TEST(Pipeline, AMultipleLoadPassesADoublewordACycle) {
  std::vector<MemoryAccess> aligned;
  std::vector<MemoryAccess> odd;
  for (std::uint32_t word = 0; word < 8; ++word) {
    aligned.push_back({kData + 4 * word, 4});
    odd.push_back({kData + 4 + 4 * word, 4});
  }
  EXPECT_NEAR(cycles({{0xe89002fe, aligned}}), 4, kLittle);  // ldm r0, {r1-r7, r9}
  EXPECT_NEAR(cycles({{0xe89002fe, odd}}), 5, kLittle);
}

// Ten multiplications and ten loads, each group a chain of 40 cycles. A window that holds both runs
// them together; one of four lets three instructions of a group overtake at each of the two seams.
TEST(Pipeline, TheWindowLimitsWhatMayOvertake) {
  std::vector<Step> steps(10, Step{0xe0010391});
  for (int step = 0; step < 10; ++step) {
    steps.push_back({0xe5900000, {{kData, 4}}});
  }
  Constants wide = constants_of(Variant::kNominal);
  wide.window = 40;
  Constants narrow = wide;
  narrow.window = 4;
  EXPECT_NEAR(Machine(wide).cycles_of(steps), 40, 1);
  EXPECT_NEAR(Machine(narrow).cycles_of(steps), 80 - 2 * 3 * 4, 1);
}

TEST(Pipeline, AMispredictionCostsItsPenaltyAndAFalseConditionOneSlot) {
  tests::Random random(3);
  const Constants constants = constants_of(Variant::kNominal);
  Machine foreseen(constants);
  Machine surprised(constants);
  constexpr std::uint32_t kTimes = 20'000;
  for (std::uint32_t time = 0; time < kTimes; ++time) {
    for (Machine* const machine : {&foreseen, &surprised}) {
      machine->run({0xe1510002}, kCode + 4);  // cmp r1, r2
      const bool taken = machine == &surprised && random.one_in(2);
      machine->run({0x0a000000}, taken ? kCode + 12 : kCode + 8);  // beq
      if (!taken) {
        machine->run({0xe320f000}, kCode + 12);
      }
      machine->run({0xeafffffb}, kCode);  // b
    }
  }
  const std::uint64_t surprises = surprised.counters().mispredicts;
  EXPECT_NEAR(static_cast<double>(surprises), 0.5 * kTimes, 0.05 * kTimes);
  const double extra = static_cast<double>(surprised.counters().cycles) -
                       static_cast<double>(foreseen.counters().cycles);
  EXPECT_NEAR(extra / static_cast<double>(surprises), constants.mispredict_penalty, 1.5);
}

// ldr r0, [r8]; mul r1, r0, r3; str r1, [r8, #64]: the next load does not need the product.
TEST(Pipeline, AStoreOfWhatIsNotReadyDoesNotHoldTheLoadBehindIt) {
  const std::vector<Step> steps{
      {0xe5980000, {{kData, 4}}}, {0xe0010390}, {0xe5881040, {{kData + 64, 4}}}};
  EXPECT_NEAR(cycles(steps), 2, 0.1);
  Constants in_order = constants_of(Variant::kNominal);
  in_order.stores_wait_for_data = 1;
  EXPECT_NEAR(Machine(in_order).cycles_of(steps), 4 + 4 + 1, 0.1);
}

TEST(Pipeline, ALoadWaitsForTheStoreToItsPlace) {
  // str r0, [r8]; ldr r0, [r8]: four cycles from stored data to loaded data.
  const std::vector<MemoryAccess> word{{kData, 4}};
  EXPECT_NEAR(cycles({{0xe5880000, word}, {0xe5980000, word}}), 4, 0.1);
}

TEST(Pipeline, WhatItDoesNotKnowIsCounted) {
  Machine machine;
  machine.run({0xe7f000f0}, kCode + 4);  // udf
  machine.run({0xe0811002}, kCode + 8);
  EXPECT_EQ(machine.counters().unknown, 1u);
  EXPECT_EQ(machine.counters().instructions, 2u);
}

}  // namespace
}  // namespace iog::a9_model
