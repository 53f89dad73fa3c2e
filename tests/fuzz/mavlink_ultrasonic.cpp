// An ultrasonic unit behind MAVLink 2: the input as it is, and once more with the checksum that it
// should have.
#include "lidar/mavlink_ultrasonic.hpp"

#include <algorithm>
#include <vector>

#include "fakes/mavlink_distance.hpp"
#include "law.hpp"

namespace iog::fuzz {
namespace {

using lidar::MavlinkUltrasonic;

void check(std::span<const std::byte> datagram) {
  MavlinkUltrasonic decoder;
  if (decoder.decode(datagram) != lidar::DecodeStatus::kOk) {
    return;
  }
  std::uint32_t count = 0;
  decoder.for_each_point([&](const lidar::ScanPoint& point) {
    law(point.azimuth_ticks == 0 && point.layer == 0 && point.echo == 0, "one axis, one echo");
    law(point.range_mm <= lidar::kMaxRangeMm, "a range is one that a unit may have");
    ++count;
  });
  law(count == 1 && decoder.info().point_count == 1, "a message is a point");
  law(decoder.decode(datagram.first(datagram.size() - 1)) != lidar::DecodeStatus::kOk,
      "a shorter message is refused");
}

}  // namespace
}  // namespace iog::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto input = iog::fuzz::input_bytes(data, size);
  iog::fuzz::check(input);
  if (input.size() > 2) {
    std::vector<std::byte> mended(input.begin(), input.end());
    const std::uint16_t checksum =
        iog::tests::mavlink_checksum(std::span(mended).first(mended.size() - 2), 85);
    mended[mended.size() - 2] = static_cast<std::byte>(checksum & 0xFFU);
    mended[mended.size() - 1] = static_cast<std::byte>(checksum >> 8);
    iog::fuzz::check(mended);
  }
  return 0;
}
