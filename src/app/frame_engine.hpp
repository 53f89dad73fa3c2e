// The engine: datagrams in, frames out. It decides which packets are believed and when a frame is
// over, and hands their points to the fusion. It knows no clock and no network: time and datagrams
// are given to it, so that the target and `iog fuse` run the same frames.
//
// A frame opens with its first packet. It is over when every sensor has delivered its scan, when a
// sensor's next scan begins, or when the vehicle's frame period is over, whichever is first. While
// nothing arrives at all, an empty frame is over every two periods, so that silence is reported.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "app/scan_tracker.hpp"
#include "grid/frame_fusion.hpp"
#include "lidar/ibeo_lux.hpp"
#include "lidar/velodyne_vlp16.hpp"
#include "stream/message.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::app {

// A UDP datagram on its way into the engine.
struct SensorDatagram {
  std::uint32_t source_ipv4 = 0;
  std::uint16_t destination_port = 0;
  std::span<const std::byte> payload;
};

class FrameEngine {
 public:
  enum class Inspection : std::uint8_t {
    kDropped,    // counted; nothing else to do
    kThisFrame,  // call fuse()
    kNextFrame,  // close the frame, then inspect the same datagram again
  };

  // vehicle outlives the engine. replayer_ipv4 may send in the name of every sensor, 0: nobody may.
  // start_us: the time from which silence is counted.
  FrameEngine(const vehicle::Vehicle& vehicle, std::uint32_t replayer_ipv4, std::uint64_t start_us);

  [[nodiscard]] Inspection inspect(const SensorDatagram& datagram);

  // Fuses the datagram that inspect() has just found to be kThisFrame.
  void fuse(std::uint64_t now_us);

  // Whether every sensor has delivered its scan.
  [[nodiscard]] bool is_complete() const;

  // Whether the frame's time is over. See deadline_us().
  [[nodiscard]] bool is_overdue(std::uint64_t now_us) const { return now_us >= deadline_us(); }
  [[nodiscard]] std::uint64_t deadline_us() const;

  // Closes the frame in three steps: finish() completes the grid; report() says what took part;
  // start_next() clears the counters. The caller sets every known cell back to unknown in between.
  void finish() { fusion_.finish(); }
  void report(std::uint64_t now_us, stream::Header& header, stream::FrameEnd& end) const;
  void start_next(std::uint64_t now_us);

  [[nodiscard]] grid::FrameFusion& fusion() { return fusion_; }

 private:
  // The sensor whose packet the datagram is, or kNobody.
  [[nodiscard]] std::size_t sensor_of(const SensorDatagram& datagram) const;
  [[nodiscard]] lidar::DecodeStatus decode(std::size_t sensor, std::span<const std::byte> payload);
  [[nodiscard]] const lidar::PacketInfo& packet() const;
  Inspection drop(stream::PacketDrop cause);
  [[nodiscard]] stream::SensorReport report_of(std::size_t sensor) const;

  static constexpr std::size_t kNobody = vehicle::kMaxSensors;

  const vehicle::Vehicle* vehicle_;
  std::uint32_t replayer_ipv4_;
  std::uint32_t vehicle_id_;
  std::array<ScanTracker, vehicle::kMaxSensors> trackers_;

  std::size_t sensor_ = kNobody;  // of the packet inspected last
  lidar::IbeoLux lux_;
  lidar::VelodyneVlp16 vlp16_;

  std::uint32_t frame_number_ = 0;
  std::uint64_t opened_us_ = 0;
  std::uint32_t packets_fused_ = 0;
  std::array<std::uint32_t, vehicle::kFateCount> fates_{};
  std::array<std::uint32_t, stream::kPacketDropCount> packet_drops_{};
  std::uint32_t packets_dropped_ = 0;

  grid::FrameFusion fusion_;
};

}  // namespace iog::app
