// A simulated Velodyne: packets as it would send them while its head turns ten times a second, with
// the azimuth and the time at which each laser fires (lidar/velodyne.hpp).
#include <algorithm>
#include <optional>

#include "lidar/velodyne.hpp"
#include "numeric/elementary.hpp"
#include "tools/formats/velodyne/data_packet.hpp"
#include "tools/simulate/scanners/encoders.hpp"
#include "tools/simulate/scanners/spinning_beams.hpp"

namespace iog::tools {
namespace {

using lidar::VelodynePacket;

constexpr std::uint64_t kTurnNs = 1'000'000'000 / kTurnsPerSecond;
constexpr std::int32_t kVelodyneTurn = VelodynePacket::kTicksPerTurn;

// Where the head looks, to the nearest 0.01 degrees clockwise.
std::int32_t azimuth_at(std::uint64_t at_ns) {
  const std::uint64_t ticks = ((at_ns % kTurnNs) * kVelodyneTurn + kTurnNs / 2) / kTurnNs;
  return static_cast<std::int32_t>(ticks % kVelodyneTurn);
}

class VelodyneEncoder final : public PacketEncoder {
 public:
  VelodyneEncoder(const description::SensorConfig& config, const lidar::VelodyneUnit& unit)
      : unit_(unit), beams_(config) {}

  // 12 blocks, two at a time of a unit with two banks.
  [[nodiscard]] std::uint64_t packet_ns() const override {
    return VelodynePacket::kBlocks / unit_.banks * std::uint64_t{unit_.block_ns};
  }

  // The head looks forward when the drive begins.
  [[nodiscard]] std::vector<std::byte> packet(std::uint64_t begin_ns, std::uint64_t number,
                                              const RayCaster& rays, Random& random,
                                              std::vector<PointTruth>& truth) const override {
    VelodyneBlocks blocks;
    for (std::size_t block = 0; block < blocks.size(); ++block) {
      const std::size_t bank = block % unit_.banks;
      const std::uint64_t block_ns = begin_ns + block / unit_.banks * std::uint64_t{unit_.block_ns};
      blocks[block].azimuth_ticks = static_cast<std::uint16_t>(azimuth_at(block_ns));
      for (std::size_t channel = 0; channel < VelodynePacket::kPointsPerBlock; ++channel) {
        const std::uint64_t fires_ns =
            std::uint64_t{unit_.fires_after(bank, channel)} * unit_.block_ns / unit_.block_parts;
        const std::size_t layer = (bank * VelodynePacket::kPointsPerBlock + channel) % unit_.layers;
        const std::int32_t right = azimuth_at(block_ns + fires_ns) + unit_.azimuth_offsets[channel];
        const Measured measured = beams_.measure(layer, right, block_ns + fires_ns, rays, random);
        truth.push_back(measured.truth);
        blocks[block].ranges[channel] = units_of(measured.range_m);
      }
    }
    return data_packet(unit_, blocks, begin_ns / 1000, number);
  }

 private:
  // In units of the wire; 0: nothing came back.
  [[nodiscard]] std::uint16_t units_of(const std::optional<double>& range_m) const {
    if (!range_m) {
      return 0;
    }
    const double units = *range_m * 1000 / unit_.range_unit_mm;
    return static_cast<std::uint16_t>(numeric::round(std::clamp(units, 1.0, 65'535.0)));
  }

  lidar::VelodyneUnit unit_;
  SpinningBeams beams_;
};

}  // namespace

std::unique_ptr<PacketEncoder> velodyne_encoder(const description::SensorConfig& config,
                                                const lidar::VelodyneUnit& unit) {
  return std::make_unique<VelodyneEncoder>(config, unit);
}

}  // namespace iog::tools
