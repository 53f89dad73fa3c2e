// A simulated Ouster: packets of 16 columns as it would send them, in its mode and profile
// (lidar/ouster.hpp). Its column 0 is behind it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lidar/ouster.hpp"
#include "tools/simulate/scanners/packet_encoder.hpp"
#include "tools/simulate/scanners/spinning_beams.hpp"
#include "wire/byte_writer.hpp"

namespace iog::tools {

class OusterEncoder final : public PacketEncoder {
 public:
  OusterEncoder(const description::SensorConfig& config, const lidar::OusterProfile& profile)
      : mode_(config.mode), profile_(profile), beams_(config) {}

  [[nodiscard]] std::uint64_t packet_ns() const override;

  // number says which columns of which turn they are.
  [[nodiscard]] std::vector<std::byte> packet(std::uint64_t begin_ns, std::uint64_t number,
                                              const RayCaster& rays, Random& random,
                                              std::vector<PointTruth>& truth) const override;

 private:
  void write_column_head(std::uint64_t time_ns, std::uint16_t frame, std::uint32_t column,
                         wire::ByteWriter& out) const;
  void write_pixels(std::uint32_t column, std::uint64_t fires_ns, const RayCaster& rays,
                    Random& random, std::vector<PointTruth>& truth, wire::ByteWriter& out) const;

  lidar::TurnMode mode_;
  lidar::OusterProfile profile_;
  SpinningBeams beams_;
};

}  // namespace iog::tools
