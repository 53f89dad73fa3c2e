#include "tools/formats/velodyne/data_packet.hpp"

#include <string_view>

#include "lidar/velodyne_bytes.hpp"
#include "require/require.hpp"
#include "wire/byte_writer.hpp"

namespace iog::tools {
namespace {

constexpr std::uint8_t kReflectivity = 50;
// What an HDL-64E says of itself, a byte a packet: hour, minute, second, day, month, year, GPS,
// temperature, version, and seven bytes of its calibration, all zero here.
constexpr std::string_view kStatusTypes = "HMSDNYGTV1234567";

void write_end(const lidar::VelodyneUnit& unit, std::uint64_t begin_us, std::uint64_t number,
               wire::ByteWriter& out) {
  out.u32_le(static_cast<std::uint32_t>(begin_us % lidar::velodyne::kHourUs));
  if (unit.banks == 2) {
    out.u8(static_cast<std::uint8_t>(kStatusTypes[number % kStatusTypes.size()]));
    out.u8(0);
  } else {
    out.u8(lidar::velodyne::kModeStrongest);
    out.u8(unit.product);
  }
}

}  // namespace

std::vector<std::byte> data_packet(const lidar::VelodyneUnit& unit, const VelodyneBlocks& blocks,
                                   std::uint64_t begin_us, std::uint64_t number) {
  std::vector<std::byte> bytes(lidar::VelodynePacket::kPacketBytes);
  wire::ByteWriter out(bytes);
  for (std::size_t block = 0; block < blocks.size(); ++block) {
    out.u16_le(lidar::velodyne::kBankFlags[block % unit.banks]);
    out.u16_le(blocks[block].azimuth_ticks);
    for (const std::uint16_t range : blocks[block].ranges) {
      out.u16_le(range);
      out.u8(kReflectivity);
    }
  }
  write_end(unit, begin_us, number, out);
  require(out.ok() && out.remaining() == 0);
  return bytes;
}

}  // namespace iog::tools
