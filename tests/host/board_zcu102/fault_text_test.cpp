#include <gtest/gtest.h>

#include "boot_record.hpp"
#include "fault.hpp"

namespace iog::zcu102 {
namespace {

TEST(Zcu102FaultText, SaysWhatWhereAndOfWhichAddress) {
  const FaultFrame frame{.kind = FaultKind::kDataAbort,
                         .pc = 0x1012'0000,
                         .spsr = 0x6000'0004,
                         .lr = 0x1013'0000,
                         .sp = 0x1850'0010,
                         .esr = 0x9600'0047,
                         .far = 0x184f'fff0};
  EXPECT_EQ(describe(frame, true).view(),
            "data abort pc=10120000 lr=10130000 sp=18500010 spsr=60000004 esr=96000047 "
            "far=184ffff0 (stack guard)");
}

TEST(Zcu102FaultText, AnAddressThatWentAstrayHasAllItsDigitsAndStillFitsTheBootRecord) {
  const std::uint64_t most = ~std::uint64_t{0};
  const auto line =
      describe({FaultKind::kInstructionAbort, most, most, most, most, most, most}, true);
  EXPECT_NE(line.view().find("far=ffffffffffffffff"), std::string_view::npos);
  EXPECT_LE(line.view().size(), board::BootRecord::kLastWordBytes);
}

TEST(Zcu102FaultText, OnlyAnAbortIsAboutAnAddress) {
  const auto line = describe({FaultKind::kSystemError, 0, 0, 0, 0, 0, 0}, false);
  EXPECT_TRUE(line.view().starts_with("system error pc=00000000"));
  EXPECT_EQ(line.view().find("far="), std::string_view::npos);
}

}  // namespace
}  // namespace iog::zcu102
