// A plane that touches the earth: east, north, from latitude and longitude (WGS 84).
//
// Through earth-centred coordinates, so that it is right to millimetres over kilometres; heights
// are taken to be 0.
#pragma once

namespace iog::tools {

class LocalPlane {
 public:
  struct Place {
    double east_m;
    double north_m;
  };

  // Touches the earth there. Degrees.
  LocalPlane(double latitude, double longitude);

  [[nodiscard]] Place place_of(double latitude, double longitude) const;

 private:
  struct Earth {  // earth-centred, earth-fixed
    double x;
    double y;
    double z;
  };
  static Earth earth_of(double latitude, double longitude);

  Earth origin_;
  double sin_latitude_;
  double cos_latitude_;
  double sin_longitude_;
  double cos_longitude_;
};

}  // namespace iog::tools
