// A set of slots, against a list of bools.
#include "map/slot_set.hpp"

#include <gtest/gtest.h>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"

namespace iog::map {
namespace {

TEST(SlotSet, HasWhatWasPutInAndFindsItInOrder) {
  tests::Random random(11);
  SlotSet set;
  std::array<bool, window::kSlotCount> is_in{};
  for (int round = 0; round < tests::effort(300, 30); ++round) {
    for (int i = 0; i < 20; ++i) {
      const std::size_t slot = random.below(window::kSlotCount);
      is_in[slot] = random.one_in(3);
      set.set(slot, is_in[slot]);
    }
    std::size_t found = set.first_from(0);
    for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
      if (is_in[slot]) {
        ASSERT_EQ(found, slot);
        found = set.first_from(slot + 1);
      }
    }
    ASSERT_EQ(found, window::kSlotCount);
  }
}

TEST(SlotSet, AnEmptyOneHasNoFirst) {
  const SlotSet set;
  for (const std::size_t slot :
       {std::size_t{0}, std::size_t{31}, window::kSlotCount - 1, window::kSlotCount}) {
    EXPECT_EQ(set.first_from(slot), window::kSlotCount);
  }
}

}  // namespace
}  // namespace iog::map
