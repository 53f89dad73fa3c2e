// The scan points of a capture's first frame, cut as the firmware cuts frames, kept for whoever
// wants to do something else with them than fuse them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "app/frame.hpp"
#include "lidar/scan_point.hpp"
#include "playback.hpp"
#include "require/require.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::lab {

struct SensorPoint {
  const vehicle::Sensor* sensor;
  lidar::ScanPoint point;
};

// A target of play().
class FirstFrame {
 public:
  explicit FirstFrame(const vehicle::Vehicle& vehicle) : frame_(vehicle, kReplayer) {}

  void take(const vehicle::Sensor& sensor, const intake::Datagram& datagram,
            std::uint32_t /*received*/, std::uint64_t now_us) {
    app::take_packet(
        frame_, frame_.receive(datagram),
        [&](const intake::SensorPacket& packet) {
          if (!is_over_) {
            frame_.accept(packet, now_us);
            keep(sensor, packet.packet);
          }
        },
        [&] { is_over_ = true; });
  }

  // A frame that nothing has come in yet starts over.
  void tick(std::uint64_t now_us) {
    is_over_ = count_ > 0;
    if (!is_over_) {
      frame_.start_next(now_us);
    }
  }

  [[nodiscard]] std::uint64_t deadline_us() const {
    return is_over_ ? std::numeric_limits<std::uint64_t>::max() : frame_.deadline_us();
  }

  [[nodiscard]] std::span<const SensorPoint> points() const {
    return std::span(points_).first(count_);
  }

 private:
  void keep(const vehicle::Sensor& sensor, const intake::Packet& packet) {
    packet.for_each_point([&](const lidar::ScanPoint& point) {
      require(count_ < points_.size());
      points_[count_++] = {&sensor, point};
    });
  }

  bool is_over_ = false;
  std::size_t count_ = 0;
  std::array<SensorPoint, 16'384> points_{};
  app::Frame frame_;
};

}  // namespace iog::lab
