// How deep a painted stack was ever used, against a look at all of its words.
#include "stack_gauge.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

#include "fakes/random.hpp"
#include "trace.hpp"

namespace iog::imx6 {
namespace {

constexpr std::size_t kWords = std::size_t{256} * 1024 / 4;  // linker/imx6.ld, the main stack
constexpr std::size_t kLooksOfASweep = kWords / StackGauge::kSweepWords;

class PaintedStack : public testing::Test {
 protected:
  PaintedStack() {
    machine::recorder.reset();
    machine::recorder.on_load = [this](const void*) { ++loads_; };
  }

  // Words counted from the top, as a stack grows.
  void use(std::size_t word) { stack_[kWords - 1 - word] = 0; }
  void use_down_to(std::size_t words) {
    std::fill(stack_.end() - static_cast<std::ptrdiff_t>(words), stack_.end(), 7U);
  }

  // Word by word from the lowest one: what is still painted was never used.
  [[nodiscard]] std::uint32_t truth() const {
    const auto used =
        std::ranges::find_if(stack_, [](std::uint32_t word) { return word != StackGauge::kPaint; });
    return static_cast<std::uint32_t>((stack_.end() - used) * 4);
  }

  std::uint32_t look() {
    loads_ = 0;
    return gauge_.used_bytes(stack_);
  }

  std::vector<std::uint32_t> stack_ = std::vector<std::uint32_t>(kWords, StackGauge::kPaint);
  StackGauge gauge_;
  std::size_t loads_ = 0;
};

TEST_F(PaintedStack, ThatNobodyUsedHasNoDepth) { EXPECT_EQ(look(), 0U); }

TEST_F(PaintedStack, ThatGrowsShowsAtOnce) {
  for (const std::size_t words : {1U, 2U, 1500U, 1501U, 40'000U, 65'535U, 65'536U}) {
    use_down_to(words);
    EXPECT_EQ(look(), 4 * words);
  }
}

TEST_F(PaintedStack, NeverShrinks) {
  use_down_to(3000);
  ASSERT_EQ(look(), 12'000U);
  // A word that is used may hold what paint looks like.
  std::ranges::fill(stack_, StackGauge::kPaint);
  EXPECT_EQ(look(), 12'000U);
}

TEST_F(PaintedStack, ShowsGrowthOverWhatAFrameLeavesUnwrittenAtOnce) {
  use_down_to(100);
  ASSERT_EQ(look(), 400U);
  use(100 + StackGauge::kGapWords - 1);
  EXPECT_EQ(look(), truth());
}

TEST_F(PaintedStack, ShowsAnyWordWithinASweep) {
  for (const std::size_t word : {5000U, 65'535U, 30'000U, 65'000U}) {
    std::ranges::fill(stack_, StackGauge::kPaint);
    gauge_ = {};
    use_down_to(10);
    look();
    use(word);
    for (std::size_t looks = 0; looks < kLooksOfASweep; ++looks) {
      look();
    }
    EXPECT_EQ(look(), truth()) << word;
  }
}

TEST_F(PaintedStack, CostsALookNoMoreThanItsBoundAndWhatHasGrown) {
  tests::Random random{3};
  std::uint32_t before = 0;
  for (int looks = 0; looks < 2000; ++looks) {
    if (random.one_in(50)) {
      use(random.below(kWords));
    }
    const std::uint32_t now = look();
    EXPECT_GE(now, before);
    EXPECT_LE(now, truth()) << "never more than there was";
    EXPECT_LE(loads_, StackGauge::kGapWords + StackGauge::kSweepWords + (now - before) / 4);
    before = now;
  }
  EXPECT_GT(before, 0U);
}

}  // namespace
}  // namespace iog::imx6
