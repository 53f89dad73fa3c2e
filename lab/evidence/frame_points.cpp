#include "lab/evidence/frame_points.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "app/frame.hpp"
#include "intake/packet.hpp"
#include "tools/formats/capture/capture_clock.hpp"
#include "tools/formats/capture/pcap_reader.hpp"

namespace iog::lab {
namespace {

// A capture stands for what its replayer sends, whatever address the sensors had.
constexpr std::uint32_t kReplayer = 0x0A000202;

void append(std::size_t sensor, const intake::Packet& packet, FramePoints& points) {
  packet.for_each_point([&](const lidar::ScanPoint& point) { points.push_back({sensor, point}); });
}

// The target's rules say which packets are believed and when a frame is over; what it would fuse is
// kept.
class FrameCutter {
 public:
  explicit FrameCutter(const tools::CatalogueEntry& car)
      : frame_(*car.vehicle, kReplayer), car_(&car) {}

  void take(const tools::CapturedDatagram& datagram) {
    if (tools::sensor_of_port(*car_, datagram.destination.port) == car_->sensors.size()) {
      return;
    }
    const std::uint64_t now_us = clock_.move_to(datagram.time_us);
    while (frame_.is_overdue(now_us)) {
      close_frame(frame_.deadline_us());
    }
    app::take_packet(
        frame_, frame_.receive({kReplayer, datagram.destination.port, datagram.payload}),
        [&](const intake::SensorPacket& packet) {
          frame_.accept(packet, now_us);
          append(packet.sensor, packet.packet, points_);
        },
        [&] { close_frame(now_us); });
  }

  // The capture is over.
  [[nodiscard]] std::vector<FramePoints> finish() {
    close_frame(frame_.deadline_us());
    return std::move(frames_);
  }

 private:
  void close_frame(std::uint64_t now_us) {
    if (frame_.is_begun()) {
      frames_.push_back(std::exchange(points_, {}));
    }
    frame_.start_next(now_us);
  }

  app::Frame frame_;
  const tools::CatalogueEntry* car_;
  tools::CaptureClock clock_;
  FramePoints points_;
  std::vector<FramePoints> frames_;
};

}  // namespace

std::vector<FramePoints> read_points(const std::string& pcap, const tools::CatalogueEntry& car) {
  tools::PcapReader capture(pcap);
  const auto cutter = std::make_unique<FrameCutter>(car);  // too large for the stack
  while (const std::optional<tools::CapturedDatagram> datagram = capture.next()) {
    cutter->take(*datagram);
  }
  return cutter->finish();
}

FramePoints points_of(tools::Drive& drive, std::uint32_t frame, const tools::CatalogueEntry& car) {
  FramePoints points;
  for (const tools::CapturedDatagram& datagram : drive.datagrams(frame)) {
    const std::size_t sensor = tools::sensor_of_port(car, datagram.destination.port);
    append(sensor, intake::Packet::decode(car.vehicle->sensors[sensor].format, datagram.payload),
           points);
  }
  return points;
}

}  // namespace iog::lab
