// Which clusters become parts of tracks, as docs/objects.md has it.
#include "objects/adopt.hpp"

#include <array>
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

#include "geometry/sizes.hpp"

namespace iog::objects {
namespace {

constexpr window::Area kAroundCar = window::Area::around({0, 0});
constexpr std::array<std::uint8_t, 1> kNoAge{0};
constexpr std::int32_t kBehindMm = 10'000;  // the near end of tracks

class Attach : public testing::Test {
 protected:
  // The slot of a track along x that gets a cluster of cells one beside the other, to where its
  // farthest is beyond the track's near end, and beside its right side; kNobody: none gets it.
  std::int16_t owner_of_cluster(const Track& track, std::int32_t beyond_mm, std::int32_t beside_mm,
                                std::int32_t length_mm = 200) {
    const geometry::Cell far{(kBehindMm + beyond_mm) / geometry::kCellMm,
                             beside_mm / geometry::kCellMm};
    std::vector<Hit> seen;
    for (std::int32_t x = far.x - length_mm / geometry::kCellMm + 1; x <= far.x; ++x) {
      seen.push_back({.cell = {x, far.y}});
    }
    hits->gather({.end_us = 1, .car = {}, .area = kAroundCar, .ages_ms = kNoAge, .hits = seen});
    EXPECT_EQ(clusters->find(kAroundCar, {}, *hits), 0U);
    std::array tracks{track};
    attach({}, tracks, *clusters, hits->all());
    return hits->all()[0].owner;
  }
  // From 10 m on, 1 m wide.
  static Track track_of(std::int32_t length_mm) {
    Track track;
    track.begin(1, {.at = {kBehindMm, 0}, .sides = {Interval{0, length_mm}, Interval{0, 1000}}},
                1'000'000);
    track.updates = 3;
    return track;
  }

  std::unique_ptr<FrameHits> hits = std::make_unique<FrameHits>();
  std::unique_ptr<Clusters> clusters = std::make_unique<Clusters>();
};

// "Both together are at most 18 m by 3.4 m." Cells are 0.1 m, and count by their centres.
TEST_F(Attach, AThingWithItsNewPartIsAtMostEighteenMetresLong) {
  ASSERT_EQ(geometry::kCellMm, 100);
  EXPECT_EQ(owner_of_cluster(track_of(17'600), 17'900, 500), 0);
  EXPECT_EQ(owner_of_cluster(track_of(17'600), 18'000, 500), kNobody);
}

TEST_F(Attach, AThingWithItsNewPartIsAtMostThreePointFourMetresWide) {
  Track wide = track_of(4'000);
  wide.sides()[kAcross].high = 3'000;
  EXPECT_EQ(owner_of_cluster(wide, 2'000, 3'300), 0);
  EXPECT_EQ(owner_of_cluster(wide, 2'000, 3'400), kNobody);
  // Without a heading the shorter side is its width.
  Track across = track_of(3'000);
  across.sides()[kAcross].high = 8'000;
  EXPECT_EQ(owner_of_cluster(across, 3'300, 4'000), 0);
  EXPECT_EQ(owner_of_cluster(across, 3'400, 4'000), kNobody);
  across.begin_heading(across.box().sides);
  EXPECT_EQ(owner_of_cluster(across, 3'300, 4'000), kNobody);
}

// "Grow by at most 4 m along and 2 m across", which a box with a heading knows from one another. A
// cell's centre is 50 mm farther than the cell.
TEST_F(Attach, AThingGrowsByAtMostFourMetresAlongAndTwoAcross) {
  const auto with_heading = [](std::int32_t length_mm) {
    Track track = track_of(length_mm);
    track.updates = 50;  // it may take clusters of many hits
    track.begin_heading(track.box().sides);
    return track;
  };
  EXPECT_EQ(owner_of_cluster(with_heading(4'050), 8'000, 500, 4'000), 0);
  EXPECT_EQ(owner_of_cluster(with_heading(4'049), 8'000, 500, 4'000), kNobody);
  Track narrow = with_heading(4'000);
  const auto widened = [&](std::int32_t width_mm) {
    narrow.sides()[kAcross].high = width_mm;
    const std::int16_t near = owner_of_cluster(narrow, 2'000, width_mm + 600);
    EXPECT_EQ(near, 0);
    // A column from beside the box to 2 m away.
    std::vector<Hit> seen;
    for (std::int32_t y = 11; y <= 30; ++y) {
      seen.push_back({.cell = {120, y}});
    }
    hits->gather({.end_us = 1, .car = {}, .area = kAroundCar, .ages_ms = kNoAge, .hits = seen});
    EXPECT_EQ(clusters->find(kAroundCar, {}, *hits), 0U);
    std::array tracks{narrow};
    attach({}, tracks, *clusters, hits->all());
    return hits->all()[0].owner;
  };
  EXPECT_EQ(widened(1'050), 0);
  EXPECT_EQ(widened(1'049), kNobody);
}

// "A box of 3 updates": a younger one associates.
TEST_F(Attach, ATrackOfTwoUpdatesDoesNotGrow) {
  Track track = track_of(4'000);
  EXPECT_EQ(owner_of_cluster(track, 4'200, 500), 0);
  track.updates = 2;
  EXPECT_EQ(owner_of_cluster(track, 4'200, 500), kNobody);
}

}  // namespace
}  // namespace iog::objects
