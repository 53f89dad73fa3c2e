#include "objects/frame_hits.hpp"

#include <algorithm>

#include "numeric/division.hpp"
#include "numeric/magnitude.hpp"
#include "window/cell_place.hpp"

namespace iog::objects {
namespace {

constexpr unsigned kSliceBits = 5;
constexpr unsigned kCellBits = 2 * geometry::kTileSideLog2;
constexpr unsigned kSlotBits = 10;
constexpr unsigned kRings = 32;
static_assert(kMostSlices <= 1U << kSliceBits);
static_assert(window::kSlotCount == 1U << kSlotBits);

constexpr unsigned kSlotShift = kSliceBits + kCellBits;
constexpr unsigned kRingShift = kSlotShift + kSlotBits;

// Three digits are all of a key.
constexpr unsigned kDigitBits = 10;
constexpr std::uint32_t kDigits = 1U << kDigitBits;
static_assert(kRingShift + 5 == 3 * kDigitBits && kRings == 1U << 5);

}  // namespace

FrameHits::Left FrameHits::gather(const Frame& frame) {
  area_ = frame.area;
  car_tile_ = window::window_tile({numeric::div_floor(frame.car.x_mm, geometry::kCellMm),
                                   numeric::div_floor(frame.car.y_mm, geometry::kCellMm)});
  Left left;
  const std::size_t seen = collect(frame, left);
  sort(seen);
  const auto end = std::unique(keys_.begin(), keys_.begin() + static_cast<std::ptrdiff_t>(seen));
  const auto once = static_cast<std::size_t>(end - keys_.begin());
  count_ = std::min(once, kMostHits);
  left.beyond += static_cast<std::uint32_t>(once - count_);
  for (std::size_t i = 0; i < count_; ++i) {
    hits_[i] = hit_of(keys_[i], frame);
  }
  return left;
}

// Those of the rings from the nearest on that fit as a whole.
std::size_t FrameHits::collect(const Frame& frame, Left& left) {
  const std::size_t slices = std::min(frame.ages_ms.size(), kMostSlices);
  const auto key = [&](const Hit& hit) {
    return hit.slice < slices ? key_of(hit.cell, hit.slice) : kNoKey;
  };
  std::array<std::size_t, kRings + 1> of_ring{};  // and those that are wrong
  for (const Hit& hit : frame.hits) {
    ++of_ring[std::min<Key>(key(hit) >> kRingShift, kRings)];
  }
  left.wrong = static_cast<std::uint32_t>(of_ring[kRings]);
  std::size_t fit = 0;
  std::uint32_t rings = 0;
  while (rings < kRings && fit + of_ring[rings] <= kMostSeen) {
    fit += of_ring[rings++];
  }
  std::size_t count = 0;
  for (const Hit& hit : frame.hits) {
    const Key its = key(hit);
    if (its >> kRingShift < rings) {
      keys_[count++] = its;
    }
  }
  left.beyond = static_cast<std::uint32_t>(frame.hits.size() - count) - left.wrong;
  return count;
}

// By digits, the lowest first: each round keeps the order of the one before.
void FrameHits::sort(std::size_t count) {
  const auto one_round = [&](const auto& from, auto& to, unsigned shift) {
    std::array<std::uint16_t, kDigits + 1> begin{};
    for (std::size_t i = 0; i < count; ++i) {
      ++begin[(from[i] >> shift & (kDigits - 1)) + 1];
    }
    for (std::size_t digit = 1; digit < begin.size(); ++digit) {
      begin[digit] = static_cast<std::uint16_t>(begin[digit] + begin[digit - 1]);
    }
    for (std::size_t i = 0; i < count; ++i) {
      to[begin[from[i] >> shift & (kDigits - 1)]++] = from[i];
    }
  };
  one_round(keys_, other_, 0);
  one_round(other_, keys_, kDigitBits);
  one_round(keys_, other_, 2 * kDigitBits);
  std::copy_n(other_.begin(), count, keys_.begin());
}

inline FrameHits::Key FrameHits::key_of(geometry::Cell cell, std::uint8_t slice) const {
  constexpr std::uint32_t kMask = geometry::kTileSide - 1;
  const window::TileNumber tile = window::window_tile(cell);
  if (!area_.contains(tile)) {
    return kNoKey;
  }
  const std::int32_t away =
      std::max(numeric::magnitude(tile.a - car_tile_.a), numeric::magnitude(tile.b - car_tile_.b));
  const auto ring = static_cast<Key>(std::min<std::int32_t>(away, kRings - 1));
  const auto slot = static_cast<Key>(window::slot_of(tile));
  const Key in_tile = (static_cast<Key>(cell.y) & kMask) << geometry::kTileSideLog2 |
                      (static_cast<Key>(cell.x) & kMask);
  return ring << kRingShift | slot << kSlotShift | in_tile << kSliceBits | slice;
}

FrameHit FrameHits::hit_of(Key key, const Frame& frame) const {
  constexpr std::uint32_t kMask = geometry::kTileSide - 1;
  const window::TileNumber tile = area_.tile_at(key >> kSlotShift & (window::kSlotCount - 1));
  const auto x = static_cast<std::int32_t>(key >> kSliceBits & kMask);
  const auto y = static_cast<std::int32_t>(key >> (kSliceBits + geometry::kTileSideLog2) & kMask);
  FrameHit hit;
  hit.cell = {tile.a * window::kTileSide + x, tile.b * window::kTileSide + y};
  hit.at = centre_of(hit.cell);
  hit.moved = hit.at;
  hit.age_ms = frame.ages_ms[key & ((1U << kSliceBits) - 1)];
  return hit;
}

std::size_t FrameHits::first_of(geometry::Cell cell) const {
  const Key key = key_of(cell, 0);
  const auto end = keys_.begin() + static_cast<std::ptrdiff_t>(count_);
  const auto found = std::lower_bound(keys_.begin(), end, key);
  const bool is_there = found != end && (*found ^ key) >> kSliceBits == 0;
  return is_there ? static_cast<std::size_t>(found - keys_.begin()) : count_;
}

}  // namespace iog::objects
