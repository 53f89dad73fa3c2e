// A simulated Velodyne: packets as it would send them while its head turns ten times a second, with
// the azimuth and the time at which each laser fires (lidar/velodyne.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "lidar/velodyne.hpp"
#include "tools/simulate/scanners/packet_encoder.hpp"
#include "tools/simulate/scanners/spinning_beams.hpp"

namespace iog::tools {

class VelodyneEncoder final : public PacketEncoder {
 public:
  VelodyneEncoder(const description::SensorConfig& config, const lidar::VelodyneUnit& unit)
      : unit_(unit), beams_(config) {}

  // 12 blocks, two at a time of a unit with two banks.
  [[nodiscard]] std::uint64_t packet_ns() const override;

  // The head looks forward when the drive begins.
  [[nodiscard]] std::vector<std::byte> packet(std::uint64_t begin_ns, std::uint64_t number,
                                              const RayCaster& rays, Random& random,
                                              std::vector<PointTruth>& truth) const override;

 private:
  // In units of the wire; 0: nothing came back.
  [[nodiscard]] std::uint16_t units_of(const std::optional<double>& range_m) const;

  lidar::VelodyneUnit unit_;
  SpinningBeams beams_;
};

}  // namespace iog::tools
