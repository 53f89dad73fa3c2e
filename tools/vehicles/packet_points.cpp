#include "tools/vehicles/packet_points.hpp"

namespace iog::tools {

std::vector<lidar::ScanPoint> points_of(const intake::Packet& packet) {
  std::vector<lidar::ScanPoint> points;
  points.reserve(packet.info().point_count);
  packet.for_each_point([&](const lidar::ScanPoint& point) { points.push_back(point); });
  return points;
}

std::vector<lidar::ScanPoint> ListedPacket::samples(const lidar::Sampling& sampling) const {
  std::vector<lidar::ScanPoint> samples;
  packet_->for_each_sample(sampling,
                           [&](const lidar::ScanPoint& point) { samples.push_back(point); });
  return samples;
}

}  // namespace iog::tools
