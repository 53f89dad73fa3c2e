#include "synthetic_scan.hpp"

#include <algorithm>

#include "require/require.hpp"
#include "tools/formats/lux/lux_message.hpp"
#include "tools/simulate/random.hpp"

namespace iog::lab {
namespace {

constexpr std::int32_t kEdgeTicks = 1600;
constexpr std::uint32_t kLayers = lidar::IbeoLux::kElevationsDeg.size();
constexpr std::uint32_t kColumnsOfMessage = 33;  // 132 points: 1,388 bytes
constexpr std::uint32_t kMostMessages = 25;      // of kMostAzimuths
constexpr std::uint32_t kLayersApartCm = 30;     // layers of a direction see about the same

std::int16_t angle_of(const Fan& fan, std::uint32_t column) {
  const auto step = static_cast<std::int32_t>(2 * kEdgeTicks / (fan.azimuths - 1));
  return static_cast<std::int16_t>(kEdgeTicks - step * static_cast<std::int32_t>(column));
}

void write_column(const Fan& fan, std::uint32_t column, tools::Random& random,
                  wire::ByteWriter& out) {
  const std::uint32_t range_cm =
      fan.range_cm - static_cast<std::uint32_t>(random.below(1 + fan.range_cm / 10));
  for (std::uint32_t layer = 0; layer < kLayers; ++layer) {
    tools::write_lux_point(
        {.layer = static_cast<std::uint8_t>(layer),
         .angle_ticks = angle_of(fan, column),
         .range_cm = static_cast<std::uint16_t>(range_cm - random.below(kLayersApartCm))},
        out);
  }
}

}  // namespace

std::uint32_t SyntheticScan::messages(const Fan& fan) {
  return (fan.azimuths + kColumnsOfMessage - 1) / kColumnsOfMessage;
}

std::span<const std::byte> SyntheticScan::write(const Fan& fan, std::uint32_t sensor,
                                                std::uint32_t scan, std::uint32_t message) {
  const std::uint32_t first = message * kColumnsOfMessage;
  const std::uint32_t end = std::min(first + kColumnsOfMessage, fan.azimuths);
  tools::Random random(1 + sensor, std::uint64_t{scan} * kMostMessages + message);
  wire::ByteWriter out(bytes_);
  tools::write_lux_head({.device_id = static_cast<std::uint8_t>(sensor),
                         .scan_number = static_cast<std::uint16_t>(scan),
                         .start_ticks = angle_of(fan, first),
                         .end_ticks = angle_of(fan, std::min(end, fan.azimuths - 1))},
                        (end - first) * kLayers, out);
  for (std::uint32_t column = first; column < end; ++column) {
    write_column(fan, column, random, out);
  }
  require(out.ok());
  return out.written();
}

}  // namespace iog::lab
