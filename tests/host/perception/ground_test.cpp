// What has moved, and what is remembered of the ground: rows of bits across tiles and slots against
// the rule cell by cell.
#include "perception/ground.hpp"

#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "perception/arrivals.hpp"
#include "perception/flat_ground.hpp"
#include "placing/slice.hpp"

namespace iog::perception {
namespace {

using geometry::Cell;
using tests::GroundCell;

bool bit(const window::Plane& plane, Cell in_tile) {
  return (plane[static_cast<std::size_t>(in_tile.y)] >> in_tile.x & 1U) != 0;
}

void set(window::Plane& plane, Cell in_tile, bool to) {
  const std::uint32_t mask = 1U << in_tile.x;
  std::uint32_t& row = plane[static_cast<std::size_t>(in_tile.y)];
  row = to ? row | mask : row & ~mask;
}

// A window around a vehicle, whose cells are counted from its lowest corner.
class GroundOf : public testing::Test {
 protected:
  void follow(Cell vehicle) {
    window_->follow(vehicle);
    middle_ = {.x_mm = (window_->area().corner().a + 16) * window::kTileSide * geometry::kCellMm,
               .y_mm = (window_->area().corner().b + 16) * window::kTileSide * geometry::kCellMm};
  }

  [[nodiscard]] std::size_t slot_at(Cell cell) const {
    return window::slot_of({window_->area().corner().a + cell.x / window::kTileSide,
                            window_->area().corner().b + cell.y / window::kTileSide});
  }
  static Cell in_tile(Cell cell) {
    return {cell.x % window::kTileSide, cell.y % window::kTileSide};
  }

  void write(Cell cell, const GroundCell& is) {
    window::Tile& tile = window_->open(slot_at(cell));
    const Cell at = in_tile(cell);
    set(tile.found.freed, at, is.freed);
    set(tile.found.seen, at, is.seen);
    set(tile.found.stands, at, is.stands);
    set(tile.found.taken, at, is.taken);
    set(tile.ground.open, at, is.open);
    set(tile.ground.dense, at, is.dense);
    set(tile.ground.ticks_low, at, (is.ticks & 1) != 0);
    set(tile.ground.ticks_high, at, (is.ticks & 2) != 0);
    if (is.is_hit) {
      hits_.set(cell, 2);
    }
  }

  [[nodiscard]] GroundCell read(Cell cell) const {
    const window::Tile& tile = window_->tile(slot_at(cell));
    const Cell at = in_tile(cell);
    return {.freed = bit(tile.found.freed, at),
            .seen = bit(tile.found.seen, at),
            .stands = bit(tile.found.stands, at),
            .taken = bit(tile.found.taken, at),
            .open = bit(tile.ground.open, at),
            .dense = bit(tile.ground.dense, at),
            .ticks = (bit(tile.ground.ticks_low, at) ? 1 : 0) +
                     (bit(tile.ground.ticks_high, at) ? 2 : 0),
            .is_hit = false};
  }

  // The vehicle's grid lies on the window's cells, so hits are where they are set.
  void find_moved() {
    tests::hand_over(hits_, *cells_);
    evidence_->clear();
    evidence_->add(*cells_, window_->area(), {.pose = middle_});
    cells_->clear();
    arrivals_->find(*window_, *evidence_);
  }
  [[nodiscard]] bool has_moved(Cell cell) const {
    return bit(arrivals_->moved(slot_at(cell)), in_tile(cell));
  }

  std::unique_ptr<window::Window> window_ = std::make_unique<window::Window>();
  std::unique_ptr<placing::FrameEvidence> evidence_ = std::make_unique<placing::FrameEvidence>();
  std::unique_ptr<placing::SliceCells> cells_ = std::make_unique<placing::SliceCells>();
  std::unique_ptr<Arrivals> arrivals_ = std::make_unique<Arrivals>();
  tests::Slice hits_;
  pose::Pose middle_;
};

// Cells whose bits come in patches, so that squares of equal cells occur, and their borders.
GroundCell random_cell(tests::Random& random, Cell cell) {
  tests::Random patch(static_cast<std::uint64_t>(cell.x / 11 * 97 + cell.y / 13));
  const bool is_open_patch = patch.one_in(2);
  const bool is_calm = !patch.one_in(3);
  GroundCell is;
  is.freed = is_open_patch ? !random.one_in(4) : random.one_in(9);
  is.seen = is.freed && (is_calm || !random.one_in(6));
  is.stands = random.one_in(is_calm ? 400 : 30);
  is.taken = random.one_in(is_calm ? 300 : 20);
  is.open = is_open_patch || random.one_in(5);
  is.dense = is_open_patch && patch.one_in(5);
  is.ticks = random.between(0, 3);
  is.is_hit = random.one_in(is_calm ? 9 : 4);
  return is;
}

struct Patch {
  Cell low;  // in cells of the window
  std::int32_t side;
  int cell_mm = 100;
  tests::Looks looks{};  // that the rules have in such cells
};

// The window's lowest corner is at some tile, so that slots of neighbours are far apart; patches
// lie over borders of tiles, over the seam of the slots, and in all four corners of the window.
class GroundNear : public GroundOf, public testing::WithParamInterface<Patch> {};

TEST_P(GroundNear, IsAskedAndRememberedAsTheRuleSays) {
  const Cell low = GetParam().low;
  const std::int32_t side = GetParam().side;
  const Around around = around_with(GetParam().cell_mm);
  arrivals_ = std::make_unique<Arrivals>(Rules{.around = around});
  for (int round = 0; round < tests::effort(4, 1); ++round) {
    window_->forget();
    hits_ = {};
    follow({-4000 * (round + 1), 977 * (round + 3)});
    tests::Random random(static_cast<std::uint64_t>(round) + 31);
    tests::FlatGround flat(side, side, GetParam().looks);
    const auto in_window = [&](Cell cell) { return Cell{low.x + cell.x, low.y + cell.y}; };
    const auto for_each_cell = [&](auto&& visit) {
      for (std::int32_t i = 0; i < side * side; ++i) {
        visit(Cell{i % side, i / side});
      }
    };
    for_each_cell([&](Cell cell) {
      const GroundCell is = random_cell(random, cell);
      flat.at(cell) = is;
      write(in_window(cell), is);
    });
    find_moved();
    int moved = 0;
    for_each_cell([&](Cell cell) {
      ASSERT_EQ(has_moved(in_window(cell)), flat.has_moved(cell)) << cell.x << " " << cell.y;
      moved += flat.has_moved(cell) ? 1 : 0;
    });
    EXPECT_GT(moved, 20);
    for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
      if (window_->is_known(slot)) {
        remember(*window_, slot, round % 2 == 0, around);
      }
    }
    flat.find_shut();
    int opened = 0;
    for_each_cell([&](Cell cell) {
      GroundCell expected = flat.remembered(cell, round % 2 == 0);
      opened += expected.open && !flat.at(cell).open ? 1 : 0;
      expected.is_hit = false;
      ASSERT_EQ(read(in_window(cell)), expected) << cell.x << " " << cell.y;
    });
    EXPECT_GT(opened, 5);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Places, GroundNear,
    testing::Values(Patch{{480, 480}, 80}, Patch{{0, 0}, 70}, Patch{{954, 954}, 70},
                    Patch{{0, 954}, 70}, Patch{{954, 0}, 70}, Patch{{150, 600}, 72},
                    Patch{{480, 512}, 112, 200, {1, 1, 2}}, Patch{{490, 470}, 80, 500, {1, 1, 1}}),
    [](const auto& patch) {
      return "Cell" + std::to_string(patch.param.low.x) + "And" + std::to_string(patch.param.low.y);
    });

// A square of open ground, freed and seen; in it a letter is what the case says.
class OpenGround : public GroundOf {
 protected:
  static constexpr Cell kLow{500, 500};

  void draw(const std::vector<std::string>& picture, int ticks) {
    window_->forget();
    hits_ = {};
    follow({0, 0});
    for (std::size_t row = 0; row < picture.size(); ++row) {
      for (std::size_t column = 0; column < picture[row].size(); ++column) {
        const char what = picture[row][column];
        write(cell_at(picture, row, column), {.freed = what != 's',
                                              .stands = what == 's',
                                              .open = true,
                                              .ticks = ticks,
                                              .is_hit = what == '#'});
      }
    }
  }

  // The picture with 'M' where a hit has moved.
  std::vector<std::string> moved(const std::vector<std::string>& picture, int ticks) {
    draw(picture, ticks);
    find_moved();
    std::vector<std::string> result = picture;
    for (std::size_t row = 0; row < picture.size(); ++row) {
      for (std::size_t column = 0; column < picture[row].size(); ++column) {
        if (has_moved(cell_at(picture, row, column))) {
          result[row][column] = 'M';
        }
      }
    }
    return result;
  }

 private:
  static Cell cell_at(const std::vector<std::string>& picture, std::size_t row,
                      std::size_t column) {
    return {kLow.x + static_cast<std::int32_t>(column),
            kLow.y + static_cast<std::int32_t>(picture.size() - 1 - row)};
  }
};

using Picture = std::vector<std::string>;

TEST_F(OpenGround, OneHitIsNoArrival) {
  const Picture one{".......", "...#...", "......."};
  EXPECT_EQ(moved(one, 3), one);
}

TEST_F(OpenGround, TwoHitsAreOneWhereTheGroundIsWellKnown) {
  const Picture two{"..#....", ".......", ".....#."};
  EXPECT_EQ(moved(two, 3), (Picture{"..M....", ".......", ".....M."}));
  EXPECT_EQ(moved(two, 2), two);
}

TEST_F(OpenGround, SevenHitsAreOneWhereItIsNot) {
  EXPECT_EQ(moved({"..##...", "..##...", "..###.."}, 0),
            (Picture{"..MM...", "..MM...", "..MMM.."}));
  const Picture six{"..##...", "..##...", "...##.."};
  EXPECT_EQ(moved(six, 0), six);
}

// The seven must lie in the square of seven around each.
TEST_F(OpenGround, HitsFurtherThanThreeCellsDoNotCount) {
  EXPECT_EQ(moved({"........", "#...#..#", "........"}, 3),
            (Picture{"........", "#...M..M", "........"}));
}

// What is beside is not new either: in the second picture each hit has one new one left, itself.
TEST_F(OpenGround, NothingMovesBesideWhatStands) {
  EXPECT_EQ(moved({".......", ".##s##.", "......."}, 3),
            (Picture{".......", ".##s##.", "......."}));
  EXPECT_EQ(moved({".......", "###s##.", "......."}, 3),
            (Picture{".......", "MM#s##.", "......."}));
}

}  // namespace
}  // namespace iog::perception
