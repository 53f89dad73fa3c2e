#include "lab/evidence/frame_points.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "app/frame_engine.hpp"
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

// The engine decides which packets are believed and when a frame is over; what it would fuse is
// kept instead.
class FrameCutter {
 public:
  explicit FrameCutter(const tools::CatalogueEntry& car)
      : engine_(*car.vehicle, kReplayer), car_(&car) {}

  void take(const tools::CapturedDatagram& datagram) {
    using Outcome = app::FrameEngine::Outcome;
    if (tools::sensor_of_port(*car_, datagram.destination.port) == car_->sensors.size()) {
      return;
    }
    const std::uint64_t now_us = clock_.move_to(datagram.time_us);
    while (engine_.is_overdue(now_us)) {
      close_frame(engine_.deadline_us());
    }
    const std::optional<intake::SensorPacket> packet =
        engine_.receive({kReplayer, datagram.destination.port, datagram.payload});
    Outcome outcome = packet ? engine_.classify(*packet) : Outcome::kDropped;
    if (outcome == Outcome::kNextFrame) {
      close_frame(now_us);
      outcome = engine_.classify(*packet);
    }
    if (outcome == Outcome::kThisFrame) {
      engine_.fuse(*packet, now_us);  // it counts the marks, for which it has room for so many
      append(packet->sensor, packet->packet, points_);
      has_evidence_ = true;
    }
    if (engine_.is_complete()) {
      close_frame(now_us);
    }
  }

  // The capture is over.
  [[nodiscard]] std::vector<FramePoints> finish() {
    close_frame(engine_.deadline_us());
    return std::move(frames_);
  }

 private:
  void close_frame(std::uint64_t now_us) {
    if (has_evidence_) {
      frames_.push_back(std::exchange(points_, {}));
      engine_.fusion().clear();
    }
    has_evidence_ = false;
    engine_.start_next(now_us);
  }

  app::FrameEngine engine_;
  const tools::CatalogueEntry* car_;
  tools::CaptureClock clock_;
  FramePoints points_;
  std::vector<FramePoints> frames_;
  bool has_evidence_ = false;
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
