// How the objects of a frame come to a page.
#include <cstdint>
#include <memory>
#include <vector>

#include "gtest/gtest.h"

#include "page_reader.hpp"
#include "tools/simulate/random.hpp"

namespace iog::tools::view {
namespace {

class ObjectSceneTest : public testing::Test {
 protected:
  // Any numbers: a page is told what came.
  stream::ObjectRecord random_object(std::uint32_t id) {
    const auto u16 = [&] { return static_cast<std::uint16_t>(random_.below(65536)); };
    const auto mm = [&] { return static_cast<std::int32_t>(random_.below(2'000'000)) - 1'000'000; };
    return {.id = id,
            .state = static_cast<stream::ObjectState>(1 + random_.below(4)),
            .existence = static_cast<std::uint8_t>(random_.below(256)),
            .age_frames = u16(),
            .x_mm = mm(),
            .y_mm = mm(),
            .length_cm = u16(),
            .width_cm = u16(),
            .heading = u16(),
            .flags = u16(),
            .vx_cm_s = static_cast<std::int16_t>(u16()),
            .vy_cm_s = static_cast<std::int16_t>(u16()),
            .sigma_v_along_cm_s = u16(),
            .sigma_v_across_cm_s = u16(),
            .since_hit_ms = u16(),
            .since_stopped_10ms = u16()};
  }

  stream::ObjectList random_list(std::uint16_t count) {
    stream::ObjectList list{.time_us = 5, .count = count};
    for (std::uint32_t i = 0; i < count; ++i) {
      list.records.at(i) = random_object(i + 1);
    }
    return list;
  }

  void publish(const stream::ObjectList* objects) {
    scene_->publish_frame(*grid_, *classes_, {.points = points_, .truth = nullptr}, "{}", objects);
    page_.catch_up(*scene_);
  }

  Random random_{11};
  std::vector<SeenPoint> points_;
  std::unique_ptr<LiveGrid> grid_ = std::make_unique<LiveGrid>();
  std::unique_ptr<LiveClasses> classes_ = std::make_unique<LiveClasses>();
  std::unique_ptr<Scene> scene_ = std::make_unique<Scene>();
  PageReader page_;
};

TEST_F(ObjectSceneTest, APageIsToldAllOfThemWhateverIsAround) {
  for (const std::uint16_t count :
       {std::uint16_t{1}, std::uint16_t{2}, std::uint16_t{33}, std::uint16_t{256}}) {
    points_.push_back({.x_cm = 7, .y_cm = -7, .z_cm = 0, .fate = vehicle::Fate::kUsed});
    const stream::ObjectList list = random_list(count);
    publish(&list);
    ASSERT_TRUE(page_.has_objects);
    EXPECT_EQ(page_.points, points_.size());
    EXPECT_EQ(page_.objects, std::vector(list.all().begin(), list.all().end()));
  }
}

// That there are none is something else than that nobody knows.
TEST_F(ObjectSceneTest, AnEmptyListIsKnownAndOneThatDidNotComeIsNot) {
  const stream::ObjectList list = random_list(3);
  publish(&list);
  const stream::ObjectList none = random_list(0);
  publish(&none);
  EXPECT_TRUE(page_.has_objects);
  EXPECT_TRUE(page_.objects.empty());
  publish(nullptr);
  EXPECT_TRUE(page_.has_frame);
  EXPECT_FALSE(page_.has_objects);
}

TEST_F(ObjectSceneTest, WordsAloneBringNoObjects) {
  const stream::ObjectList list = random_list(3);
  publish(&list);
  scene_->publish_status("{}");
  page_.catch_up(*scene_);
  EXPECT_FALSE(page_.has_frame);
  EXPECT_EQ(page_.objects.size(), 3U) << "those of the frame before";
}

}  // namespace
}  // namespace iog::tools::view
