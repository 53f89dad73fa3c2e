// The target in this process, for a viewer that has the sensors' packets themselves: the grid comes
// with the scan points that it was made from and, in a simulated world, with the truth.
#pragma once

#include <memory>
#include <vector>

#include "tools/fuse/offline_target.hpp"
#include "tools/fuse/scan_points.hpp"
#include "tools/view/viewer.hpp"

namespace iog::tools::view {

class SensorTarget {
 public:
  // Both outlive the target.
  SensorTarget(const CatalogueEntry& car, Viewer& viewer);

  // The next packet of a sensor, or the next pose. truth: of the world at that time, or null.
  void take(const CapturedDatagram& packet, std::shared_ptr<const Truth> truth);

  // No more packets come.
  void finish();

 private:
  // The messages of the last packet, which wait until the target's stopwatch is not running.
  void hand_over();
  void show_until(std::size_t held);

  Viewer* viewer_;
  std::vector<std::vector<std::byte>> messages_;
  OfflineTarget target_;
  ScanPoints points_;
  Surroundings surroundings_;  // of the frame that is open
};

}  // namespace iog::tools::view
