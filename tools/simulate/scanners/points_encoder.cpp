// A simulated unit whose points are sent as such (lidar/points.hpp): ten scans a second of a grid
// of directions, all layers after one another in each, from right to left.
#include <algorithm>

#include "lidar/points.hpp"
#include "numeric/elementary.hpp"
#include "tools/car/description.hpp"
#include "tools/formats/capture/made_capture.hpp"
#include "tools/formats/points/points_writer.hpp"
#include "tools/simulate/scanners/encoders.hpp"
#include "tools/simulate/scanners/spinning_beams.hpp"

namespace iog::tools {
namespace {

using lidar::PointsPacket;

constexpr std::uint64_t kScanNs = 1'000'000'000 / kTurnsPerSecond;
constexpr std::int64_t kTurn = PointsPacket::kPartsPerTurn;

class PointsEncoder final : public PacketEncoder {
 public:
  // As many directions as max_points_per_scan has room for.
  explicit PointsEncoder(const description::SensorConfig& config)
      : beams_(config),
        width_ticks_(config.scan_width_ticks),
        turn_ticks_(lidar::ticks_per_turn(config.format)),
        directions_(std::max<std::uint64_t>(config.max_points_per_scan / beams_.layers(), 1)),
        datagrams_((directions_ * beams_.layers() + PointsPacket::kMostPoints - 1) /
                   PointsPacket::kMostPoints) {
    for (const lidar::Laser& laser : config.lasers) {
      elevations_deg_.push_back(laser.elevation_deg);
    }
  }

  [[nodiscard]] std::uint64_t packet_ns() const override { return kScanNs / datagrams_; }

  [[nodiscard]] std::vector<std::byte> packet(std::uint64_t begin_ns, std::uint64_t number,
                                              const RayCaster& rays, Random& random,
                                              std::vector<PointTruth>& truth) const override {
    const std::uint64_t in_scan = number % datagrams_;
    const std::uint64_t points = directions_ * beams_.layers();
    const std::int64_t right_parts = kTurn - width_ticks_ * kTurn / (2 * turn_ticks_);
    PointsScan part{.number = static_cast<std::uint32_t>(number / datagrams_),
                    .time_us = kDriveStartUs + begin_ns / 1000,
                    .sector_begin = static_cast<std::uint32_t>(right_parts % kTurn),
                    .sector_width = static_cast<std::uint32_t>(width_ticks_ * kTurn / turn_ticks_)};
    const std::uint64_t first = in_scan * PointsPacket::kMostPoints;
    const std::uint64_t end = std::min(first + PointsPacket::kMostPoints, points);
    for (std::uint64_t i = first; i < end; ++i) {
      const std::size_t layer = i % beams_.layers();
      const auto direction = static_cast<std::int64_t>(i / beams_.layers());
      const std::int64_t left_ticks =
          (2 * direction + 1) * width_ticks_ / (2 * static_cast<std::int64_t>(directions_)) -
          width_ticks_ / 2;
      const std::uint64_t after_ns = packet_ns() * (i - first) / (end - first);
      const Measured measured = beams_.measure(layer, static_cast<std::int32_t>(-left_ticks),
                                               begin_ns + after_ns, rays, random);
      truth.push_back(measured.truth);
      WirePoint& point = part.points.emplace_back();
      point.first = static_cast<std::int32_t>((left_ticks * kTurn / turn_ticks_ + kTurn) % kTurn);
      point.second = static_cast<std::int32_t>(
          numeric::round(elevations_deg_[layer] * PointsPacket::kPartsPerDegree));
      point.third = measured.range_m
                        ? static_cast<std::int32_t>(numeric::round(*measured.range_m * 1000))
                        : 0;
      point.after_us = static_cast<std::uint32_t>(after_ns / 1000);
      point.flags = measured.range_m ? std::uint8_t{0} : PointsPacket::kNothing;
    }
    return datagram_of(part, in_scan, datagrams_, part.points).bytes;
  }

 private:
  SpinningBeams beams_;
  std::vector<double> elevations_deg_;
  std::int32_t width_ticks_;
  std::int32_t turn_ticks_;
  std::uint64_t directions_;  // of a scan
  std::uint64_t datagrams_;   // of a scan
};

}  // namespace

std::unique_ptr<PacketEncoder> points_encoder(const description::SensorConfig& config) {
  return std::make_unique<PointsEncoder>(config);
}

}  // namespace iog::tools
