// Pages that a TLB holds cost nothing; more pages than it has entries cost what their level costs.
#include "lab/a9_model/tlb.hpp"

#include <gtest/gtest.h>

namespace iog::a9_model {
namespace {

Constants with_pages_of(std::uint32_t page_kb) {
  Constants constants;
  constants.page_kb = page_kb;
  constants.micro_tlb = 32;
  constants.main_tlb_extra = 7;
  constants.walk_extra = 25;
  return constants;
}

struct Side {
  explicit Side(std::uint32_t page_kb) : constants(with_pages_of(page_kb)) {}

  std::uint32_t cost_of(std::uint32_t pages) {
    std::uint32_t cost = 0;
    for (std::uint32_t page = 0; page < pages; ++page) {
      cost += tlb.extra_cycles(page * constants.page_kb * 1024);
    }
    return cost;
  }

  Constants constants;
  MainTlb main;
  TlbCounts counts;
  MicroTlb tlb{constants, main, counts};
};

TEST(Tlb, APageIsWalkedOnceAndThenFree) {
  Side side(4);
  EXPECT_EQ(side.tlb.extra_cycles(0x1000'0000), 32u);
  EXPECT_EQ(side.tlb.extra_cycles(0x1000'0ffc), 0u);
  EXPECT_EQ(side.tlb.extra_cycles(0x1000'1000), 32u);
  EXPECT_EQ(side.tlb.extra_cycles(0x1000'0000), 0u);
  EXPECT_EQ(side.counts.walks, 2u);
}

TEST(Tlb, ASectionIsOnePage) {
  Side side(1024);
  side.tlb.extra_cycles(0x1000'0000);
  EXPECT_EQ(side.tlb.extra_cycles(0x100f'fffc), 0u);
  EXPECT_EQ(side.tlb.extra_cycles(0x1010'0000), 32u);
}

// 64 pages in turn never meet their entry among 32, but the main TLB of 128 holds them all.
TEST(Tlb, TheMainTlbHoldsWhatTheMicroTlbLost) {
  Side side(4);
  side.cost_of(64);
  EXPECT_EQ(side.cost_of(64), 64u * 7u);
  EXPECT_EQ(side.cost_of(32), 32u * 7u);
  EXPECT_EQ(side.cost_of(32), 0u);
}

TEST(Tlb, MorePagesThanTheMainTlbHoldsAreWalkedEveryTime) {
  Side side(4);
  side.cost_of(256);
  EXPECT_EQ(side.cost_of(256), 256u * 32u);
}

}  // namespace
}  // namespace iog::a9_model
