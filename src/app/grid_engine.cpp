#include "app/grid_engine.hpp"

#include <algorithm>

namespace iog::app {
namespace {

// More than any LUX sends in a scan, and less than a turn of any lidar that turns.
constexpr std::uint32_t kDensePoints = 16'384;

// Of a part that is worth a round: 16 packets of a Velodyne.
constexpr std::size_t kPointsOfPart = 6'144;

}  // namespace

bool is_fused_together(const vehicle::Vehicle& vehicle) {
  return vehicle.rule == vehicle::FusionRule::kHitsWin &&
         std::ranges::any_of(vehicle.sensors, [](const vehicle::Sensor& sensor) {
           return sensor.max_points_per_scan > kDensePoints;
         });
}

// A frame stays as it was begun, whatever becomes of the cores meanwhile.
void GridEngine::fuse(const intake::SensorPacket& packet, std::uint64_t now_us,
                      const work::Crew& crew) {
  if (!frame_.is_begun()) {
    is_shared_ = may_share_ && !crew.is_one();
  }
  frame_.accept(packet, now_us);
  if (!is_shared_) {
    frame_.add_points(fusion_.own(), packet.sensor, packet.packet);
    return;
  }
  if (!packets_.fits(packet)) {
    fuse_kept(crew);
  }
  packets_.keep(packet, now_us);
  if (packets_.points() >= kPointsOfPart * crew.cores()) {
    fuse_kept(crew);
  }
}

void GridEngine::fuse_kept(const work::Crew& crew) {
  fusion_.deal(packets_, 1, crew.cores());
  while (fusion_.fuse_next(crew, frame_)) {
  }
  packets_.clear();
}

}  // namespace iog::app
