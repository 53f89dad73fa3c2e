// Where the scan points of a packet lie, for the eye, and what the target makes of each.
#pragma once

#include <memory>
#include <vector>

#include "fusion/frame_fusion.hpp"
#include "tools/formats/capture/datagram.hpp"
#include "tools/fuse/offline_target.hpp"
#include "tools/vehicles/seen_point.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

// The target's packets are judged here once more: by its code, and by its ground.
class ScanPoints {
 public:
  // Both outlive it.
  ScanPoints(const CatalogueEntry& car, OfflineTarget& target);

  // Lets the target take the packet. Appends its points that have a range and lie within 300 m;
  // none if it is not a packet of a sensor of the car.
  OfflineTarget::Closed take(const CapturedDatagram& packet, std::vector<SeenPoint>& points);

 private:
  [[nodiscard]] std::vector<SeenPoint> points_of(const CapturedDatagram& packet);

  const CatalogueEntry* car_;
  OfflineTarget* target_;
  std::unique_ptr<fusion::FrameFusion> fusion_;
};

}  // namespace iog::tools
