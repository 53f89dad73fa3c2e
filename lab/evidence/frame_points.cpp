#include "lab/evidence/frame_points.hpp"

#include "intake/packet.hpp"

namespace iog::lab {

FramePoints points_of(tools::Drive& drive, std::uint32_t frame, const tools::CatalogueEntry& car) {
  FramePoints points;
  for (const tools::CapturedDatagram& datagram : drive.datagrams(frame)) {
    const std::size_t sensor = tools::sensor_of_port(car, datagram.destination.port);
    intake::Packet::decode(car.vehicle->sensors[sensor].format, datagram.payload)
        .for_each_point([&](const lidar::ScanPoint& point) {
          points.push_back({sensor, point});
        });
  }
  return points;
}

}  // namespace iog::lab
