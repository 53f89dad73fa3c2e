#include "tools/view/sensor_target.hpp"

#include <utility>

#include "tools/fuse/scan_points.hpp"

namespace iog::tools::view {

SensorTarget::SensorTarget(const CatalogueEntry& car, Viewer& viewer)
    : car_(&car), viewer_(&viewer), target_(*car.vehicle, [this](auto message) {
        messages_.emplace_back(message.begin(), message.end());
      }) {
  viewer.hold_frames();
}

void SensorTarget::hand_over() {
  for (const std::vector<std::byte>& message : std::exchange(messages_, {})) {
    viewer_->take(message);
  }
}

void SensorTarget::show_until(std::size_t held) {
  while (viewer_->held_frames() > held) {
    viewer_->show_next(std::exchange(surroundings_, {}));
  }
}

// Frames that the packet has closed without being in them hold the packets before it.
void SensorTarget::take(const CapturedDatagram& packet, std::shared_ptr<const Truth> truth) {
  const OfflineTarget::Closed closed = target_.take(packet);
  hand_over();
  show_until(closed.after);
  surroundings_.truth = std::move(truth);
  append_points(*car_, packet, surroundings_.points);
  show_until(0);
}

void SensorTarget::finish() {
  target_.finish();
  hand_over();
  show_until(0);
}

}  // namespace iog::tools::view
