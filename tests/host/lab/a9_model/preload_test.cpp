// Addresses of preloads. The words are those of the GNU assembler.
#include "lab/a9_model/preload.hpp"

#include <gtest/gtest.h>
#include <vector>

#include "lab/a9_model/decode.hpp"
#include "lab/a9_model/pipeline.hpp"

namespace iog::a9_model {
namespace {

constexpr std::uint32_t kCode = 0x1000'8000;

std::uint32_t address_of(std::uint32_t word) {
  return preloaded_address(word, kCode, [](std::uint32_t number) {
    return number == 1 ? 0x1010'0000U : number == 2 ? 0x8000'0041U : 0xdead'beefU;
  });
}

TEST(Preload, NamesAnAddressAsTheManualSays) {
  EXPECT_EQ(address_of(0xf5d1f040), 0x1010'0040U);                 // pld [r1, #64]
  EXPECT_EQ(address_of(0xf551f004), 0x100f'fffcU);                 // pld [r1, #-4]
  EXPECT_EQ(address_of(0xf7d1f002), 0x9010'0041U);                 // pld [r1, r2]
  EXPECT_EQ(address_of(0xf751f182), 0x1010'0000U - 0x208U);        // pld [r1, -r2, lsl #3]
  EXPECT_EQ(address_of(0xf7d1f222), 0x1010'0000U + 0x0800'0004U);  // pld [r1, r2, lsr #4]
  EXPECT_EQ(address_of(0xf7d1f022), 0x1010'0000U);                 // pld [r1, r2, lsr #32]
  EXPECT_EQ(address_of(0xf7d1f242), 0x1010'0000U + 0xf800'0004U);  // pld [r1, r2, asr #4]
  EXPECT_EQ(address_of(0xf7d1f462), 0x1010'0000U + 0x4180'0000U);  // pld [r1, r2, ror #8]
  EXPECT_EQ(address_of(0xf5dff010), kCode + 8 + 16);               // pld [pc, #16]
}

// Loads of lines that nothing holds, each after `work` additions; with `ahead`, the line of a later
// load is asked for first.
std::uint64_t cycles_of_loads(bool ahead, std::uint32_t work) {
  constexpr std::uint32_t kLines = 200;
  constexpr std::uint32_t kLineBytes = 32;
  constexpr std::uint32_t kStride = 3 * kLineBytes;  // no stream
  constexpr std::uint32_t kAhead = 4 * kStride;
  const Constants constants = constants_of(Variant::kNominal);
  Pipeline pipeline(constants);
  std::uint32_t at = 0;
  const auto run = [&](std::uint32_t word, std::vector<MemoryAccess> accesses) {
    const Instruction instruction = decode(word);
    pipeline.execute({.address = kCode + at,
                      .instruction = instruction,
                      .timing = timing_of(instruction, constants)},
                     accesses, kCode + (at + 4) % 512);
    at = (at + 4) % 512;
  };
  for (std::uint32_t line = 0; line < kLines; ++line) {
    const std::uint32_t address = 0x1010'0000 + line * kStride;
    if (ahead) {
      run(0xf5d1f040, {{address + kAhead, 1}});  // pld
    }
    run(0xe5900000, {{address, 4}});  // ldr r0, [r0]
    for (std::uint32_t i = 0; i < work; ++i) {
      run(0xe0800000, {});  // add r0, r0, r0
    }
  }
  return pipeline.counters().cycles;
}

// All but the first four loads find their lines.
TEST(Preload, TakesTheLoadsWaitAway) {
  constexpr std::uint32_t kWork = 200;
  const Constants constants = constants_of(Variant::kNominal);
  const std::uint64_t saved = cycles_of_loads(false, kWork) - cycles_of_loads(true, kWork);
  EXPECT_GT(saved, 196U * constants.ddr_latency);
  EXPECT_LT(saved, 200U * (constants.ddr_latency + 2 * constants.l2_extra));
}

}  // namespace
}  // namespace iog::a9_model
