// Translation tables by the ARM ARM (DDI 0487), D5.3: descriptors of a 4 KiB granule.
#include "memory/mmu.hpp"

#include <gtest/gtest.h>
#include <memory>

namespace iog::zcu102::mmu {
namespace {

constexpr std::uint64_t kTablesAt = 0x1840'0000;
constexpr std::array<Range, 4> kRanges{{{0x1010'0000, 0x1010'1000, Memory::kCode},
                                        {0x1010'1000, 0x1040'0000, Memory::kConstants},
                                        {0x1040'0000, 0x1080'3000, Memory::kData},
                                        {0xff00'0000, 0xff20'0000, Memory::kDevice}}};

// What the hardware finds: the last descriptor of its walk, if all before it are tables.
class Walk {
 public:
  Walk() { build(*tables_, kRanges, kTablesAt); }

  std::uint64_t operator()(std::uint64_t address) const {
    std::uint64_t entry = tables_->level1.at(address >> 30);
    for (const int shift : {21, 12}) {
      if ((entry & 0b11) != 0b11) {
        return entry;
      }
      const std::uint64_t pool = kTablesAt + sizeof(Tables::Table);
      entry = tables_->pool.at(((entry & 0xffff'f000) - pool) / sizeof(Tables::Table))
                  .at(address >> shift & 511);
    }
    return entry;
  }

 private:
  std::unique_ptr<Tables> tables_ = std::make_unique<Tables>();
};

TEST(Zcu102Mmu, NothingIsMappedThatIsNotSaid) {
  const Walk walk;
  for (const std::uint64_t address :
       {0x0000'0000ull, 0x100f'ffffull, 0x1080'3000ull, 0xfeff'ffffull, 0xff20'0000ull}) {
    EXPECT_EQ(walk(address) & 1, 0u) << std::hex << address;
  }
}

// UXN and PXN are bits 54 and 53, AF bit 10, SH 9:8, AP[2] bit 7: read-only, AttrIndx 4:2.
TEST(Zcu102Mmu, CodeIsReadOnlyAndDataIsNeverExecuted) {
  const Walk walk;
  EXPECT_EQ(walk(0x1010'0abc), 0x1010'0787u);
  EXPECT_EQ(walk(0x1010'1000), 0x0060'0000'1010'1787u);
  EXPECT_EQ(walk(0x1080'2fff), 0x0060'0000'1080'2707u);
  EXPECT_EQ(walk(0xff00'0000), 0x0060'0000'ff00'0401u);
}

TEST(Zcu102Mmu, ABlockThatARangeFillsIsOneDescriptor) {
  const Walk walk;
  EXPECT_EQ(walk(0x1020'0000), 0x0060'0000'1020'0785u);
  EXPECT_EQ(walk(0x1043'1234), 0x0060'0000'1040'0705u);
}

}  // namespace
}  // namespace iog::zcu102::mmu
