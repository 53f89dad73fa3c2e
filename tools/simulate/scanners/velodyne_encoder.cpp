#include "tools/simulate/scanners/velodyne_encoder.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <string_view>

#include "lidar/velodyne_bytes.hpp"
#include "numeric/elementary.hpp"
#include "require/require.hpp"
#include "wire/byte_writer.hpp"

namespace iog::tools {
namespace {

using lidar::VelodynePacket;

constexpr std::uint64_t kHourNs = 3'600'000'000'000;
constexpr std::uint64_t kTurnNs = 1'000'000'000 / kTurnsPerSecond;
constexpr std::int32_t kVelodyneTurn = VelodynePacket::kTicksPerTurn;
constexpr std::uint8_t kReflectivity = 50;
// What an HDL-64E says of itself, a byte a packet: hour, minute, second, day, month, year, GPS,
// temperature, version, and seven bytes of its calibration, all zero here.
constexpr std::string_view kStatusTypes = "HMSDNYGTV1234567";

// Where the head looks, to the nearest 0.01 degrees clockwise.
std::int32_t azimuth_at(std::uint64_t at_ns) {
  const std::uint64_t ticks = ((at_ns % kTurnNs) * kVelodyneTurn + kTurnNs / 2) / kTurnNs;
  return static_cast<std::int32_t>(ticks % kVelodyneTurn);
}

void write_end(const lidar::VelodyneUnit& unit, std::uint64_t begin_ns, std::uint64_t number,
               wire::ByteWriter& out) {
  out.u32_le(static_cast<std::uint32_t>(begin_ns % kHourNs / 1000));
  if (unit.banks == 2) {
    out.u8(static_cast<std::uint8_t>(kStatusTypes[number % kStatusTypes.size()]));
    out.u8(0);
  } else {
    out.u8(lidar::velodyne::kModeStrongest);
    out.u8(unit.product);
  }
}

}  // namespace

std::uint64_t VelodyneEncoder::packet_ns() const {
  return VelodynePacket::kBlocks / unit_.banks * std::uint64_t{unit_.block_ns};
}

std::uint16_t VelodyneEncoder::units_of(const std::optional<double>& range_m) const {
  if (!range_m) {
    return 0;
  }
  const double units = *range_m * 1000 / unit_.range_unit_mm;
  return static_cast<std::uint16_t>(numeric::round(std::clamp(units, 1.0, 65'535.0)));
}

std::vector<std::byte> VelodyneEncoder::packet(std::uint64_t begin_ns, std::uint64_t number,
                                               const RayCaster& rays, Random& random,
                                               std::vector<PointTruth>& truth) const {
  std::vector<std::byte> bytes(VelodynePacket::kPacketBytes);
  wire::ByteWriter out(bytes);
  for (std::size_t block = 0; block < VelodynePacket::kBlocks; ++block) {
    const std::size_t bank = block % unit_.banks;
    const std::uint64_t block_ns = begin_ns + block / unit_.banks * std::uint64_t{unit_.block_ns};
    out.u16_le(bank == 0 ? lidar::velodyne::kBlockFlag : lidar::velodyne::kLowerFlag);
    out.u16_le(static_cast<std::uint16_t>(azimuth_at(block_ns)));
    for (std::size_t channel = 0; channel < VelodynePacket::kPointsPerBlock; ++channel) {
      const std::uint64_t fires_ns =
          std::uint64_t{unit_.fires_at[channel]} * unit_.block_ns / unit_.block_parts;
      const std::size_t layer = (bank * VelodynePacket::kPointsPerBlock + channel) % unit_.layers;
      const std::int32_t right = azimuth_at(block_ns + fires_ns) + unit_.azimuth_offsets[channel];
      const Measured measured = beams_.measure(layer, right, block_ns + fires_ns, rays, random);
      truth.push_back(measured.truth);
      out.u16_le(units_of(measured.range_m));
      out.u8(kReflectivity);
    }
  }
  write_end(unit_, begin_ns, number, out);
  require(out.ok() && out.remaining() == 0);
  return bytes;
}

}  // namespace iog::tools
