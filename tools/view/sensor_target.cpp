#include "tools/view/sensor_target.hpp"

#include <utility>

namespace iog::tools::view {

SensorTarget::SensorTarget(const CatalogueEntry& car, Viewer& viewer)
    : viewer_(&viewer),
      target_(*car.vehicle,
              [this](auto message) { messages_.emplace_back(message.begin(), message.end()); }),
      points_(car, target_) {
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
  std::vector<SeenPoint> points;
  const OfflineTarget::Closed closed = points_.take(packet, points);
  hand_over();
  show_until(closed.after);
  surroundings_.truth = std::move(truth);
  surroundings_.points.insert(surroundings_.points.end(), points.begin(), points.end());
  show_until(0);
}

void SensorTarget::finish() {
  target_.finish();
  hand_over();
  show_until(0);
}

}  // namespace iog::tools::view
