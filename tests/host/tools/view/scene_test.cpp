#include "tools/view/scene.hpp"

#include "gtest/gtest.h"

#include "page_reader.hpp"
#include "tools/simulate/random.hpp"

namespace iog::tools::view {
namespace {

// A frame in which a few random tiles are random, and only some have arrived.
GridFrame random_frame(Random& random, std::uint32_t number) {
  GridFrame frame;
  frame.header.frame_number = number;
  for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
    frame.valid_tiles.set(tile, random.below(10) != 0);
    if (random.below(20) == 0) {
      const auto value = static_cast<std::int8_t>(static_cast<int>(random.below(255)) - 127);
      for (std::size_t i = 0; i < tile_coding::kTileBytes; i += 1 + random.below(40)) {
        frame.cells.at(cell_of_tile(tile, i)) = value;
      }
    }
  }
  return frame;
}

class SceneTest : public testing::Test {
 protected:
  void next_frame() {
    grid_->take(random_frame(random_, ++number_));
    scene_->publish_frame(*grid_, *classes_, {}, "{}");
  }

  bool shows_the_grid(const PageReader& page) {
    return !page.malformed && std::ranges::equal(page.cells, grid_->cells());
  }

  Random random_{7};
  std::uint32_t number_ = 0;
  std::unique_ptr<LiveGrid> grid_ = std::make_unique<LiveGrid>();
  std::unique_ptr<LiveClasses> classes_ = std::make_unique<LiveClasses>();
  std::unique_ptr<Scene> scene_ = std::make_unique<Scene>();
};

TEST_F(SceneTest, APageThatReadsAllAndOneThatMissesMostEndWithTheSameGrid) {
  PageReader eager;
  PageReader slow;
  for (int frame = 0; frame < 60; ++frame) {
    next_frame();
    eager.catch_up(*scene_);
    EXPECT_TRUE(shows_the_grid(eager));
    if (random_.below(5) == 0) {
      slow.catch_up(*scene_);
      EXPECT_TRUE(shows_the_grid(slow));
    }
  }
}

TEST_F(SceneTest, TilesHaveTheirNumbersInALongGrid) {
  GridFrame frame;
  frame.shape = {.columns = 2048, .rows = 512, .origin_column = 48, .origin_row = 256};
  frame.valid_tiles.set();
  frame.cells.at(300 * 2048 + 2000) = 5;
  grid_->take(frame);
  scene_->publish_frame(*grid_, *classes_, {}, "{}");
  PageReader page;
  page.catch_up(*scene_);
  EXPECT_EQ(page.tile_records, 1U);
  EXPECT_EQ(page.cells.at(cell_of_tile(300 / 32 * 64 + 2000 / 32, 300 % 32 * 32 + 2000 % 32)), 5);
}

TEST_F(SceneTest, WithoutNewsThereIsNoMessage) {
  PageReader page;
  EXPECT_FALSE(page.catch_up(*scene_));
  next_frame();
  EXPECT_TRUE(page.catch_up(*scene_));
  EXPECT_FALSE(page.catch_up(*scene_));
}

TEST_F(SceneTest, WordsAloneBringNeitherFrameNorTiles) {
  PageReader page;
  next_frame();
  page.catch_up(*scene_);
  scene_->publish_status(R"({"state":"stale"})");
  ASSERT_TRUE(page.catch_up(*scene_));
  EXPECT_FALSE(page.has_frame);
  EXPECT_EQ(page.tile_records, 0U);
  EXPECT_NE(page.words.find(R"("state":"stale")"), std::string::npos);
  EXPECT_TRUE(shows_the_grid(page));
}

TEST_F(SceneTest, TheFirstFrameThatAPageSeesIsWholeWhateverWordsCameBefore) {
  PageReader page;
  scene_->publish_status("{}");
  page.catch_up(*scene_);
  EXPECT_FALSE(page.has_frame);
  next_frame();
  page.catch_up(*scene_);
  EXPECT_TRUE(page.has_frame && page.is_key);
}

TEST_F(SceneTest, AFrameThatAPageHasNotSeenComesWithLaterWords) {
  PageReader page;
  next_frame();
  page.catch_up(*scene_);
  next_frame();
  scene_->publish_status("{}");
  page.catch_up(*scene_);
  EXPECT_TRUE(page.has_frame);
  EXPECT_TRUE(shows_the_grid(page));
}

TEST_F(SceneTest, OneMessageInTwentyFiveIsWholeAndNamesTheVehicle) {
  scene_->set_vehicle(R"({"name":"x"})");
  PageReader page;
  for (int frame = 0; frame < 100; ++frame) {
    next_frame();
    page.catch_up(*scene_);
    EXPECT_EQ(page.is_key, frame % 25 == 0);
    EXPECT_EQ(page.words.find("vehicle") != std::string::npos, page.is_key);
  }
}

TEST_F(SceneTest, AgesAreThoseOfTheLiveGrid) {
  PageReader page;
  for (int frame = 0; frame < 4; ++frame) {
    next_frame();
  }
  page.catch_up(*scene_);
  for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
    EXPECT_EQ(page.ages.at(tile), grid_->age_of(tile).value_or(255));
  }
}

TEST_F(SceneTest, WhatAGridForgetsDisappears) {
  PageReader page;
  next_frame();
  page.catch_up(*scene_);
  grid_->forget();
  grid_->take(GridFrame());
  scene_->publish_frame(*grid_, *classes_, {}, "{}");
  page.catch_up(*scene_);
  EXPECT_EQ(std::ranges::count(page.cells, 0), page.cells.size());
}

TEST_F(SceneTest, RequestsAreTakenOnceAndAFloodOfThemIsForgotten) {
  for (int i = 0; i < 1000; ++i) {
    scene_->ask("record");
  }
  scene_->ask("stop");
  const auto requests = scene_->take_requests();
  EXPECT_LE(requests.size(), 16U);
  EXPECT_EQ(requests.back(), "stop");
  EXPECT_TRUE(scene_->take_requests().empty());
}

}  // namespace
}  // namespace iog::tools::view
