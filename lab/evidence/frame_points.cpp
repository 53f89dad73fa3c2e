#include "lab/evidence/frame_points.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "app/frame_engine.hpp"
#include "lidar/ibeo_lux.hpp"
#include "lidar/velodyne_vlp16.hpp"
#include "tools/formats/capture/capture_clock.hpp"
#include "tools/formats/capture/pcap_reader.hpp"

namespace iog::lab {
namespace {

// A capture stands for what its replayer sends, whatever address the sensors had.
constexpr std::uint32_t kReplayer = 0x0A000202;

// Decodes a packet that is known to be sound.
class PointReader {
 public:
  explicit PointReader(const vehicle::Vehicle& vehicle) : vehicle_(&vehicle) {}

  void append(std::size_t sensor, std::span<const std::byte> payload, FramePoints& points) {
    const auto add = [&](const lidar::ScanPoint& point) { points.push_back({sensor, point}); };
    if (vehicle_->sensors[sensor].format == lidar::Format::kIbeoLux) {
      if (lux_.decode(payload) == lidar::DecodeStatus::kOk) {
        lux_.for_each_point(add);
      }
    } else if (vlp16_.decode(payload) == lidar::DecodeStatus::kOk) {
      vlp16_.for_each_point(add);
    }
  }

 private:
  const vehicle::Vehicle* vehicle_;
  lidar::IbeoLux lux_;
  lidar::VelodyneVlp16 vlp16_;
};

// The engine decides which packets are believed and when a frame is over; what it would fuse is
// kept instead.
class FrameCutter {
 public:
  explicit FrameCutter(const tools::CatalogueEntry& car)
      : engine_(*car.vehicle, kReplayer, 0), car_(&car), reader_(*car.vehicle) {}

  void take(const tools::CapturedDatagram& datagram) {
    using Inspection = app::FrameEngine::Inspection;
    const std::size_t sensor = tools::sensor_of_port(*car_, datagram.destination.port);
    if (sensor == car_->sensors.size()) {
      return;
    }
    const std::uint64_t now_us = clock_.move_to(datagram.time_us);
    while (engine_.is_overdue(now_us)) {
      close_frame(engine_.deadline_us());
    }
    const app::SensorDatagram packet{kReplayer, datagram.destination.port, datagram.payload};
    Inspection inspection = engine_.inspect(packet);
    if (inspection == Inspection::kNextFrame) {
      close_frame(now_us);
      inspection = engine_.inspect(packet);
    }
    if (inspection == Inspection::kThisFrame) {
      engine_.fuse(now_us);  // it counts the marks, for which it has room for so many
      reader_.append(sensor, datagram.payload, points_);
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
  PointReader reader_;
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

FramePoints points_of(tools::Drive& drive, const tools::CatalogueEntry& car) {
  FramePoints points;
  PointReader reader(*car.vehicle);
  for (const tools::CapturedDatagram& datagram : drive.datagrams()) {
    reader.append(tools::sensor_of_port(car, datagram.destination.port), datagram.payload, points);
  }
  return points;
}

}  // namespace iog::lab
