// Where on the earth the world of a simulated drive is: the plane of its map, and its local frame
// in that plane.
#pragma once

#include "pose/message.hpp"
#include "tools/poses/map_origin.hpp"
#include "tools/simulate/world/solid.hpp"

namespace iog::tools {

struct MapPlace {
  // Far out at sea, 2,688 km from the nearest land: nobody's town, and no sign of a coordinate that
  // a program could leave out.
  MapOrigin origin{.latitude = -48'876'667'000, .longitude = -123'393'333'000};
  // Neither on the origin nor turned like the plane: who forgets a step, sees it. 33 degrees.
  pose::Pose local_frame{.x_mm = 312'500, .y_mm = -187'250, .heading = 0x17777777};
  // What messages say of it. The place itself is exact.
  pose::Sigma sigma{.position_mm = 50, .heading_10urad = 50};

  [[nodiscard]] pose::MapTransform transform() const {
    return {.origin = origin.name(), .local_frame = local_frame, .sigma = sigma};
  }
};

// From the local frame to the plane.
class ToMapPlane {
 public:
  explicit ToMapPlane(const MapPlace& place);
  [[nodiscard]] LocalPlane::Place place_of(double x_m, double y_m) const;

 private:
  Placement frame_;
};

}  // namespace iog::tools
