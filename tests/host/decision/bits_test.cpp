// The four bits that frames to come ask for: their levels, and that each is its own cell's.
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>

#include "decision/decision.hpp"
#include "fakes/group.hpp"

namespace iog::decision {
namespace {

using evidence::Group;
using evidence::Indexes;

constexpr std::size_t kCell = 6;
constexpr std::uint8_t kItsBit = 1U << kCell;

Bits decided_bits(const Group& group, const Indexes& indexes) {
  alignas(8) const RuledOut nothing{};
  alignas(8) Decided decided;
  return decide(group, nothing, indexes, decided);
}

// The bits of a group whose only known cell is kCell.
Bits bits_of(const Group& cell, int index = 0) {
  Group group = cell;
  Indexes indexes{};
  indexes[kCell] = static_cast<index::OccupancyIndex>(index);
  return decided_bits(group, indexes);
}

Group free_cell(int mass) {
  Group group;
  group.free[kCell] = static_cast<std::int16_t>(mass);
  return group;
}

TEST(Freed, IsMoreThanHalf) {
  EXPECT_EQ(bits_of(free_cell(16'384)), Bits{});
  EXPECT_EQ(bits_of(free_cell(16'385)), (Bits{.freed = kItsBit}));
}

// Of the group's own frame: a cell that was free long enough, and that a beam crossed just now.
TEST(Seen, NeedsABeamInThisFrame) {
  EXPECT_EQ(bits_of(free_cell(22'939), -1).seen, kItsBit);
  EXPECT_EQ(bits_of(free_cell(22'938), -1).seen, 0);
  EXPECT_EQ(bits_of(free_cell(22'939), 0).seen, 0);
  EXPECT_EQ(bits_of(free_cell(22'939), 1).seen, 0);
  EXPECT_EQ(bits_of(free_cell(32'767), -127).seen, kItsBit);
  EXPECT_EQ(bits_of(free_cell(32'767), 127).seen, 0);
}

TEST(Stands, IsAnAccumulatorAboveOneEighth) {
  Group group;
  group.persistence[kCell] = 4096;
  EXPECT_EQ(bits_of(group), (Bits{.held = kItsBit}));
  group.persistence[kCell] = 4097;
  EXPECT_EQ(bits_of(group), (Bits{.stands = kItsBit, .held = kItsBit}));
}

TEST(Taken, IsOccupiedAboveOneQuarterByWhatever) {
  Group group;
  group.occupied[kCell] = 4096;
  group.moving[kCell] = 2048;
  group.standing[kCell] = 2048;
  EXPECT_EQ(bits_of(group), (Bits{.held = kItsBit}));
  group.standing[kCell] = 2049;
  EXPECT_EQ(bits_of(group), (Bits{.taken = kItsBit, .held = kItsBit}));
}

// Whatever it is, and however little.
TEST(Held, IsAnythingButFree) {
  for (evidence::Masses evidence::Taken::*const masses :
       {&evidence::Taken::occupied, &evidence::Taken::moving, &evidence::Taken::standing,
        &evidence::Taken::persistence}) {
    Group group;
    group.free.fill(20'000);
    EXPECT_EQ(decided_bits(group, {}).held, 0);
    (group.*masses)[kCell] = 1;
    EXPECT_EQ(decided_bits(group, {}).held, kItsBit);
  }
}

TEST(Bits, AreThoseOfTheirCells) {
  for (std::size_t cell = 0; cell < evidence::kGroupCells; ++cell) {
    const auto bit = static_cast<std::uint8_t>(1U << cell);
    Group group;
    group.free.fill(30'000);
    group.free[cell] = 0;
    group.occupied[cell] = 30'000;
    group.persistence[cell] = 30'000;
    Indexes indexes{-1, -1, -1, -1, -1, -1, -1, -1};
    indexes[cell] = 2;
    const auto others = static_cast<std::uint8_t>(~bit);
    EXPECT_EQ(decided_bits(group, indexes),
              (Bits{.freed = others, .seen = others, .stands = bit, .taken = bit, .held = bit}));
  }
}

}  // namespace
}  // namespace iog::decision
