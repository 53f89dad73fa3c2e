// Slices in the window: free is pulled, hits are pushed and win, and nothing shows the order.
#include "placing/frame_evidence.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "placing/exact_place.hpp"
#include "placing/slice.hpp"

namespace iog::placing {
namespace {

using geometry::Cell;
using tests::placed;
using tests::Slice;

constexpr window::Area kAroundOrigin({-16, -16});
constexpr Cell kOrigin{geometry::kOriginCell, geometry::kOriginCell};

// Evidence of slices in an area.
class Evidence {
 public:
  explicit Evidence(const window::Area& area = kAroundOrigin) : area_(area) {}

  Evidence& add(const Slice& slice, const Placement& at) {
    tests::hand_over(slice, *cells_);
    evidence_->add(*cells_, area_, at);
    cells_->clear();
    return *this;
  }
  void clear() { evidence_->clear(); }

  // Of a cell of the local frame.
  [[nodiscard]] int at(Cell cell) const {
    const window::TileNumber tile{numeric::div_floor(cell.x, window::kTileSide),
                                  numeric::div_floor(cell.y, window::kTileSide)};
    const Cell in_tile{cell.x - tile.a * window::kTileSide, cell.y - tile.b * window::kTileSide};
    const std::size_t slot = window::slot_of(tile);
    const auto place = static_cast<std::uint32_t>(in_tile.y * window::kTileSide + in_tile.x);
    return evidence_->is_touched(slot) ? evidence_->tile(slot)[place] : 0;
  }
  [[nodiscard]] bool is_tall(Cell cell) const {
    const window::TileNumber tile{numeric::div_floor(cell.x, window::kTileSide),
                                  numeric::div_floor(cell.y, window::kTileSide)};
    const std::size_t slot = window::slot_of(tile);
    const std::uint32_t row =
        evidence_->tall(slot)[static_cast<std::uint32_t>(cell.y - tile.b * window::kTileSide)];
    return evidence_->is_touched(slot) && (row >> (cell.x - tile.a * window::kTileSide) & 1U) != 0;
  }

  // '.' free, '#' hit, ' ' nothing.
  [[nodiscard]] std::vector<std::string> picture(Cell low, std::int32_t width,
                                                 std::int32_t height) const {
    std::vector<std::string> rows;
    for (std::int32_t y = low.y + height - 1; y >= low.y; --y) {
      std::string row;
      for (std::int32_t x = low.x; x < low.x + width; ++x) {
        const int index = at({x, y});
        row += index > 0 ? '#' : index < 0 ? '.' : ' ';
      }
      rows.push_back(row);
    }
    return rows;
  }

  template <typename Of>
  [[nodiscard]] int sum(Of&& of) const {
    int sum = 0;
    for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
      if (evidence_->is_touched(slot)) {
        for (const std::int8_t index : evidence_->tile(slot)) {
          sum += of(int{index});
        }
      }
    }
    return sum;
  }

  friend bool operator==(const Evidence& a, const Evidence& b) {
    for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
      if (a.evidence_->is_touched(slot) != b.evidence_->is_touched(slot) ||
          (a.evidence_->is_touched(slot) && a.evidence_->tile(slot) != b.evidence_->tile(slot)) ||
          (a.evidence_->has_hit(slot) && a.evidence_->tall(slot) != b.evidence_->tall(slot))) {
        return false;
      }
    }
    return true;
  }

 private:
  window::Area area_;
  std::unique_ptr<SliceCells> cells_ = std::make_unique<SliceCells>();
  std::unique_ptr<FrameEvidence> evidence_ = std::make_unique<FrameEvidence>();
};

const std::vector<std::string> kScene{"..#  ",  //
                                      ".... ",  //
                                      "....#"};

TEST(FrameEvidence, AWholeNumberOfCellsShiftsAPicture) {
  Slice slice;
  slice.draw({kOrigin.x + 3, kOrigin.y - 1}, kScene);
  Evidence evidence;
  evidence.add(slice, placed(2 * geometry::kCellMm, -5 * geometry::kCellMm));
  EXPECT_EQ(evidence.picture({5, -6}, 5, 3), kScene);
}

TEST(FrameEvidence, AQuarterTurnTurnsAPicture) {
  Slice slice;
  slice.draw(kOrigin, kScene);
  Evidence evidence;
  evidence.add(slice, placed(0, 0, 90));
  EXPECT_EQ(evidence.picture({-3, 0}, 3, 5), (std::vector<std::string>{"  #",  //
                                                                       " ..",  //
                                                                       "#..",  //
                                                                       "...",  //
                                                                       "..."}));
}

TEST(FrameEvidence, HitsAreAddedAndEraseWhatIsFree) {
  Slice free_cell;
  free_cell.set(kOrigin, -20);
  Slice hit;
  hit.set(kOrigin, 16);
  const Placement at = placed(0, 0);
  Evidence evidence;
  evidence.add(free_cell, at);
  EXPECT_EQ(evidence.at({0, 0}), -20);
  evidence.add(free_cell, at);
  EXPECT_EQ(evidence.at({0, 0}), -31);
  evidence.add(hit, at);
  EXPECT_EQ(evidence.at({0, 0}), 16);
  evidence.add(free_cell, at);
  EXPECT_EQ(evidence.at({0, 0}), 16);
  evidence.add(hit, at);
  EXPECT_EQ(evidence.at({0, 0}), 31);
  evidence.clear();
  EXPECT_EQ(evidence.at({0, 0}), 0);
}

// A cell is free from below if one of the beams was low, and a cell is hit by something tall if one
// of the hits was; a hit erases both what was free and how.
TEST(FrameEvidence, HowLowAndHowTallIsThatOfAnySlice) {
  Slice from_below;
  from_below.draw(kOrigin, {","});
  Slice from_above;
  from_above.draw(kOrigin, {"."});
  Slice hit;
  hit.draw(kOrigin, {"#"});
  Slice tall;
  tall.draw(kOrigin, {"T"});
  const Placement at = placed(0, 0);
  Evidence evidence;
  evidence.add(from_above, at);
  EXPECT_EQ(evidence.at({0, 0}), byte_of(-14, false));
  evidence.add(from_below, at);
  evidence.add(from_above, at);
  EXPECT_EQ(evidence.at({0, 0}), byte_of(-31, true));
  evidence.add(hit, at);
  EXPECT_EQ(evidence.at({0, 0}), 2);
  EXPECT_FALSE(evidence.is_tall({0, 0}));
  evidence.add(tall, at);
  evidence.add(hit, at);
  evidence.add(from_below, at);
  EXPECT_EQ(evidence.at({0, 0}), 6);
  EXPECT_TRUE(evidence.is_tall({0, 0}));
  evidence.clear();
  EXPECT_FALSE(evidence.is_tall({0, 0}));
}

// What a tile was asked in the frame before does not show.
TEST(FrameEvidence, ATileIsTouchedOrHitInThisFrameAlone) {
  const auto evidence = std::make_unique<FrameEvidence>();
  const auto add = [&](const Slice& slice) {
    const auto cells = std::make_unique<SliceCells>();
    tests::hand_over(slice, *cells);
    evidence->add(*cells, kAroundOrigin, placed(0, 0));
  };
  Slice hit;
  hit.draw(kOrigin, {"T"});
  Slice free;
  free.draw(kOrigin, {"."});
  const std::size_t slot = window::slot_of({0, 0});
  add(hit);
  EXPECT_TRUE(evidence->is_touched(slot));
  EXPECT_TRUE(evidence->has_hit(slot));
  evidence->clear(slot);
  EXPECT_FALSE(evidence->is_touched(slot));
  EXPECT_FALSE(evidence->has_hit(slot));
  add(free);
  EXPECT_TRUE(evidence->is_touched(slot));
  EXPECT_FALSE(evidence->has_hit(slot));
}

// What is said to be nowhere near, and not to be hit, is not; and nothing is left behind.
TEST(SliceCells, SayWhereSomethingIsKnown) {
  const auto cells = std::make_unique<SliceCells>();
  tests::Random random(3);
  for (int time = 0; time < 20; ++time) {
    Slice slice;
    for (int i = 0; i < 40; ++i) {
      slice.set({random.between(0, 1023), random.between(0, 1023)}, i % 2 == 0 ? -14 : 2);
    }
    tests::hand_over(slice, *cells);
    std::size_t found = 0;
    for (std::int32_t y = 0; y < 1024; ++y) {
      for (std::int32_t x = 0; x < 1024; ++x) {
        found += cells->at({x, y}) != 0 ? 1U : 0U;
      }
    }
    slice.for_each([&](Cell cell, int index) {
      --found;
      EXPECT_TRUE(cells->is_known(geometry::tile_of(cell)));
      for (int i = 0; i < 64; ++i) {
        const Cell low{cell.x - random.between(0, 10), cell.y - random.between(0, 10)};
        const Cell high{random.between(cell.x, low.x + 10), random.between(cell.y, low.y + 10)};
        ASSERT_TRUE(cells->is_known_near(low, high)) << cell.x << ' ' << cell.y;
      }
      const auto band = static_cast<std::size_t>(cell.y) % geometry::kTileSide / 8;
      EXPECT_TRUE(index < 0 || cells->may_be_hit(geometry::tile_of(cell), band));
    });
    EXPECT_EQ(found, 0U);
    cells->clear();
    const Cell low{random.between(0, 1023), random.between(0, 1023)};
    EXPECT_FALSE(cells->is_known_near(low, {low.x + 10, low.y + 10}));
  }
}

// Squares of four cells around what is known count, no others; nor does what lies outside.
TEST(SliceCells, NothingIsKnownWhereNoSquareIsNear) {
  const auto cells = std::make_unique<SliceCells>();
  Slice slice;
  slice.set({64, 1020}, -14);
  slice.set({1023, 0}, -14);
  tests::hand_over(slice, *cells);
  EXPECT_TRUE(cells->is_known_near({57, 1010}, {67, 1020}));
  EXPECT_TRUE(cells->is_known_near({67, 1023}, {77, 1030}));
  EXPECT_FALSE(cells->is_known_near({68, 1015}, {78, 1025}));
  EXPECT_FALSE(cells->is_known_near({53, 1015}, {63, 1025}));
  EXPECT_FALSE(cells->is_known_near({60, 1009}, {70, 1019}));
  EXPECT_TRUE(cells->is_known_near({1023, -10}, {1033, 0}));
  EXPECT_FALSE(cells->is_known_near({1024, -10}, {1034, 0}));
  EXPECT_FALSE(cells->is_known_near({0, -30}, {10, -20}));
  EXPECT_FALSE(cells->is_known_near({-30, 0}, {-20, 10}));
}

// What a slice leaves in the copy must not show in the next one.
TEST(FrameEvidence, SlicesDoNotMix) {
  Slice first;
  first.draw({100, 100}, kScene);
  Slice second;
  second.draw({700, 300}, kScene);
  const Placement at = placed(12'345, -6'789, 33);
  Evidence both;
  both.add(first, at).add(second, at);
  both.clear();
  both.add(second, at);
  Evidence one;
  one.add(second, at);
  EXPECT_TRUE(both == one);
}

Slice random_slice(tests::Random& random, int cells, int reach) {
  Slice slice;
  for (int i = 0; i < cells; ++i) {
    const int index = random.one_in(3) ? random.between(1, 127) : random.between(-127, -1);
    const Cell cell{kOrigin.x + random.between(-reach, reach - 1),
                    kOrigin.y + random.between(-reach, reach - 1)};
    slice.set(cell, index);
    if (random.one_in(2)) {
      index > 0 ? slice.set_tall(cell) : slice.set_low(cell);
    }
  }
  return slice;
}

TEST(FrameEvidence, NoOrderOfSlicesShows) {
  tests::Random random(4);
  std::vector<std::pair<Slice, Placement>> slices;
  slices.reserve(4);
  for (int i = 0; i < 4; ++i) {
    slices.emplace_back(random_slice(random, 20'000, 60),
                        placed(random.between(-900, 900), random.between(-900, 900), 17.0 * i));
  }
  const auto evidence_in_order = [&](const std::vector<std::size_t>& order) {
    Evidence evidence;
    for (const std::size_t i : order) {
      evidence.add(slices[i].first, slices[i].second);
    }
    return evidence;
  };
  std::vector<std::size_t> order{0, 1, 2, 3};
  const Evidence first = evidence_in_order(order);
  EXPECT_GT(first.sum([](int index) { return index > 0 ? 1 : 0; }), 1000);
  int tried = 0;
  while (std::ranges::next_permutation(order).found && tried++ < tests::effort(23, 5)) {
    ASSERT_TRUE(evidence_in_order(order) == first);
  }
}

// Pulling alone would lose one in six at 45 degrees.
TEST(FrameEvidence, NoHitIsLostAtAnyAngle) {
  tests::Random random(5);
  for (int degrees = 0; degrees < 360; degrees += tests::effort(5, 45)) {
    Slice slice;
    std::map<std::pair<int, int>, int> hits;
    for (int i = 0; i < 300; ++i) {
      const Cell cell{kOrigin.x + random.between(-300, 300), kOrigin.y + random.between(-300, 300)};
      slice.set(cell, 1);
      hits[{cell.x, cell.y}] = 1;
    }
    Evidence evidence;
    evidence.add(slice, placed(random.between(-1500, 1500), random.between(-1500, 1500), degrees));
    ASSERT_EQ(evidence.sum([](int index) { return index; }), static_cast<int>(hits.size()))
        << degrees;
  }
}

// Every cell of the window whose place is clear, against the rule itself: the sum of the hits whose
// centres it holds, else what the cell that holds its centre says, if that is negative.
// Of the cells within `reach` every `step`-th one along x.
void expect_by_the_rule(const Slice& slice, const Placement& at, std::int32_t reach,
                        std::int32_t step) {
  const window::Area area = window::Area::around(window::cell_of(at.pose));
  Evidence evidence(area);
  evidence.add(slice, at);
  std::map<std::pair<int, int>, int> pushed;
  std::map<std::pair<int, int>, bool> tall;
  std::map<std::pair<int, int>, bool> doubtful;
  slice.for_each([&](Cell cell, int index) {
    const tests::ExactPoint to = tests::exact_in_frame(cell, at);
    if (index > 0) {
      pushed[{to.cell().x, to.cell().y}] += std::min(index, 31);
      tall[{to.cell().x, to.cell().y}] |= is_tall(slice.byte_at(cell));
    }
    for (int i = 0; i < 9 && index > 0 && !to.is_clear(); ++i) {
      doubtful[{to.cell().x + i % 3 - 1, to.cell().y + i / 3 - 1}] = true;
    }
  });
  const Cell vehicle = window::cell_of(at.pose);
  int compared = 0;
  for (std::int32_t y = vehicle.y - reach; y <= vehicle.y + reach; ++y) {
    for (std::int32_t x = vehicle.x - reach; x <= vehicle.x + reach; x += step) {
      const tests::ExactPoint from = tests::exact_in_grid({x, y}, at);
      if (!area.contains(Cell{x, y}) || !from.is_clear() || doubtful.contains({x, y})) {
        continue;
      }
      const bool is_inside = geometry::kGridArea.contains(from.cell());
      const int pulled = is_inside ? std::min<int>(slice.byte_at(from.cell()), 0) : 0;
      const auto hit = pushed.find({x, y});
      const int expected = hit == pushed.end() ? pulled : std::min(hit->second, 31);
      ASSERT_EQ(evidence.at({x, y}), expected) << x << " " << y;
      ASSERT_EQ(evidence.is_tall({x, y}), hit != pushed.end() && tall.at({x, y})) << x << " " << y;
      ++compared;
    }
  }
  EXPECT_GT(compared, reach * reach * 3 / step);
}

TEST(FrameEvidence, IsWhatTheRuleSaysNearTheVehicle) {
  tests::Random random(6);
  for (int i = 0; i < tests::effort(12, 2); ++i) {
    const Slice slice = random_slice(random, 3000, 40);
    expect_by_the_rule(
        slice,
        placed(random.between(-1'000'000'000, 1'000'000'000),
               random.between(-1'000'000'000, 1'000'000'000), random.between(0, 359'999) / 1000.0),
        50, 1);
  }
}

// The grid's corners reach beyond the window, the window's beyond the grid.
TEST(FrameEvidence, IsWhatTheRuleSaysUpToTheBordersOfGridAndWindow) {
  tests::Random random(7);
  for (const double degrees : {0.0, 38.0}) {
    expect_by_the_rule(random_slice(random, 30'000, geometry::kOriginCell),
                       placed(3'141, -2'718, degrees), 540, tests::effort(1, 13));
  }
}

}  // namespace
}  // namespace iog::placing
