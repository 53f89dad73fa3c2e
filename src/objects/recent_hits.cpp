#include "objects/recent_hits.hpp"

#include <algorithm>
#include <bit>

namespace iog::objects {

// The union of three cells in a row, in the lowest byte. Reads four bytes at once unless they cross
// the end of a row.
std::uint32_t RecentHits::three_from(std::int32_t x, std::int32_t y) const {
  const std::uint32_t first = place_of(x, y);
  if (first % kSide > kSide - sizeof(std::uint32_t)) {
    return std::uint32_t{bits_[first]} | bits_[place_of(x + 1, y)] | bits_[place_of(x + 2, y)];
  }
  std::uint32_t four = 0;
  static_assert(std::endian::native == std::endian::little, "the first byte is the lowest");
  __builtin_memcpy(&four, &bits_[first], sizeof four);
  return four | four >> 8 | four >> 16;
}

std::uint8_t RecentHits::epochs_around(geometry::Cell cell) const {
  std::uint32_t any = 0;
  for (std::int32_t y = cell.y - 1; y <= cell.y + 1; ++y) {
    any |= three_from(cell.x - 1, y);
  }
  return std::rotr(static_cast<std::uint8_t>(any), static_cast<int>((epoch_ + 1) % kEpochs));
}

int RecentHits::oldest(geometry::Cell cell) const {
  const std::uint8_t epochs = epochs_around(cell);
  return epochs == 0 ? 0 : kEpochs - 1 - std::countr_zero(epochs);
}

bool RecentHits::is_hit_lately(geometry::Cell cell) const {
  return epochs_around(cell) >> (kEpochs - 2) != 0;
}

void RecentHits::add(std::uint64_t now_us, std::span<const FrameHit> hits) {
  const std::uint64_t epoch = now_us / kEpochUs;
  epoch_ = std::max(epoch_, epoch < kEpochs ? 0 : epoch - kEpochs);
  while (epoch_ < epoch) {
    drop(++epoch_ % kEpochs);
  }
  const std::size_t its = epoch_ % kEpochs;
  const auto bit = static_cast<std::uint8_t>(1U << its);
  for (const FrameHit& hit : hits) {
    const std::uint32_t place = place_of(hit.cell.x, hit.cell.y);
    if ((bits_[place] & bit) == 0 && counts_[its] < kMostOfAnEpoch) {
      bits_[place] = static_cast<std::uint8_t>(bits_[place] | bit);
      places_[its][counts_[its]++] = place;
    }
  }
}

void RecentHits::forget() {
  for (std::size_t epoch = 0; epoch < kEpochs; ++epoch) {
    drop(epoch);
  }
  epoch_ = 0;
}

void RecentHits::drop(std::size_t epoch) {
  const auto others = static_cast<std::uint8_t>(~(1U << epoch));
  for (std::size_t i = 0; i < counts_[epoch]; ++i) {
    std::uint8_t& bits = bits_[places_[epoch][i]];
    bits = static_cast<std::uint8_t>(bits & others);
  }
  counts_[epoch] = 0;
}

}  // namespace iog::objects
