// Planes that touch the earth, and their origins in words. Places come from PROJ 9.1:
//   cct +proj=pipeline +step +proj=cart +ellps=WGS84
//       +step +proj=topocentric +ellps=WGS84 +lon_0=LON +lat_0=LAT +h_0=0
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

#include "gtest/gtest.h"

#include "tools/poses/local_plane.hpp"
#include "tools/poses/map_origin.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::tools {
namespace {

const double kDegree = std::acos(-1.0) / 180;

// Radii of curvature of the ellipsoid, along the meridian and across it.
TEST(LocalPlane, SmallAnglesAreArcsOfTheEllipsoid) {
  constexpr double kA = 6'378'137.0;
  constexpr double kE2 = 0.00669437999014;
  for (const double latitude : {-75.0, -30.0, 0.0, 48.0, 80.0}) {
    for (const double longitude : {-170.0, 0.0, 11.5, 95.0}) {
      const double sin = std::sin(latitude * kDegree);
      const double across = kA / std::sqrt(1 - kE2 * sin * sin);
      const double along = across * (1 - kE2) / (1 - kE2 * sin * sin);
      const auto place =
          LocalPlane(latitude, longitude).place_of(latitude + 2e-4, longitude - 3e-4);
      EXPECT_NEAR(place.north_m, along * 2e-4 * kDegree, 2e-3);
      EXPECT_NEAR(place.east_m, -across * std::cos(latitude * kDegree) * 3e-4 * kDegree, 2e-3);
    }
  }
}

struct Known {
  Geodetic origin;
  Geodetic at;
  LocalPlane::Place place;
};

constexpr std::array kKnown{
    Known{{-48.876667, -123.393333}, {-48.88, -123.3953}, {-144.274368, -370.656063}},
    Known{{-48.876667, -123.393333}, {-48.84, -123.33}, {4649.013970, 4075.690964}},
    Known{{49, 8.4}, {49.03, 8.46}, {4387.6694, 3338.0346}},
    Known{{49, 8.4}, {48.97, 8.35}, {-3660.7860, -3335.0778}}};

TEST(LocalPlane, PlacesAreThoseOfProj) {
  for (const Known& known : kKnown) {
    const LocalPlane plane(known.origin.latitude, known.origin.longitude);
    const LocalPlane::Place place = plane.place_of(known.at.latitude, known.at.longitude);
    EXPECT_NEAR(place.east_m, known.place.east_m, 1e-3);
    EXPECT_NEAR(place.north_m, known.place.north_m, 1e-3);
  }
}

// 1e-9 degrees are 0.1 mm.
TEST(LocalPlane, AndBackAgain) {
  for (const Known& known : kKnown) {
    const LocalPlane plane(known.origin.latitude, known.origin.longitude);
    const Geodetic at = plane.geodetic_of(known.place);
    EXPECT_NEAR(at.latitude, known.at.latitude, 1e-9);
    EXPECT_NEAR(at.longitude, known.at.longitude, 2e-9);
  }
}

TEST(LocalPlane, AlsoFarAway) {
  for (const double latitude : {-80.0, -60.0, 0.0, 45.0, 80.0}) {
    const LocalPlane plane(latitude, 179.99);
    for (const double east_m : {-70'000.0, 0.0, 70'000.0}) {
      for (const double north_m : {-70'000.0, 70'000.0}) {
        const Geodetic at = plane.geodetic_of({east_m, north_m});
        const LocalPlane::Place place = plane.place_of(at.latitude, at.longitude);
        EXPECT_NEAR(place.east_m, east_m, 1e-4);
        EXPECT_NEAR(place.north_m, north_m, 1e-4);
      }
    }
  }
}

// A quarter of the equator and of a meridian of WGS 84, half of the equator, and a kilometre.
TEST(LocalPlane, DistancesAreAlongTheEarth) {
  const LocalPlane origin(0, 0);
  EXPECT_NEAR(origin.metres_to({0, 90}), 10'018'754, 0.005 * 10'018'754);
  EXPECT_NEAR(origin.metres_to({90, 0}), 10'001'966, 0.005 * 10'001'966);
  EXPECT_NEAR(origin.metres_to({0, 180}), 20'037'508, 0.005 * 20'037'508);
  EXPECT_NEAR(origin.metres_to({1 / 110.574, 0}), 1000, 5);
  EXPECT_EQ(origin.metres_to(origin), 0);
}

// A place near the other plane's origin is the same seen from either plane. Over 200 m the two
// planes lie as good as flat on each other.
TEST(LocalPlane, FramesOfOtherPlanesAreTurnedByTheMeridians) {
  const LocalPlane plane(49, 8.4);
  for (const auto& [latitude, longitude] : {std::pair{49.03, 8.46}, {48.95, 8.35}, {49.0, 8.4}}) {
    const LocalPlane other(latitude, longitude);
    const LocalPlane::Frame frame = plane.frame_of(other);
    const LocalPlane::Place here = other.place_of(latitude + 1e-3, longitude - 2e-3);
    const LocalPlane::Place there = plane.place_of(latitude + 1e-3, longitude - 2e-3);
    const double cos = std::cos(frame.turn_rad);
    const double sin = std::sin(frame.turn_rad);
    EXPECT_NEAR(frame.origin.east_m + cos * here.east_m - sin * here.north_m, there.east_m, 2e-3);
    EXPECT_NEAR(frame.origin.north_m + sin * here.east_m + cos * here.north_m, there.north_m, 2e-3);
  }
}

TEST(MapOrigin, IsReadToTheLastDecimal) {
  EXPECT_EQ(map_origin_in("--o", "-48.876667,-123.393333"),
            (MapOrigin{-48'876'667'000, -123'393'333'000}));
  EXPECT_EQ(map_origin_in("--o", "0.123456789, 180"), (MapOrigin{123'456'789, 180'000'000'000}));
  EXPECT_EQ(map_origin_in("--o", "-0.5,7."), (MapOrigin{-500'000'000, 7'000'000'000}));
}

TEST(MapOrigin, IsWrittenAsItIsRead) {
  for (const std::int64_t latitude : {-80'000'000'000L, -1L, 0L, 1L, 48'000'000'001L}) {
    for (const std::int64_t longitude : {-180'000'000'000L, -99'999'999L, 123'393'333'000L}) {
      const MapOrigin origin{latitude, longitude};
      EXPECT_EQ(map_origin_in("--o", text_of(origin)), origin) << text_of(origin);
    }
  }
  EXPECT_EQ(decimal_degrees(-488'766'670, 7), "-48.8766670");
  EXPECT_EQ(decimal_degrees(-5, 7), "-0.0000005");
}

TEST(MapOrigin, WhatIsNoPlaceIsRefused) {
  for (const std::string_view text :
       {"", "1", "1,", ",1", "1,2,3", "1;2", "1e2,3", "+1,2", "--1,2", "1.-2,3", "80.1,0",
        "0,180.000000001", "1.0123456789,2", "1 2,3", "nan,1", "1000,0"}) {
    EXPECT_THROW(static_cast<void>(map_origin_in("--o", text)), UsageError) << text;
  }
}

// Fowler, Noll and Vo's 64 bits of 16 zero bytes: the offset basis times the prime, 16 times over.
TEST(MapOrigin, IsNamedByItsHash) {
  std::uint64_t name = 0xCBF29CE484222325;
  for (int i = 0; i < 16; ++i) {
    name *= 0x100000001B3;
  }
  EXPECT_EQ(MapOrigin{}.name(), name);
  EXPECT_NE((MapOrigin{1, 2}).name(), (MapOrigin{2, 1}).name());
}

}  // namespace
}  // namespace iog::tools
