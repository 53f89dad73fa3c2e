#include "lab/evaluation/perception.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

namespace iog::lab {

void SaidCounts::add(Said said) {
  switch (said) {
    case Said::kUnknown:
      ++unknown;
      break;
    case Said::kFree:
      ++free;
      break;
    case Said::kMoving:
      ++moving;
      break;
    case Said::kStanding:
      ++standing;
      break;
    case Said::kOpen:
      ++open;
      break;
  }
}

SaidCounts& SaidCounts::operator+=(const SaidCounts& other) {
  unknown += other.unknown;
  free += other.free;
  moving += other.moving;
  standing += other.standing;
  open += other.open;
  return *this;
}

namespace {

constexpr std::size_t kNear = 2;  // cells

// visit(place) for each of the cells near (x, y), which is not near the border.
template <typename Visit>
void visit_near(std::size_t side, std::size_t x, std::size_t y, Visit&& visit) {
  for (std::size_t row = y - kNear; row <= y + kNear; ++row) {
    for (std::size_t column = x - kNear; column <= x + kNear; ++column) {
      visit(row * side + column);
    }
  }
}

bool is_kept(std::span<const std::int8_t> classes, std::size_t side, std::size_t x, std::size_t y) {
  bool kept = false;
  visit_near(side, x, y,
             [&](std::size_t place) { kept = kept || is_occupied(said_by(classes[place])); });
  return kept;
}

}  // namespace

void RecentHits::add_frame(std::vector<Hit> hits) {
  frames_.push_front(std::move(hits));
  if (frames_.size() > kFrames) {
    frames_.pop_back();
  }
}

std::uint64_t RecentHits::Kept::all_cells() const {
  return std::accumulate(cells.begin(), cells.end(), std::uint64_t{0});
}

std::uint64_t RecentHits::Kept::all_kept() const {
  return std::accumulate(kept.begin(), kept.end(), std::uint64_t{0});
}

RecentHits::Kept& RecentHits::Kept::operator+=(const Kept& other) {
  for (std::size_t kind = 0; kind < kKinds; ++kind) {
    cells[kind] += other.cells[kind];
    kept[kind] += other.kept[kind];
    freed[kind] += other.freed[kind];
  }
  return *this;
}

RecentHits::Kept RecentHits::compare(std::span<const std::int8_t> classes, std::size_t side,
                                     geometry::Cell first) const {
  struct Place {
    std::size_t x;
    std::size_t y;
    std::uint8_t kind;
  };
  std::vector<std::uint16_t> hit_in(classes.size());  // bit i: in the frame of age i
  std::vector<Place> places;
  for (std::size_t age = 0; age < frames_.size(); ++age) {
    for (const Hit& hit : frames_[age]) {
      // What lies below the window wraps to a large number.
      const auto x = static_cast<std::size_t>(hit.cell.x - first.x);
      const auto y = static_cast<std::size_t>(hit.cell.y - first.y);
      if (x - kNear >= side - 2 * kNear || y - kNear >= side - 2 * kNear) {
        continue;
      }
      std::uint16_t& frames = hit_in[y * side + x];
      if (frames == 0) {
        places.push_back({x, y, hit.kind});
      }
      frames = static_cast<std::uint16_t>(frames | (1U << age));
    }
  }
  Kept kept;
  for (const auto& [x, y, kind] : places) {
    unsigned frames = 0;
    visit_near(side, x, y, [&](std::size_t near) { frames |= hit_in[near]; });
    if (std::popcount(frames) >= kHits) {
      const bool is_there = is_kept(classes, side, x, y);
      ++kept.cells[kind];
      kept.kept[kind] += is_there ? 1U : 0U;
      kept.freed[kind] += !is_there && said_by(classes[y * side + x]) == Said::kFree ? 1U : 0U;
    }
  }
  return kept;
}

namespace {

constexpr std::uint8_t kFromLeft = 1;
constexpr std::uint8_t kFromRight = 2;
constexpr std::uint8_t kFromBelow = 4;
constexpr std::uint8_t kFromAbove = 8;

// 1 if it is: from the left and the right, or from below and above.
std::uint32_t is_between(std::uint8_t from) {
  static_assert(kFromRight == kFromLeft << 1 && kFromAbove == kFromBelow << 1);
  return (from & from >> 1 & (kFromLeft | kFromBelow)) != 0 ? 1 : 0;
}

// From which sides a known cell is near, which may be the cell itself. Lines are followed away from
// each side, with where the last known cell was.
class KnownSides {
 public:
  KnownSides(std::span<const std::int8_t> cells, std::size_t side, std::size_t reach)
      : cells_(cells), reach_(static_cast<std::uint8_t>(reach)), from_(cells.size()) {
    std::vector<std::uint8_t> from_below(side, kNoneYet);
    std::vector<std::uint8_t> from_above(side, kNoneYet);
    for (std::size_t row = 0; row < side; ++row) {
      follow_row(row * side, side);
      follow_columns(row * side, from_below, kFromBelow);
      follow_columns((side - 1 - row) * side, from_above, kFromAbove);
    }
  }

  [[nodiscard]] std::uint8_t at(std::size_t place) const { return from_[place]; }

 private:
  static constexpr std::uint8_t kNoneYet = 0xFF;

  void follow_row(std::size_t first, std::size_t side) {
    const std::int8_t* const cells = &cells_[first];
    std::uint8_t* const from = &from_[first];
    const std::size_t reach = reach_;
    const std::size_t none = 0 - std::size_t{kNoneYet};
    std::size_t last = none;
    for (std::size_t x = 0; x < side; ++x) {
      last = cells[x] != 0 ? x : last;
      from[x] = with(from[x], x - last <= reach, kFromLeft);
    }
    last = none;  // from the right end
    for (std::size_t x = 0; x < side; ++x) {
      const std::size_t mirrored = side - 1 - x;
      last = cells[mirrored] != 0 ? x : last;
      from[mirrored] = with(from[mirrored], x - last <= reach, kFromRight);
    }
  }

  // All columns by one cell, which the compiler does for many at a time. backs: cells since the
  // last known one, at most kNoneYet.
  void follow_columns(std::size_t first, std::vector<std::uint8_t>& backs, std::uint8_t bit) {
    const std::int8_t* const cells = &cells_[first];
    std::uint8_t* const from = &from_[first];
    std::uint8_t* const back = backs.data();
    const std::uint8_t reach = reach_;
    const std::size_t side = backs.size();
    for (std::size_t x = 0; x < side; ++x) {
      back[x] =
          static_cast<std::uint8_t>(cells[x] != 0 ? 0 : back[x] + (back[x] < kNoneYet ? 1 : 0));
      from[x] = with(from[x], back[x] <= reach, bit);
    }
  }

  static std::uint8_t with(std::uint8_t from, bool is_near, std::uint8_t bit) {
    return static_cast<std::uint8_t>(from | (is_near ? bit : 0));
  }

  std::span<const std::int8_t> cells_;
  std::uint8_t reach_;
  std::vector<std::uint8_t> from_;
};

}  // namespace

GapCounts& GapCounts::operator+=(const GapCounts& other) {
  between += other.between;
  unknown += other.unknown;
  return *this;
}

GapCounts gaps_in(std::span<const std::int8_t> cells, std::size_t side, const GapRange& range) {
  const KnownSides from(cells, side, range.reach);
  GapCounts counts;
  std::size_t place = 0;
  for (std::int32_t y = -range.middle.y; place < cells.size(); ++y) {
    const std::size_t end = place + side;
    std::uint32_t between = 0;
    std::uint32_t unknown = 0;
    for (std::int32_t x = -range.middle.x; place < end; ++x, ++place) {
      const std::uint32_t is_far = x * x + y * y >= range.far_cells * range.far_cells ? 1 : 0;
      const std::uint32_t counts_here = is_far & is_between(from.at(place));
      between += counts_here;
      unknown += cells[place] == 0 ? counts_here : 0;
    }
    counts.between += between;
    counts.unknown += unknown;
  }
  return counts;
}

}  // namespace iog::lab
