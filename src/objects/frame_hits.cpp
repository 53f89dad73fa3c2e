#include "objects/frame_hits.hpp"

#include <algorithm>
#include <numeric>

#include "numeric/division.hpp"
#include "numeric/magnitude.hpp"

namespace iog::objects {
namespace {

constexpr unsigned kSliceBits = 5;
constexpr unsigned kSideBits = geometry::kTileSideLog2;
constexpr unsigned kSlotBits = 10;
static_assert(kMostSlices <= 1U << kSliceBits);
static_assert(window::kSlotCount == 1U << kSlotBits && kSlotBits == 2 * kSideBits);

constexpr unsigned kSlotShift = kSliceBits + 2 * kSideBits;
constexpr unsigned kRingShift = kSlotShift + kSlotBits;

// A key has three digits.
constexpr unsigned kDigitBits = 10;
constexpr std::uint32_t kDigits = 1U << kDigitBits;
constexpr std::size_t kDigitsOfAKey = 3;
static_assert(kRingShift + 5 == kDigitsOfAKey * kDigitBits);

constexpr std::uint32_t digit_of(std::uint32_t key, std::size_t digit) {
  return key >> digit * kDigitBits & (kDigits - 1);
}

constexpr std::uint32_t kInTile = geometry::kTileSide - 1;
constexpr std::uint32_t kInWindow = window::kCellsAcross - 1;

// A coordinate of a cell of the window, from its lowest ten bits and the lowest coordinate of the
// window.
constexpr std::int32_t coordinate(std::uint32_t low_bits, std::int32_t lowest) {
  const std::uint32_t from_lowest = (low_bits - static_cast<std::uint32_t>(lowest)) & kInWindow;
  return lowest + static_cast<std::int32_t>(from_lowest);
}

}  // namespace

FrameHits::Left FrameHits::gather(const Frame& frame) {
  begin(frame);
  Left left;
  const std::size_t seen = collect(frame, left);
  sort(seen);
  const auto end = std::unique(keys_.begin(), keys_.begin() + static_cast<std::ptrdiff_t>(seen));
  const auto once = static_cast<std::size_t>(end - keys_.begin());
  count_ = std::min(once, kMostHits);
  left.beyond += static_cast<std::uint32_t>(once - count_);
  for (std::size_t i = 0; i < count_; ++i) {
    begin_hit(keys_[i], frame, hits_[i]);
  }
  return left;
}

void FrameHits::begin(const Frame& frame) {
  area_ = frame.area;
  const window::TileNumber car =
      window::window_tile({numeric::div_floor(frame.car.x_mm, geometry::kCellMm),
                           numeric::div_floor(frame.car.y_mm, geometry::kCellMm)});
  const auto away = [](std::int32_t from, std::int32_t to) {
    return static_cast<std::uint8_t>(
        std::min<std::int32_t>(numeric::magnitude(to - from), kRings - 1));
  };
  for (std::size_t i = 0; i < columns_away_.size(); ++i) {
    columns_away_[i] = away(car.a, area_.corner().a + static_cast<std::int32_t>(i));
    rows_away_[i] = away(car.b, area_.corner().b + static_cast<std::int32_t>(i));
  }
}

// The number of rings that fit, counted from the nearest.
std::uint32_t FrameHits::rings_that_fit(const Frame& frame) const {
  std::array<std::size_t, kRings> of_ring{};
  for (const Hit& hit : frame.hits) {
    if (const geometry::Cell at = in_window(hit.cell); window::kWindowCells.contains(at)) {
      ++of_ring[ring_of(at)];
    }
  }
  std::size_t fit = 0;
  std::uint32_t rings = 0;
  while (rings < kRings && fit + of_ring[rings] <= kMostSeen) {
    fit += of_ring[rings++];
  }
  return rings;
}

std::size_t FrameHits::collect(const Frame& frame, Left& left) {
  const std::size_t slices = std::min(frame.ages_ms.size(), kMostSlices);
  const std::uint32_t rings = frame.hits.size() <= kMostSeen ? kRings : rings_that_fit(frame);
  Key* next = other_.data();
  std::uint32_t wrong = 0;
  for (const Hit& hit : frame.hits) {
    const geometry::Cell at = in_window(hit.cell);
    if (hit.slice >= slices || !window::kWindowCells.contains(at)) {
      ++wrong;
    } else {
      // No branch here, because it would be hard to predict: the next key overwrites one that is
      // too far.
      const std::uint32_t ring = ring_of(at);
      *next = key_of(ring, hit.cell, hit.slice);
      next += ring < rings ? 1 : 0;
    }
  }
  const auto count = static_cast<std::size_t>(next - other_.data());
  left = {.beyond = static_cast<std::uint32_t>(frame.hits.size() - count) - wrong, .wrong = wrong};
  return count;
}

// Radix sort, lowest digit first: each round keeps the order of the previous one.
void FrameHits::sort(std::size_t count) {
  std::array<std::array<std::uint16_t, kDigits>, kDigitsOfAKey> places{};  // counts, then places
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t digit = 0; digit < kDigitsOfAKey; ++digit) {
      ++places[digit][digit_of(other_[i], digit)];
    }
  }
  for (auto& of_digit : places) {
    std::exclusive_scan(of_digit.begin(), of_digit.end(), of_digit.begin(), std::uint16_t{0});
  }
  const auto one_round = [&](std::size_t digit, const auto& from, auto& to) {
    for (std::size_t i = 0; i < count; ++i) {
      to[places[digit][digit_of(from[i], digit)]++] = from[i];
    }
  };
  one_round(0, other_, keys_);
  one_round(1, keys_, other_);
  one_round(2, other_, keys_);
}

// Relative to the lowest cell of the area. The difference is exact modulo 2^32, so cells outside
// the window stay outside.
inline geometry::Cell FrameHits::in_window(geometry::Cell cell) const {
  const auto from = [](std::int32_t lowest_tile, std::int32_t at) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(at) -
                                     static_cast<std::uint32_t>(lowest_tile * window::kTileSide));
  };
  return {from(area_.corner().a, cell.x), from(area_.corner().b, cell.y)};
}

inline std::uint32_t FrameHits::ring_of(geometry::Cell at) const {
  return std::max(columns_away_[static_cast<std::uint32_t>(at.x) >> kSideBits],
                  rows_away_[static_cast<std::uint32_t>(at.y) >> kSideBits]);
}

inline FrameHits::Key FrameHits::key_of(std::uint32_t ring, geometry::Cell cell,
                                        std::uint8_t slice) {
  const auto x = static_cast<Key>(cell.x);
  const auto y = static_cast<Key>(cell.y);
  const Key slot = (y >> kSideBits & kInTile) << kSideBits | (x >> kSideBits & kInTile);
  const Key in_tile = (y & kInTile) << kSideBits | (x & kInTile);
  return ring << kRingShift | slot << kSlotShift | in_tile << kSliceBits | slice;
}

// Written in place, because a copy would take as long as the rest of gather().
inline void FrameHits::begin_hit(Key key, const Frame& frame, FrameHit& hit) const {
  const Key slot = key >> kSlotShift;
  const Key in_tile = key >> kSliceBits;
  const Key x = (slot & kInTile) << kSideBits | (in_tile & kInTile);
  const Key y = (slot >> kSideBits & kInTile) << kSideBits | (in_tile >> kSideBits & kInTile);
  const geometry::Cell cell{coordinate(x, area_.corner().a * window::kTileSide),
                            coordinate(y, area_.corner().b * window::kTileSide)};
  hit.cell = cell;
  hit.moved = centre_of(cell);
  hit.age_ms = frame.ages_ms[key & ((1U << kSliceBits) - 1)];
  hit.owner = kNobody;
  hit.cluster = kNobody;
  hit.name = Name::kUnknown;
  hit.is_open = false;
  hit.stands = false;
  hit.is_old = false;
  hit.oldest_epoch = 0;
  hit.contradicted = 0;
}

// Relies on the order: cells of one row of a tile are adjacent.
bool FrameHits::is_hit_around(geometry::Cell cell) const {
  for (std::int32_t y = cell.y - 1; y <= cell.y + 1; ++y) {
    for (std::int32_t x = cell.x - 1; x <= cell.x + 1;) {
      const std::int32_t last = std::min(cell.x + 1, x | std::int32_t{kInTile});
      if (is_hit_between({x, y}, {last, y})) {
        return true;
      }
      x = last + 1;
    }
  }
  return false;
}

bool FrameHits::is_hit_between(geometry::Cell first, geometry::Cell last) const {
  if (!window::kWindowCells.contains(in_window(first))) {
    return false;
  }
  const std::uint32_t ring = ring_of(in_window(first));
  const auto end = keys_.begin() + static_cast<std::ptrdiff_t>(count_);
  const auto found = std::lower_bound(keys_.begin(), end, key_of(ring, first, 0));
  return found != end && *found <= key_of(ring, last, (1U << kSliceBits) - 1);
}

std::size_t FrameHits::first_of(geometry::Cell cell) const {
  const Key key = key_of(ring_of(in_window(cell)), cell, 0);
  const auto end = keys_.begin() + static_cast<std::ptrdiff_t>(count_);
  const auto found = std::lower_bound(keys_.begin(), end, key);
  const bool is_there = found != end && (*found ^ key) >> kSliceBits == 0;
  return is_there ? static_cast<std::size_t>(found - keys_.begin()) : count_;
}

}  // namespace iog::objects
