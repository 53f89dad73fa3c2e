// What tracks say of names: it is said for a frame, and changes nothing else.
#include "perception/moving_names.hpp"

#include <gtest/gtest.h>
#include <memory>
#include <vector>

#include "fakes/random.hpp"
#include "perception/frames.hpp"
#include "perception/kept_versions.hpp"

namespace iog::perception {
namespace {

using decision::Class;

constexpr Cell kCarCell{geometry::kOriginCell, geometry::kOriginCell};

// A patch of free ground ahead of the car with some hits.
Slice patch(tests::Random& random) {
  Slice slice;
  for (std::int32_t y = 0; y < 40; ++y) {
    for (std::int32_t x = 0; x < 40; ++x) {
      slice.set({kCarCell.x + 20 + x, kCarCell.y + y}, random.one_in(20) ? 6 : -14);
    }
  }
  return slice;
}

// Eight things of 2 by 2 cells that go over it, five cells a frame.
Slice things(int frame) {
  Slice slice;
  for (std::int32_t y = 0; y < 40; ++y) {
    for (std::int32_t x = 0; x < 40; ++x) {
      const bool is_hit = y % 5 < 2 && (x + 5 * y + 35 * frame) % 40 < 2;
      slice.set({kCarCell.x + 20 + x, kCarCell.y + y}, is_hit ? 12 : -14);
    }
  }
  return slice;
}

class Window {
 public:
  Window() { fusion_->follow(at_cell({0, 0}).pose); }

  // name(fusion) speaks between what a frame decides and its end.
  template <typename Say>
  void frame(const Slice& slice, Say&& say) {
    add_slice(slice, at_cell({0, 0}), *fusion_);
    now_us_ += kFrameUs;
    fusion_->decide(now_us_, work::Crew());
    say(*fusion_);
    static_cast<void>(fusion_->end_frame(work::Crew()));
  }
  void frame(const Slice& slice) {
    frame(slice, [](WindowFusion& /*fusion*/) {});
  }

  void rule_out(std::size_t slot, const window::TileRuledOut& ruled_out) {
    fusion_->rule_out(slot, ruled_out);
  }

  [[nodiscard]] window::WindowView view() const { return fusion_->view(); }
  [[nodiscard]] Class at(Cell cell) const { return class_of(byte_at(cell)); }
  [[nodiscard]] std::int8_t byte_at(Cell cell) const { return fusion_->view().name_of(cell); }
  [[nodiscard]] std::vector<std::int8_t> all() const {
    std::vector<std::int8_t> bytes;
    for (std::int32_t y = 0; y < 64; ++y) {
      for (std::int32_t x = 0; x < 96; ++x) {
        bytes.push_back(byte_at({x, y}));
      }
    }
    return bytes;
  }

 private:
  std::unique_ptr<WindowFusion> fusion_ = std::make_unique<WindowFusion>(Rules(), true);
  std::uint64_t now_us_ = 0;
};

// Cells of a group by what is said of each.
template <typename IsHeld>
auto held_where(IsHeld is_held) {
  return [is_held](Cell first, std::uint32_t asked) {
    std::uint32_t held = 0;
    for (std::int32_t i = 0; i < 8; ++i) {
      held |= (is_held(Cell{first.x + i, first.y}) ? 1U : 0U) << i;
    }
    return held & asked;
  };
}

// Whatever was said in the frames before, names of a frame are those of the masses, which are those
// of a window to which nobody has spoken.
TEST(MovingNames, WhatIsSaidIsTakenBack) {
  tests::Random random(7);
  tests::Random said(8);
  Window spoken_to;
  Window silent;
  for (int frame = 0; frame < 30; ++frame) {
    const Slice slice = frame % 5 == 4 ? Slice() : patch(random);
    silent.frame(slice);
    std::vector<std::int8_t> before;
    spoken_to.frame(slice, [&](WindowFusion& fusion) {
      before = spoken_to.all();
      for (int i = 0; i < 200; ++i) {
        fusion.name_moving({said.between(-10, 80), said.between(-10, 60)},
                           static_cast<std::uint8_t>(said.between(0, 7)));
      }
      fusion.withdraw_moving(held_where([](Cell cell) { return cell.x % 3 == 0; }));
    });
    ASSERT_EQ(before, silent.all()) << frame;
  }
}

// What moves by the masses, whenever that was decided, and whatever a map has ruled out since.
TEST(MovingNames, AllThatMovesAndNobodyHitsOrHoldsIsWithdrawn) {
  tests::Random random(17);
  Window spoken_to;
  Window silent;
  int withdrawn = 0;
  KeptVersions versions;
  for (int frame = 0; frame < 40; ++frame) {
    const Slice slice = frame % 3 == 2 ? Slice() : things(frame);
    silent.frame(slice);
    spoken_to.frame(slice, [](WindowFusion& fusion) {
      fusion.withdraw_moving(held_where([](Cell cell) { return cell.x % 3 == 0; }));
    });
    for (std::int32_t y = 0; y < 64; ++y) {
      for (std::int32_t x = 0; x < 96; ++x) {
        const bool is_hit = slice.at({kCarCell.x + x, kCarCell.y + y}) > 0;
        const bool goes = silent.at({x, y}) == Class::kMoving && !is_hit && x % 3 != 0;
        ASSERT_EQ(spoken_to.byte_at({x, y}), goes ? 0 : silent.byte_at({x, y})) << x << ", " << y;
        withdrawn += goes ? 1 : 0;
      }
    }
    versions.look(spoken_to.view());
    if (frame % 5 == 2) {
      window::TileRuledOut ruled_out{};
      ruled_out[random.below(window::kGroupsPerTile)].fill(decision::kRoad +
                                                           decision::kIntermediate);
      for (const std::size_t slot : {0U, 1U, 32U, 33U}) {
        silent.rule_out(slot, ruled_out);
        spoken_to.rule_out(slot, ruled_out);
      }
      versions.look(spoken_to.view());
    }
  }
  EXPECT_GT(withdrawn, 100);
  EXPECT_GT(versions.stayed(), 0);
}

TEST(MovingNames, AHitIsMovingAndAtLeastSoSure) {
  tests::Random random(7);
  Window window;
  const Slice slice = patch(random);
  window.frame(slice, [](WindowFusion& fusion) {
    fusion.name_moving({25, 5}, 3);
    fusion.name_moving({25, 5}, 1);
    fusion.name_moving({26, 5}, 1);
    fusion.name_moving({26, 5}, 4);
    fusion.name_moving({500, 500}, 7);  // nothing is known there
    fusion.name_moving({5'000, 5}, 7);  // and here there is no window
  });
  EXPECT_EQ(window.byte_at({25, 5}), 8 * static_cast<int>(Class::kMoving) + 3);
  EXPECT_EQ(window.byte_at({26, 5}), 8 * static_cast<int>(Class::kMoving) + 4);
  EXPECT_EQ(window.byte_at({500, 500}), 0);
  EXPECT_EQ(window.byte_at({5'000, 5}), 0);
}

// Hit in this frame, held by a thing, or neither.
TEST(MovingNames, WhatNobodyHitsAndNothingHoldsIsNotMoving) {
  Window window;
  Slice slice;
  slice.draw(kCarCell, {"........"});
  slice.set({kCarCell.x + 3, kCarCell.y}, 6);
  window.frame(slice, [](WindowFusion& fusion) {
    for (std::int32_t x = 0; x < 8; ++x) {
      fusion.name_moving({x, 0}, 2);
    }
    fusion.withdraw_moving(held_where([](Cell cell) { return cell.x >= 6; }));
  });
  for (std::int32_t x = 0; x < 8; ++x) {
    EXPECT_EQ(window.at({x, 0}), x == 3 || x >= 6 ? Class::kMoving : Class::kUnknown) << x;
  }
}

}  // namespace
}  // namespace iog::perception
