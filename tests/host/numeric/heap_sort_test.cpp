// Sorted values against the C++ library's own sort.
#include "numeric/heap_sort.hpp"

#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <vector>

#include "fakes/random.hpp"

namespace iog::numeric {
namespace {

TEST(HeapSort, IsTheOrderOfTheLibraryForEveryLength) {
  tests::Random random(3);
  for (std::size_t length = 0; length < 300; ++length) {
    std::vector<std::uint32_t> values(length);
    for (std::uint32_t& value : values) {
      value = static_cast<std::uint32_t>(random.below(200));  // some are equal
    }
    std::vector<std::uint32_t> expected = values;
    std::sort(expected.begin(), expected.end());
    heap_sort(std::span(values), std::less<>{});
    ASSERT_EQ(values, expected) << length;
  }
}

TEST(HeapSort, FollowsTheOrderThatItIsGiven) {
  std::vector<int> values{3, 1, 4, 15, 9, 2, 6};
  heap_sort(std::span(values), std::greater<>{});
  EXPECT_EQ(values, (std::vector<int>{15, 9, 6, 4, 3, 2, 1}));
}

}  // namespace
}  // namespace iog::numeric
