// How the classes of the window come to a page.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>

#include "gtest/gtest.h"

#include "page_reader.hpp"
#include "tools/simulate/random.hpp"

namespace iog::tools::view {
namespace {

constexpr std::int32_t kTileSide = geometry::kTileSide;

class ClassSceneTest : public testing::Test {
 protected:
  // A frame in which some tiles have changed, and some have not arrived. The window moves.
  GridFrame random_frame() {
    GridFrame frame;
    frame.header.frame_number = ++number_;
    ClassGrid& classes = frame.classes.emplace();
    classes.window.corner_a = -20 + static_cast<std::int32_t>(number_ / 5);
    classes.window.corner_b = 7 - static_cast<std::int32_t>(number_ / 7);
    for (std::size_t slot = 0; slot < geometry::kTileCount; ++slot) {
      classes.valid_tiles.set(slot, random_.below(10) != 0);
      classes.age_frames.at(slot) = static_cast<std::uint8_t>(random_.below(8));
      if (random_.below(20) == 0) {
        const auto byte = static_cast<std::int8_t>(8 + random_.below(64));
        for (std::size_t i = 0; i < geometry::kTileCells; i += 1 + random_.below(40)) {
          classes.cells.at(cell_of_tile(tile_in_window(classes.window, slot), i)) = byte;
        }
      }
    }
    return frame;
  }

  void publish(const GridFrame& frame, std::shared_ptr<const Truth> truth = nullptr) {
    grid_->take(frame);
    classes_->take(frame);
    scene_->publish_frame(*grid_, *classes_, {.points = {}, .truth = std::move(truth)}, "{}");
  }

  [[nodiscard]] bool shows_the_classes(const PageReader& page) const {
    for (std::size_t slot = 0; slot < geometry::kTileCount; ++slot) {
      for (std::size_t i = 0; i < geometry::kTileCells; ++i) {
        if (page.classes.at(cell_of_tile(slot, i)) != classes_->tile(slot).at(i)) {
          return false;
        }
      }
    }
    return page.has_classes && !page.malformed;
  }

  Random random_{3};
  std::uint32_t number_ = 0;
  std::unique_ptr<LiveGrid> grid_ = std::make_unique<LiveGrid>();
  std::unique_ptr<LiveClasses> classes_ = std::make_unique<LiveClasses>();
  std::unique_ptr<Scene> scene_ = std::make_unique<Scene>();
};

TEST_F(ClassSceneTest, APageThatReadsAllAndOneThatMissesMostEndWithTheSameClasses) {
  PageReader eager;
  PageReader slow;
  for (int frame = 0; frame < 60; ++frame) {
    publish(random_frame());
    eager.catch_up(*scene_);
    EXPECT_TRUE(shows_the_classes(eager));
    if (random_.below(5) == 0) {
      slow.catch_up(*scene_);
      EXPECT_TRUE(shows_the_classes(slow));
    }
  }
}

// 255 stands for what never came, and for what left the window.
TEST_F(ClassSceneTest, AgesAreThoseOfTheLiveClasses) {
  PageReader page;
  for (int frame = 0; frame < 12; ++frame) {
    publish(random_frame());
  }
  page.catch_up(*scene_);
  for (std::size_t slot = 0; slot < geometry::kTileCount; ++slot) {
    EXPECT_EQ(page.class_ages.at(slot), classes_->age_of(slot).value_or(255));
    EXPECT_EQ(page.decided_ago.at(slot), classes_->decided_ago(slot).value_or(255));
  }
}

// One of the frames without classes is a key, in which a page forgets them.
TEST_F(ClassSceneTest, ClassesThatPauseComeBackWhole) {
  PageReader page;
  const GridFrame frame = random_frame();
  publish(frame);
  page.catch_up(*scene_);
  GridFrame without;
  for (int i = 0; i < 30; ++i) {
    without.header.frame_number = ++number_;
    publish(without);
    page.catch_up(*scene_);
    EXPECT_FALSE(page.has_classes);
  }
  GridFrame again = frame;
  again.header.frame_number = ++number_;
  publish(again);
  page.catch_up(*scene_);
  EXPECT_TRUE(shows_the_classes(page));
}

// The truth is of any square of the world; what of the window lies beyond it is free.
TEST_F(ClassSceneTest, TheTruthOfACellIsThatOfItsPlaceInTheWorld) {
  GridFrame frame = random_frame();
  const stream::ClassWindow& window = frame.classes->window;
  auto truth = std::make_shared<Truth>();
  truth->occupied.resize(geometry::kCellCount);
  truth->area = {.x = window.corner_a * kTileSide + 100,
                 .y = window.corner_b * kTileSide - 50,
                 .width = 300,
                 .height = 200};
  for (std::size_t i = 0; i < std::size_t{300} * 200; ++i) {
    truth->classes.push_back(static_cast<TrueClass>(random_.below(4)));
  }
  publish(frame, truth);
  PageReader page;
  page.catch_up(*scene_);
  ASSERT_TRUE(page.has_true_classes);
  for (int x = 0; x < 1024; ++x) {
    for (int y = 0; y < 1024; ++y) {
      const bool is_inside = x >= 100 && x < 400 && y < 150;
      const auto expected =
          is_inside ? truth->classes.at(static_cast<std::size_t>((y + 50) * 300 + x - 100))
                    : TrueClass::kFree;
      const auto slot =
          window::slot_of({window.corner_a + x / kTileSide, window.corner_b + y / kTileSide});
      const auto i = static_cast<std::size_t>(y % kTileSide) * kTileSide +
                     static_cast<std::size_t>(x % kTileSide);
      ASSERT_EQ(page.true_classes.at(cell_of_tile(slot, i)), static_cast<int>(expected))
          << x << ", " << y;
    }
  }
}

TEST_F(ClassSceneTest, WithoutClassesTheMessageHasNone) {
  PageReader page;
  publish(GridFrame());
  page.catch_up(*scene_);
  EXPECT_TRUE(page.has_frame);
  EXPECT_FALSE(page.has_classes || page.has_true_classes);
}

}  // namespace
}  // namespace iog::tools::view
