// The packets of a unit that turns, of a radar or an ultrasonic unit, as it would send them: their
// bytes, and when each of their beams is sent where.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "tools/car/description.hpp"
#include "tools/simulate/random.hpp"
#include "tools/simulate/scanners/ray_caster.hpp"

namespace iog::tools {

inline constexpr std::uint32_t kTurnsPerSecond = 10;

class PacketEncoder {
 public:
  PacketEncoder() = default;
  PacketEncoder(const PacketEncoder&) = delete;
  PacketEncoder& operator=(const PacketEncoder&) = delete;
  virtual ~PacketEncoder() = default;

  // From one packet to the next.
  [[nodiscard]] virtual std::uint64_t packet_ns() const = 0;

  // The packet that begins so long after the drive did, each beam with one return. The drive begins
  // at kDriveStartUs of the unit's clock, with an hour. number: how many were sent before. What is
  // true of its points is appended.
  [[nodiscard]] virtual std::vector<std::byte> packet(std::uint64_t begin_ns, std::uint64_t number,
                                                      const RayCaster& rays, Random& random,
                                                      std::vector<PointTruth>& truth) const = 0;
};

// Of the sensor, which outlives it; nullptr if it has a mirror.
[[nodiscard]] std::unique_ptr<PacketEncoder> encoder_of(const description::SensorConfig& config);

}  // namespace iog::tools
