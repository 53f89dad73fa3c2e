// A simulated Continental ARS548: detection lists as it would send them ten times a second
// (lidar/continental_ars548.hpp).
//
// In each degree of its field of view it reports the nearest thing on its horizon. What a real unit
// reports besides is not simulated: ghosts, and what it sees past other things.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tools/car/description.hpp"
#include "tools/simulate/scanners/packet_encoder.hpp"

namespace iog::tools {

class Ars548Encoder final : public PacketEncoder {
 public:
  explicit Ars548Encoder(const description::SensorConfig& config) : config_(config) {}

  [[nodiscard]] std::uint64_t packet_ns() const override;

  // All of a list is measured when its cycle is over.
  [[nodiscard]] std::vector<std::byte> packet(std::uint64_t begin_ns, std::uint64_t number,
                                              const RayCaster& rays, Random& random,
                                              std::vector<PointTruth>& truth) const override;

 private:
  description::SensorConfig config_;
};

}  // namespace iog::tools
