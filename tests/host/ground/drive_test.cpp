// Turns of a simulated drive through the whole room, and through the second implementation beside
// it: the same tilts, heights, fates and surfaces. And what is seen of a made-up place is right.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <map>
#include <vector>

#include "fakes/random.hpp"
#include "fakes/reference_ground.hpp"
#include "fakes/reference_tilt.hpp"
#include "ground/bins.hpp"
#include "ground/judge.hpp"
#include "ground/lows.hpp"
#include "ground/surface.hpp"
#include "ground/surface_walk.hpp"
#include "ground/tilt.hpp"

namespace iog::ground {
namespace {

enum class Thing : std::uint8_t { kGround, kWall, kCar, kBridge };

struct Point {
  std::uint32_t packet = 0;
  std::uint32_t sector = 0;
  std::uint32_t along_mm = 0;
  std::int32_t z_mm = 0;
  bool is_sample = false;
  Thing thing = Thing::kGround;
};

// The lidar stands 1.8 m over a road that dips across itself, with a kerb of 12 cm and a ramp of 10
// % beyond 20 m; a wall on the left, a car ahead on the right, a bridge across everything.
double ground_at(double x, double y) {
  const double kerb = std::abs(y) > 6 ? 0.12 : 0;
  return 0.02 * y + kerb + 0.1 * std::max(0.0, x - 20);
}

bool is_in(Thing thing, double x, double y, double over) {
  switch (thing) {
    case Thing::kWall:
      return y > 11 && over < 2.1;
    case Thing::kCar:
      return x > 8 && x < 12 && y > -4 && y < -2 && over > 0.35 && over < 1.5;
    case Thing::kBridge:
      return x > 30 && x < 36 && over > 2.8 && over < 4;
    default:
      return over <= 0;
  }
}

// Where a beam ends, within a centimetre. Nothing is farther than 50 m.
bool cast(double azimuth, double elevation, double pitch, Point& point) {
  const double forward = std::cos(elevation) * std::cos(azimuth);
  const double left = std::cos(elevation) * std::sin(azimuth);
  const double up = std::sin(elevation) - forward * pitch;
  double step = 0.2;
  for (double range = 2; range < 50; range += step) {
    const double x = range * forward;
    const double y = range * left;
    const double over = 1.8 + range * up - ground_at(x, y);
    for (const Thing thing : {Thing::kWall, Thing::kCar, Thing::kBridge, Thing::kGround}) {
      if (!is_in(thing, x, y, over)) {
        continue;
      }
      if (step > 0.15) {
        range -= step;
        step = 0.01;
        break;
      }
      point.along_mm = static_cast<std::uint32_t>(range * std::cos(elevation) * 1000);
      point.z_mm = 1800 + static_cast<std::int32_t>(range * std::sin(elevation) * 1000);
      point.thing = thing;
      return true;
    }
  }
  return false;
}

// Thirty-two layers, 512 directions, eight of them a packet. pitch: of the car, nose down, as the
// tangent.
std::vector<Point> turn_of(double pitch) {
  std::vector<Point> points;
  for (std::uint32_t direction = 0; direction < 512; ++direction) {
    for (std::uint32_t layer = 0; layer < 32; ++layer) {
      Point point{.packet = direction / 8,
                  .sector = direction / 2,
                  .is_sample = direction % 3 == 1 && layer % 2 == 0 && layer < 22};
      const double azimuth = (direction + 0.5) * 2 * 3.14159265358979 / 512;
      const double elevation = (layer * 0.8 - 20) * 3.14159265358979 / 180;
      if (cast(azimuth, elevation, pitch, point)) {
        points.push_back(point);
      }
    }
  }
  return points;
}

constexpr Bins kBinsOf50m(50'000);
constexpr Limits kLimits{.low_mm = 220, .top_mm = 2'200};
constexpr std::int32_t kFewest = 12;

// Both implementations of a sensor's ground.
class Drive {
 public:
  // What each point is, by its place in the turn.
  std::vector<Kind> judge_turn(const std::vector<Point>& turn) {
    std::map<std::uint32_t, Samples> samples;
    std::map<std::uint32_t, std::vector<tests::ReferenceSample>> reference_samples;
    for (const Point& its : turn) {
      if (its.is_sample) {
        samples[its.packet].add(its.along_mm, over(its));
        reference_samples[its.packet].push_back(
            {its.along_mm, reference_.height_over(its.sector, its.along_mm, its.z_mm)});
      }
    }
    std::vector<Kind> kinds;
    for (const Point& its : turn) {
      const Tilt tilt = tilt_of(samples[its.packet].all(), kFewest);
      const tests::ReferenceTilt expected =
          tests::ReferenceLine().of(reference_samples[its.packet], kFewest);
      EXPECT_EQ(tilt.up_mm, expected.up_mm);
      EXPECT_EQ(tilt.slope, expected.slope);
      const std::int32_t height = over(its) - tilt.at(its.along_mm);
      EXPECT_EQ(height, reference_.height_over(its.sector, its.along_mm, its.z_mm) -
                            expected.at(its.along_mm));
      kinds.push_back(judge(kLimits, height));
    }
    return kinds;
  }

  void close_turn(const std::vector<Point>& turn) {
    Lows lows;
    for (const Point& its : turn) {
      lows.add(kBinsOf50m, its.sector, its.along_mm, its.z_mm);
      reference_.see(its.sector, its.along_mm, its.z_mm);
    }
    walk_.close_turn(kBinsOf50m, lows, surface_);
    reference_.close_turn();
    for (std::size_t sector = 0; sector < kSectors; ++sector) {
      EXPECT_TRUE(std::ranges::equal(surface_.row(sector),
                                     reference_.row(static_cast<tests::Whole>(sector))));
    }
  }

 private:
  [[nodiscard]] std::int32_t over(const Point& its) const {
    return surface_.height_over(kBinsOf50m, its.sector, its.along_mm, its.z_mm);
  }

  SurfaceWalk walk_;
  Surface surface_;
  tests::ReferenceGround reference_{1'024};
};

struct Shares {
  int count = 0;
  std::map<Kind, int> kinds;
  [[nodiscard]] double of(Kind kind) { return count == 0 ? 0 : 1.0 * kinds[kind] / count; }
};

std::map<Thing, Shares> shares_of(const std::vector<Point>& turn, const std::vector<Kind>& kinds) {
  std::map<Thing, Shares> shares;
  for (std::size_t i = 0; i < turn.size(); ++i) {
    Shares& its = shares[turn[i].thing];
    ++its.count;
    ++its.kinds[kinds[i]];
  }
  return shares;
}

// Level, then with the nose down by a degree, and level again; brakes and bumps do as much from
// turn to turn. What is missed of the ground is the ramp at 40 m, where rings are 10 m apart; of
// the wall it is its foot.
TEST(GroundOfADrive, IsThatOfTheSecondImplementationAndRight) {
  Drive drive;
  drive.close_turn(turn_of(0));
  for (const double pitch : {0.0, 0.0175, 0.0}) {
    const std::vector<Point> turn = turn_of(pitch);
    std::map<Thing, Shares> shares = shares_of(turn, drive.judge_turn(turn));
    EXPECT_GE(shares[Thing::kGround].of(Kind::kGround), 0.97) << pitch;
    EXPECT_GE(shares[Thing::kWall].of(Kind::kObstacle), 0.8) << pitch;
    EXPECT_GE(shares[Thing::kCar].of(Kind::kObstacle), 0.97) << pitch;
    EXPECT_GE(shares[Thing::kBridge].of(Kind::kOverhang), 0.999) << pitch;
    drive.close_turn(turn);
  }
}

// Before there is a surface the car's plane has to do: the ramp is an obstacle.
TEST(GroundOfADrive, IsFlatInTheFirstTurn) {
  Drive drive;
  const std::vector<Point> turn = turn_of(0);
  std::map<Thing, Shares> shares = shares_of(turn, drive.judge_turn(turn));
  EXPECT_GE(shares[Thing::kCar].of(Kind::kObstacle), 0.97);
  EXPECT_LE(shares[Thing::kGround].of(Kind::kGround), 0.98);
}

// A turn as a car's file has it that is wrong: by so much of pitch and roll, as tangents, and
// height.
std::vector<Point> seen_by_wrong_file(double pitch, double roll, std::int32_t up_mm) {
  std::vector<Point> turn = turn_of(0);
  for (Point& its : turn) {
    const double azimuth = (its.sector + 0.5) * 2 * 3.14159265358979 / 256;
    const double rise = pitch * std::cos(azimuth) + roll * std::sin(azimuth);
    its.z_mm += up_mm + static_cast<std::int32_t>(its.along_mm * rise);
  }
  return turn;
}

// docs/safety.md: a mount that was bent by 5 degrees, or by 20 cm, is taken up by the ground. Of
// what stands less than a tenth more is missed.
TEST(GroundOfADrive, TakesUpAMountThatWasBent) {
  constexpr double kFiveDegrees = 0.0875;
  struct Bent {
    double pitch;
    double roll;
    std::int32_t up_mm;
  };
  for (const Bent& bent :
       {Bent{kFiveDegrees, 0, 0}, Bent{-kFiveDegrees, 0, 0}, Bent{0, kFiveDegrees, 0},
        Bent{0, -kFiveDegrees, 0}, Bent{0, 0, 200}, Bent{0, 0, -200}}) {
    Drive drive;
    const std::vector<Point> turn = seen_by_wrong_file(bent.pitch, bent.roll, bent.up_mm);
    for (int i = 0; i < 3; ++i) {
      drive.close_turn(turn);
    }
    std::map<Thing, Shares> shares = shares_of(turn, drive.judge_turn(turn));
    const auto name = testing::Message() << bent.pitch << " " << bent.roll << " " << bent.up_mm;
    EXPECT_GE(shares[Thing::kGround].of(Kind::kGround), 0.95) << name;
    EXPECT_GE(shares[Thing::kWall].of(Kind::kObstacle), 0.72) << name;
    EXPECT_GE(shares[Thing::kCar].of(Kind::kObstacle), 0.87) << name;
    EXPECT_LE(shares[Thing::kCar].of(Kind::kUnder), 0.001) << name;
    EXPECT_LE(shares[Thing::kWall].of(Kind::kUnder), 0.001) << name;
  }
}

}  // namespace
}  // namespace iog::ground
