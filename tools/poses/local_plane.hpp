// A plane that touches the earth: east, north, from latitude and longitude (WGS 84), and back.
//
// Through earth-centred coordinates, so that it is right to millimetres over kilometres; heights
// are taken to be 0. Only + - * / and square roots are used, and numeric/elementary.hpp, so that
// every machine finds the same places.
#pragma once

namespace iog::tools {

// Degrees.
struct Geodetic {
  double latitude = 0;
  double longitude = 0;
};

class LocalPlane {
 public:
  struct Place {
    double east_m = 0;
    double north_m = 0;
  };

  // Touches the earth there. Degrees.
  LocalPlane(double latitude, double longitude);

  [[nodiscard]] Place place_of(double latitude, double longitude) const;

  // The point of the earth over which that place is; up to 100 km from the origin, which is at most
  // 80 degrees from the equator. Its place is the one given to a tenth of a millimetre.
  [[nodiscard]] Geodetic geodetic_of(const Place& place) const;

  // Where in this plane another one touches the earth, and how far its east is turned against this
  // plane's, counter-clockwise.
  struct Frame {
    Place origin;
    double turn_rad = 0;
  };
  [[nodiscard]] Frame frame_of(const LocalPlane& other) const;

  [[nodiscard]] const Geodetic& touches() const { return touches_; }
  // Along the earth to where another one touches it, to half a percent.
  [[nodiscard]] double metres_to(const LocalPlane& other) const;

 private:
  struct Earth {  // earth-centred, earth-fixed
    double x;
    double y;
    double z;
  };
  static Earth earth_of(double latitude, double longitude);

  Geodetic touches_;
  Earth origin_;
  double sin_latitude_;
  double cos_latitude_;
  double sin_longitude_;
  double cos_longitude_;
};

}  // namespace iog::tools
