// Translation tables against the ARM Architecture Reference Manual (ARM DDI 0406C, B3.5).
#include "memory/mmu.hpp"

#include <array>
#include <gtest/gtest.h>
#include <memory>

namespace iog::imx6::mmu {
namespace {

// Bits by hand: [31:20] base, 16 S, 15 AP2, 14:12 TEX, 11:10 AP1:0, 4 XN, 3 C, 2 B, 1:0 = 10.
TEST(Section, HasTheBitsOfTheArchitectureManual) {
  EXPECT_EQ(section(0x1010'0000, Memory::kCode), 0x1011'940eu);
  EXPECT_EQ(section(0x1010'0000, Memory::kConstants), 0x1011'941eu);
  EXPECT_EQ(section(0x1020'0000, Memory::kData), 0x1021'141eu);
  EXPECT_EQ(section(0x1040'0000, Memory::kUncached), 0x1041'1412u);
  EXPECT_EQ(section(0x0210'0000, Memory::kDevice), 0x0210'0412u);
}

// [31:12] base, 10 S, 9 AP2, 8:6 TEX, 5:4 AP1:0, 3 C, 2 B, 1 = 1, 0 XN.
TEST(SmallPage, HasTheBitsOfTheArchitectureManual) {
  EXPECT_EQ(small_page(0x1030'1000, Memory::kData), 0x1030'145fu);
  EXPECT_EQ(small_page(0x1030'1000, Memory::kCode), 0x1030'165eu);
  EXPECT_EQ(small_page(0x1030'1000, Memory::kConstants), 0x1030'165fu);
  EXPECT_EQ(small_page(0x1030'1000, Memory::kDevice), 0x1030'1013u);
}

// [31:16] base, 15 XN, 14:12 TEX, 10 S, 9 AP2, 5:4 AP1:0, 3 C, 2 B, 1:0 = 01.
TEST(LargePage, HasTheBitsOfTheArchitectureManual) {
  EXPECT_EQ(large_page(0x1031'0000, Memory::kCode), 0x1031'161du);
  EXPECT_EQ(large_page(0x1031'0000, Memory::kConstants), 0x1031'961du);
  EXPECT_EQ(large_page(0x1031'0000, Memory::kData), 0x1031'941du);
}

TEST(PageTable, IsAlignedTo1KibAndOfDomain0) { EXPECT_EQ(page_table(0x1020'8400), 0x1020'8401u); }

TEST(Descriptors, CutTheAddressToTheGrain) {
  EXPECT_EQ(section(0x101f'ffff, Memory::kData), section(0x1010'0000, Memory::kData));
  EXPECT_EQ(small_page(0x1030'1fff, Memory::kData), small_page(0x1030'1000, Memory::kData));
}

class Map : public testing::Test {
 protected:
  static constexpr std::uint32_t kImageTable = 0x1020'8000;
  static constexpr std::uint32_t kStacksTable = 0x1020'8400;

  void build_tables() { build(*tables_, map_, kImageTable, kStacksTable); }

  std::uint32_t at(std::uint32_t address) const { return tables_->sections[address >> 20]; }
  std::uint32_t page_at(std::uint32_t address) const {
    return tables_->stacks.pages[(address >> 12) & 0xff];
  }
  std::uint32_t image_page_at(std::uint32_t address) const {
    return tables_->image.pages[(address >> 12) & 0xff];
  }

  std::array<Range, 2> stacks_{{{0x1040'1000, 0x1040'3000}, {0x1040'4000, 0x1040'5000}}};
  std::array<Range, 1> devices_{{{0x0200'0000, 0x0220'0000}}};
  // Constants reach into the next section, as with a map in the image.
  MemoryMap map_{.image_section = 0x1010'0000,
                 .code = {{{0x1010'0000, 0x1010'1000}, {0x1012'0000, 0x1014'0000}}},
                 .constants = {{{0x1010'1000, 0x1011'1000}, {0x1014'0000, 0x1030'0000}}},
                 .data = {0x1030'0000, 0x1040'0000},
                 .dma = {0x1050'0000, 0x1080'0000},
                 .boot_record = {0x1000'0000, 0x1010'0000},
                 .stack_section = 0x1040'0000,
                 .tables = {0x1040'8000, 0x1041'1000},
                 .stacks = stacks_,
                 .devices = devices_};
  std::unique_ptr<Tables> tables_ = std::make_unique<Tables>();
};

TEST_F(Map, NamesEveryRegionAndFaultsOnTheRest) {
  build_tables();
  EXPECT_EQ(at(0x1010'0000), page_table(kImageTable));
  EXPECT_EQ(at(0x1020'0000), section(0x1020'0000, Memory::kConstants));
  EXPECT_EQ(at(0x1030'0000), section(0x1030'0000, Memory::kData));
  EXPECT_EQ(at(0x1070'0000), section(0x1070'0000, Memory::kUncached));
  EXPECT_EQ(at(0x1000'0000), section(0x1000'0000, Memory::kUncached));
  EXPECT_EQ(at(0x0210'0000), section(0x0210'0000, Memory::kDevice));
  EXPECT_EQ(at(0x1040'0000), page_table(kStacksTable));
  std::size_t mapped = 0;
  for (const std::uint32_t entry : tables_->sections) {
    mapped += entry != kFault ? 1u : 0u;
  }
  EXPECT_EQ(mapped, 1u + 1u + 1u + 1u + 3u + 1u + 2u);
  EXPECT_EQ(at(0x0000'0000), kFault) << "null and the boot ROM";
  EXPECT_EQ(at(0x1080'0000), kFault);
}

// ARM ARM, B3.5.1: "a Large page descriptor must be repeated in 16 consecutive memory locations".
TEST_F(Map, OfTheImageOnlyVectorsAndTextAreExecuted) {
  build_tables();
  EXPECT_EQ(image_page_at(0x1010'0000), small_page(0x1010'0000, Memory::kCode));
  for (std::uint32_t page = 0x1010'1000; page != 0x1011'1000; page += kPageBytes) {
    EXPECT_EQ(image_page_at(page), small_page(page, Memory::kConstants)) << "the car's block";
  }
  EXPECT_EQ(image_page_at(0x1011'1000), kFault) << "between block and text";
  for (std::uint32_t page = 0x1012'0000; page != 0x1014'0000; page += kPageBytes) {
    EXPECT_EQ(image_page_at(page), large_page(page, Memory::kCode));
  }
  for (std::uint32_t page = 0x1014'0000; page != 0x1020'0000; page += kPageBytes) {
    EXPECT_EQ(image_page_at(page), large_page(page, Memory::kConstants));
  }
}

TEST_F(Map, APageIsMissingBelowEachStack) {
  build_tables();
  EXPECT_EQ(page_at(0x1040'0000), kFault);
  EXPECT_EQ(page_at(0x1040'1000), small_page(0x1040'1000, Memory::kData));
  EXPECT_EQ(page_at(0x1040'2000), small_page(0x1040'2000, Memory::kData));
  EXPECT_EQ(page_at(0x1040'3000), kFault);
  EXPECT_EQ(page_at(0x1040'4000), small_page(0x1040'4000, Memory::kData));
  EXPECT_EQ(page_at(0x1040'5000), kFault);
}

// A fault can be reported only while the tables say where its handler is.
TEST_F(Map, ItsOwnTablesAreOnlyRead) {
  build_tables();
  EXPECT_EQ(page_at(0x1040'7000), kFault);
  EXPECT_EQ(page_at(0x1040'8000), small_page(0x1040'8000, Memory::kConstants));
  EXPECT_EQ(page_at(0x1041'0000), small_page(0x1041'0000, Memory::kConstants));
  EXPECT_EQ(page_at(0x1041'1000), kFault);
  EXPECT_FALSE(in_stack_guard(map_, 0x1040'8000));
  EXPECT_FALSE(in_stack_guard(map_, 0x1041'0ffc));
  EXPECT_TRUE(in_stack_guard(map_, 0x1041'1000));
}

TEST_F(Map, GuardsAreWhereTheStacksAreNot) {
  EXPECT_TRUE(in_stack_guard(map_, 0x1040'0ffc));
  EXPECT_FALSE(in_stack_guard(map_, 0x1040'1000));
  EXPECT_FALSE(in_stack_guard(map_, 0x1040'2ffc));
  EXPECT_TRUE(in_stack_guard(map_, 0x1040'3000));
  EXPECT_FALSE(in_stack_guard(map_, 0x103f'fffc)) << "another section";
  EXPECT_FALSE(in_stack_guard(map_, 0x1050'0000)) << "another section";
  EXPECT_FALSE(in_stack_guard(map_, 0));
}

using MapDeathTest = Map;

TEST_F(MapDeathTest, RegionsThatOverlapAreAProgrammersError) {
  map_.dma.begin = map_.data.begin;
  EXPECT_DEATH(build_tables(), "");
}

TEST_F(MapDeathTest, CodeOverConstantsIsAProgrammersError) {
  map_.code[1].end += kLargePageBytes;
  EXPECT_DEATH(build_tables(), "");
}

TEST_F(MapDeathTest, RegionsOffTheGrainAreAProgrammersError) {
  map_.data.end += 0x1000;
  EXPECT_DEATH(build_tables(), "");
}

// Half a page, or half of a section that has no pages, would be open or closed with its neighbour.
TEST_F(MapDeathTest, PartsOfAGrainAreAProgrammersError) {
  const MemoryMap sound = map_;
  const auto expect_death = [&](auto&& change) {
    map_ = sound;
    change();
    EXPECT_DEATH(build_tables(), "");
  };
  expect_death([&] { map_.data.begin += 0x1000; });
  expect_death([&] { map_.code[0].end -= 0x800; });
  expect_death([&] { map_.code[0].begin += 0x800; });
  expect_death([&] { map_.constants[1].end = 0x1028'0000; });
  stacks_[1].begin -= 0x800;
  expect_death([] {});
}

}  // namespace
}  // namespace iog::imx6::mmu
