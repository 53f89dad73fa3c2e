// The last word, read by a person.
#include <array>
#include <gtest/gtest.h>
#include <string_view>

#include "fault.hpp"

namespace iog::imx6 {
namespace {

constexpr std::array<mmu::Range, 1> kStacks{{{0x1030'1000, 0x1034'1000}}};
const mmu::MemoryMap kMap{.image_section = 0x1010'0000,
                          .code = {},
                          .constants = {},
                          .data = {},
                          .dma = {},
                          .boot_record = {},
                          .stack_section = 0x1030'0000,
                          .tables = {},
                          .stacks = kStacks,
                          .devices = {}};
constexpr FaultFrame frame(FaultKind kind) {
  return {
      .kind = kind, .pc = 0x1010'0abc, .spsr = 0x6000'01d3, .lr = 0x1010'0def, .sp = 0x1034'0ff0};
}

TEST(LastWord, OfADataAbortNamesTheAddress) {
  EXPECT_EQ(
      describe(frame(FaultKind::kDataAbort), {.status = 0x805, .address = 4}, kMap).view(),
      "data abort pc=10100abc lr=10100def sp=10340ff0 spsr=600001d3 fsr=00000805 far=00000004");
}

TEST(LastWord, OfAStackOverflowSaysSo) {
  const TextLine line =
      describe(frame(FaultKind::kDataAbort), {.status = 0x807, .address = 0x1030'0ffc}, kMap);
  EXPECT_TRUE(line.view().ends_with("far=10300ffc (stack guard)"));
}

// ARM DDI 0406, table B3-23: FS (bits 10, 3 to 0 of DFSR) is 0b10110 for an asynchronous external
// abort, 0b11000 for an asynchronous parity error. B3.12.6: DFAR is unknown then, and so a guard
// page that it happens to name means nothing.
TEST(LastWord, OfAnAsynchronousAbortSaysSoAndNamesNoAddress) {
  for (const std::uint32_t status : {0x406U, 0x1c06U, 0x408U}) {
    TextLine expected;
    expected.text("asynchronous abort pc=10100abc lr=10100def sp=10340ff0 spsr=600001d3 fsr=");
    expected.hex(status);
    EXPECT_EQ(
        describe(frame(FaultKind::kDataAbort), {.status = status, .address = 0x1030'0ffc}, kMap)
            .view(),
        expected.view());
  }
}

TEST(LastWord, OfASynchronousExternalAbortNamesTheAddress) {
  EXPECT_TRUE(
      describe(frame(FaultKind::kDataAbort), {.status = 0x1008, .address = 0x0220'0000}, kMap)
          .view()
          .ends_with("fsr=00001008 far=02200000"));
}

TEST(LastWord, HasNoFaultAddressWhereThereIsNone) {
  EXPECT_EQ(describe(frame(FaultKind::kInterrupt), {}, kMap).view(),
            "interrupt taken pc=10100abc lr=10100def sp=10340ff0 spsr=600001d3");
}

// Each kind has a name of its own, and one that startup.S never gives has one, too.
TEST(LastWord, NamesEachKind) {
  const std::array<std::string_view, 8> names{"unknown exception",
                                              "undefined instruction",
                                              "supervisor call",
                                              "prefetch abort",
                                              "data abort",
                                              "interrupt taken",
                                              "hung",
                                              "unknown exception"};
  for (std::uint32_t kind = 0; kind < names.size(); ++kind) {
    const TextLine line = describe(frame(static_cast<FaultKind>(kind)), {}, kMap);
    EXPECT_EQ(line.view().substr(0, line.view().find(" pc=")), names[kind]);
  }
}

TEST(LastWord, FitsTheBootRecord) {
  const TextLine line =
      describe(frame(FaultKind::kPrefetchAbort), {.status = 0x7, .address = 0x1030'0000}, kMap);
  EXPECT_LE(line.view().size(), 240u);
  EXPECT_TRUE(line.view().starts_with("prefetch abort"));
}

}  // namespace
}  // namespace iog::imx6
