// A simulated ultrasonic unit behind MAVLink 2: what it hears first, ten times a second
// (lidar/mavlink_ultrasonic.hpp).
//
// In each degree of its cone it looks at the nearest thing on its horizon, and hears all that it
// meets. What a real unit is deaf to, echoes of echoes and other units' sounds are not simulated.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tools/car/description.hpp"
#include "tools/simulate/scanners/packet_encoder.hpp"

namespace iog::tools {

class MavlinkEncoder final : public PacketEncoder {
 public:
  explicit MavlinkEncoder(const description::SensorConfig& config) : config_(config) {}

  [[nodiscard]] std::uint64_t packet_ns() const override;

  // Heard when its cycle is over.
  [[nodiscard]] std::vector<std::byte> packet(std::uint64_t begin_ns, std::uint64_t number,
                                              const RayCaster& rays, Random& random,
                                              std::vector<PointTruth>& truth) const override;

 private:
  description::SensorConfig config_;
};

}  // namespace iog::tools
