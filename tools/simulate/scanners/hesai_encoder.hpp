// A simulated Hesai: packets as it would send them while its head turns ten times a second, with
// the azimuth at which each block fires (lidar/hesai.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lidar/hesai.hpp"
#include "tools/simulate/scanners/packet_encoder.hpp"
#include "tools/simulate/scanners/spinning_beams.hpp"
#include "wire/byte_writer.hpp"

namespace iog::tools {

class HesaiEncoder final : public PacketEncoder {
 public:
  HesaiEncoder(const description::SensorConfig& config, const lidar::HesaiUnit& unit)
      : unit_(unit), beams_(config) {}

  [[nodiscard]] std::uint64_t packet_ns() const override;

  // The head looks forward when the drive begins. The nearest return of each beam.
  [[nodiscard]] std::vector<std::byte> packet(std::uint64_t begin_ns, std::uint64_t number,
                                              const RayCaster& rays, Random& random,
                                              std::vector<PointTruth>& truth) const override;

 private:
  // Of the later units: with a version of it, and a tail whose years count from 1900.
  [[nodiscard]] bool has_long_head() const { return unit_.header_bytes == 12; }
  [[nodiscard]] bool fires(std::size_t block, std::size_t laser) const;
  void write_head(wire::ByteWriter& out) const;
  void write_tail(std::uint64_t stamp_us, std::uint64_t number, wire::ByteWriter& out) const;

  lidar::HesaiUnit unit_;
  SpinningBeams beams_;
};

}  // namespace iog::tools
