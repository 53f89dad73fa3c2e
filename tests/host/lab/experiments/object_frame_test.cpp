// What counts in a frame, of a drive of the city: by the hits that are found by fusing the slices
// again, and what is told is where it is and as fast as it is.
#include "lab/experiments/objects/object_frame.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <tuple>
#include <vector>

namespace iog::lab {
namespace {

constexpr std::array kWithAndWithout{PerceptionRule{"default"},
                                     PerceptionRule{.name = "grid alone", .has_objects = false}};
constexpr PerceivedDrive kCityDrive{.scene = "city", .seed = 5, .seconds = 3, .shown_every = 100};

// The target steps from the corner of a tile to its cells. So of a thousand hits one may lie in the
// cell beside that of its exact place, and where two come to lie in one they are one.
constexpr int kMostOthers = 5;

template <typename Use>
void look_at_city(const Use& use) {
  LocalToWorld to_world;
  perceive_drive(kCityDrive, kWithAndWithout, [&](const PerceivedFrame& frame) {
    const FrameTruth truth(frame, to_world);
    to_world = truth.last().to_world;
    use(frame, truth, object_frame(frame, truth, *frame.objects.front()));
  });
}

TEST(ObjectFrame, CountsTheMoversThatAreHitTwiceWithin40Metres) {
  std::size_t movers = 0;
  look_at_city([&](const PerceivedFrame& frame, const FrameTruth& truth, const ObjectFrame& made) {
    std::set<std::tuple<std::uint8_t, std::int32_t, std::int32_t>> once;  // cells of slices
    std::map<std::uint32_t, int> hits;
    for (const HitCell& hit : frame.hits) {
      const TrueThing on = truth.near(hit);
      const bool is_new = once.emplace(hit.slice, hit.cell.x, hit.cell.y).second;
      hits[on.thing] += is_new && moves(on.state) ? 1 : 0;
    }
    EXPECT_NEAR(static_cast<double>(frame.objects.front()->hits().size()),
                static_cast<double>(once.size()), kMostOthers);
    std::set<std::uint32_t> surely;
    std::set<std::uint32_t> perhaps;
    for (const auto& [thing, motion] : truth.last().things.motions()) {
      const LocalToWorld::Point& car = truth.last().to_world.car();
      const bool is_near = distance({motion.x_m, motion.y_m}, {car.x_m, car.y_m}) <= 40;
      const bool is_fast = distance({motion.x_mps, motion.y_mps}, {}) >= 0.3;
      if (is_near && is_fast && hits[thing] >= 2 + kMostOthers) {
        surely.insert(thing);
      }
      if (is_near && is_fast && hits[thing] > 0) {
        perhaps.insert(thing);
      }
    }
    std::set<std::uint32_t> found;
    for (const Mover& mover : made.movers) {
      found.insert(mover.thing);
    }
    EXPECT_EQ(found.size(), made.movers.size());
    EXPECT_TRUE(std::ranges::includes(found, surely)) << frame.number;
    EXPECT_TRUE(std::ranges::includes(perhaps, found)) << frame.number;
    movers += surely.size();
  });
  EXPECT_GT(movers, 200U);
}

TEST(ObjectFrame, WhatIsToldIsThereAndAsFast) {
  std::vector<double> places;
  std::vector<double> errors;
  look_at_city([&](const PerceivedFrame&, const FrameTruth&, const ObjectFrame& made) {
    for (const Mover& mover : made.movers) {
      if (mover.told_by) {
        ASSERT_LT(*mover.told_by, made.reported.size());
        const Reported& by = made.reported[*mover.told_by];
        places.push_back(distance(by.at, mover.at));
        errors.push_back(distance(by.velocity, mover.velocity));
      }
    }
  });
  ASSERT_GT(errors.size(), 100U);
  // A box shows a part of a car of 4.5 m or of a walker of 0.5 m; the car itself drives with 10
  // m/s.
  const auto middle = static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::ranges::nth_element(places, places.begin() + middle);
  std::ranges::nth_element(errors, errors.begin() + middle);
  EXPECT_LT(places[static_cast<std::size_t>(middle)], 1.5);
  EXPECT_LT(errors[static_cast<std::size_t>(middle)], 1.0);
}

TEST(ObjectFrame, ACarWithoutObjectsReportsNone) {
  look_at_city([](const PerceivedFrame& frame, const FrameTruth& truth, const ObjectFrame&) {
    const ObjectFrame made = object_frame(frame, truth, *frame.objects.back());
    EXPECT_TRUE(made.movers.empty());
    EXPECT_TRUE(made.reported.empty());
  });
}

}  // namespace
}  // namespace iog::lab
