#include "intake/swept_sectors.hpp"

#include <algorithm>
#include <bit>

#include "require/require.hpp"

namespace iog::intake {

SweptSectors::SweptSectors(std::uint32_t ticks_per_turn) : ticks_per_turn_{ticks_per_turn} {
  require(ticks_per_turn <= kMaxTicksPerTurn);
}

template <typename Visit>
void SweptSectors::for_each_word(const lidar::Sector& sector, Visit&& visit) const {
  std::uint32_t tick = sector.first_ticks;
  std::uint32_t left = sector.width_ticks;
  bool goes_on = true;
  while (left > 0 && goes_on) {
    const std::uint32_t bit = tick % kWordTicks;
    const std::uint32_t count =
        std::min<std::uint32_t>({left, kWordTicks - bit, ticks_per_turn_ - tick});
    const std::uint64_t ones = (std::uint64_t{1} << count) - 1;
    goes_on = visit(tick / kWordTicks, static_cast<std::uint32_t>(ones << bit));
    left -= count;
    tick = tick + count == ticks_per_turn_ ? 0 : tick + count;
  }
}

void SweptSectors::add(const lidar::Sector& sector) {
  for_each_word(sector, [this](std::size_t word, std::uint32_t bits) {
    count_ += static_cast<std::uint32_t>(std::popcount(bits & ~words_[word]));
    words_[word] |= bits;
    return true;
  });
}

void SweptSectors::clear() {
  if (count_ > 0) {
    words_ = {};
    count_ = 0;
  }
}

bool SweptSectors::misses_more_than(std::uint32_t ticks, const lidar::Sector& sector) const {
  std::uint32_t missing = 0;
  for_each_word(sector, [&](std::size_t word, std::uint32_t bits) {
    if (const std::uint32_t bits_missing = bits & ~words_[word]; bits_missing != 0) {
      missing += static_cast<std::uint32_t>(std::popcount(bits_missing));
    }
    return missing <= ticks;
  });
  return missing > ticks;
}

}  // namespace iog::intake
