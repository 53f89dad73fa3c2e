// Places in the plane of a map against PROJ 9.1.1:
//   cct -d 5 +proj=pipeline +step +proj=unitconvert +xy_in=deg +xy_out=rad
//     +step +proj=cart +ellps=WGS84
//     +step +proj=topocentric +ellps=WGS84 +lat_0=LAT +lon_0=LON +h_0=0   (each on one line)
#include <array>

#include "gtest/gtest.h"

#include "tools/poses/local_plane.hpp"

namespace iog::tools {
namespace {

struct Known {
  double origin_latitude;
  double origin_longitude;
  double latitude;
  double longitude;
  double east_m;
  double north_m;
};

constexpr std::array<Known, 15> kKnown{{
    {48.4, 15.6, 48.431440891, 15.647356002, 3504.39174, 3497.25968},
    {48.4, 15.6, 48.400089831, 15.532362099, -5008.35034, 12.19967},
    {48.4, 15.6, 48.361183974, 15.601670314, 123.77523, -4316.25195},
    {69.65, 18.95, 69.681440891, 19.040411304, 3505.13677, 3510.06841},
    {69.65, 18.95, 69.650089831, 18.820866825, -5013.72598, 15.31866},
    {69.65, 18.95, 69.611183974, 18.953188936, 124.04023, -4330.20823},
    {-33.9, 151.2, -33.868559109, 151.237880031, 3504.91921, 3486.78660},
    {-33.9, 151.2, -33.899910169, 151.145896493, -5004.19491, 8.64633},
    {-33.9, 151.2, -33.938816026, 151.201336083, 123.52217, -4305.51022},
    {0, 0, 0.031440891, 0.031440891, 3499.98328, 3476.55358},
    {0, 0, 0.000089831, -0.044906576, -4998.97666, 9.93300},
    {0, 0, -0.038816026, 0.001108965, 123.44939, -4292.05364},
    {52.5, -179.99, 52.531440891, -179.938352689, 3504.87791, 3499.90519},
    {52.5, -179.99, 52.500089831, 179.936232883, -5009.53054, 12.55454},
    {52.5, -179.99, 52.461183974, -179.988178326, 123.81923, -4319.30830},
}};

TEST(MapPlane, IsThatOfProjToACentimetre) {
  for (const Known& known : kKnown) {
    const auto place = LocalPlane(known.origin_latitude, known.origin_longitude)
                           .place_of(known.latitude, known.longitude);
    EXPECT_NEAR(place.east_m, known.east_m, 0.001) << known.latitude;
    EXPECT_NEAR(place.north_m, known.north_m, 0.001) << known.latitude;
  }
}

}  // namespace
}  // namespace iog::tools
