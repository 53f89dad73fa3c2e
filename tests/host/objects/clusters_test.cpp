// Clusters beside components that are found pair by pair.
#include "objects/clusters.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <memory>
#include <vector>

#include "fakes/random.hpp"

namespace iog::objects {
namespace {

constexpr std::array<std::uint8_t, 2> kAges{8, 0};
constexpr window::Area kArea = window::Area::around({0, 0});

class ClustersOf : public testing::Test {
 protected:
  // Hits at cells, of which every seventh was taken and every eleventh is old.
  void gather(const std::vector<geometry::Cell>& cells) {
    std::vector<Hit> all;
    all.reserve(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      all.push_back({.cell = cells[i], .slice = static_cast<std::uint8_t>(i % 2)});
    }
    hits->gather({.end_us = 1, .car = {}, .area = kArea, .ages_ms = kAges, .hits = all});
    std::size_t number = 0;
    for (FrameHit& hit : hits->all()) {
      hit.owner = ++number % 7 == 0 ? std::int16_t{3} : kNobody;
      hit.is_old = number % 11 == 0;
    }
  }

  std::unique_ptr<FrameHits> hits = std::make_unique<FrameHits>();
  std::unique_ptr<Clusters> clusters = std::make_unique<Clusters>();
};

// From each hit in turn to all that are within 400 mm of it, and 14 mm more for each whole metre of
// its range, along both axes.
std::vector<int> components_of(std::span<const FrameHit> hits) {
  const auto gap = [](const FrameHit& hit) {
    const double longer = std::max(std::abs(hit.at().x_mm), std::abs(hit.at().y_mm));
    const double shorter = std::min(std::abs(hit.at().x_mm), std::abs(hit.at().y_mm));
    return 400 + 14 * std::floor((longer + shorter * 3 / 8) / 1000);
  };
  const auto is_fresh = [](const FrameHit& hit) { return hit.owner == kNobody && !hit.is_old; };
  std::vector<int> of(hits.size(), -1);
  for (std::size_t seed = 0; seed < hits.size(); ++seed) {
    std::vector<std::size_t> found;
    const auto take = [&](std::size_t i) {
      if (of[i] < 0 && is_fresh(hits[i])) {
        of[i] = static_cast<int>(seed);
        found.push_back(i);
      }
    };
    take(seed);
    for (std::size_t next = 0; next < found.size(); ++next) {
      const FrameHit& hit = hits[found[next]];
      for (std::size_t i = 0; i < hits.size(); ++i) {
        const std::int32_t off = std::max(std::abs(hits[i].at().x_mm - hit.at().x_mm),
                                          std::abs(hits[i].at().y_mm - hit.at().y_mm));
        if (off <= gap(hit)) {
          take(i);
        }
      }
    }
  }
  return of;
}

TEST_F(ClustersOf, HitsAreComponents) {
  iog::tests::Random random(1);
  for (int i = 0; i < 30; ++i) {
    std::vector<geometry::Cell> cells;
    cells.reserve(60);
    const geometry::Cell middle{random.between(-400, 400), random.between(-400, 400)};
    const std::int32_t reach = i % 3 == 0 ? 3 : 40;  // some have several hits in a cell
    for (int n = 0; n < 60; ++n) {
      cells.push_back(
          {middle.x + random.between(-reach, reach), middle.y + random.between(-reach, reach)});
    }
    gather(cells);
    EXPECT_EQ(clusters->find(kArea, {}, *hits), 0U);
    const std::vector<int> expected = components_of(hits->all());
    std::map<std::int16_t, int> component_of;
    std::size_t fresh = 0;
    for (std::size_t n = 0; n < hits->all().size(); ++n) {
      const FrameHit& hit = hits->all()[n];
      if (hit.owner != kNobody || hit.is_old) {
        ASSERT_EQ(hit.cluster, kNobody);
        continue;
      }
      ++fresh;
      ASSERT_NE(hit.cluster, kNobody);
      const auto [known, is_new] = component_of.try_emplace(hit.cluster, expected[n]);
      ASSERT_EQ(known->second, expected[n]) << i;
    }
    std::size_t counted = 0;
    for (std::size_t number = 0; number < clusters->all().size(); ++number) {
      const Cluster& cluster = clusters->all()[number];
      counted += cluster.hits;
      ASSERT_EQ(clusters->hits_of(number).size(), cluster.hits);
      for (const std::uint16_t of : clusters->hits_of(number)) {
        const Point at = hits->all()[of].at();
        ASSERT_LE(cluster.bounds.low.x_mm, at.x_mm);
        ASSERT_GE(cluster.bounds.high.y_mm, at.y_mm);
      }
    }
    EXPECT_EQ(counted, fresh);
  }
}

// More than there is room for: the nearest are found, the others counted, and nothing of it is left
// for the next frame.
TEST_F(ClustersOf, HaveABound) {
  std::vector<geometry::Cell> cells;
  for (std::int32_t y = -200; y < 200; y += 20) {
    for (std::int32_t x = -200; x < 200; x += 20) {
      cells.push_back({x, y});
    }
  }
  gather(cells);
  for (FrameHit& hit : hits->all()) {
    hit.owner = kNobody;
    hit.is_old = false;
  }
  EXPECT_EQ(clusters->find(kArea, {}, *hits), 400U - kMostClusters);
  EXPECT_EQ(clusters->all().size(), kMostClusters);
  gather({{0, 0}});
  EXPECT_EQ(clusters->find(kArea, {}, *hits), 0U);
  EXPECT_EQ(clusters->all().size(), 1U);
  EXPECT_EQ(clusters->all()[0].hits, 1U);
  // Beside the farthest, which had no room.
  for (const geometry::Cell far : cells) {
    if (far.x == -200 || far.y == -200) {
      gather({{far.x + 1, far.y + 1}});
      EXPECT_EQ(clusters->find(kArea, {}, *hits), 0U);
      ASSERT_EQ(clusters->all().size(), 1U);
      EXPECT_EQ(clusters->all()[0].bounds.low, clusters->all()[0].bounds.high);
    }
  }
}

}  // namespace
}  // namespace iog::objects
