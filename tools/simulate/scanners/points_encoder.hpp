// A simulated unit whose points are sent as such (lidar/points.hpp): ten scans a second of a grid
// of directions, all layers after one another in each, from right to left.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tools/car/description.hpp"
#include "tools/simulate/scanners/packet_encoder.hpp"
#include "tools/simulate/scanners/spinning_beams.hpp"

namespace iog::tools {

class PointsEncoder final : public PacketEncoder {
 public:
  // As many directions as max_points_per_scan has room for.
  explicit PointsEncoder(const description::SensorConfig& config);

  [[nodiscard]] std::uint64_t packet_ns() const override;

  [[nodiscard]] std::vector<std::byte> packet(std::uint64_t begin_ns, std::uint64_t number,
                                              const RayCaster& rays, Random& random,
                                              std::vector<PointTruth>& truth) const override;

 private:
  SpinningBeams beams_;
  std::vector<double> elevations_deg_;
  std::int32_t width_ticks_;
  std::int32_t turn_ticks_;
  std::uint64_t directions_;  // of a scan
  std::uint64_t datagrams_;   // of a scan
};

}  // namespace iog::tools
