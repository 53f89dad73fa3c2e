#include "tools/formats/points/points_writer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "lidar/points.hpp"
#include "require/require.hpp"
#include "tools/formats/points/turn_sectors.hpp"
#include "wire/byte_writer.hpp"

namespace iog::tools {
namespace {

using lidar::PointsPacket;

constexpr double kDegrees = 180 / std::numbers::pi;

std::uint16_t offset_of(std::uint32_t after_us) {
  constexpr std::uint32_t kMost = std::numeric_limits<std::uint16_t>::max();
  return static_cast<std::uint16_t>(std::min(after_us / PointsPacket::kOffsetUs, kMost));
}

}  // namespace

PointsDatagram datagram_of(const PointsScan& scan, std::size_t number, std::size_t datagrams,
                           std::span<const WirePoint> points, std::optional<PointsSector> sector) {
  const auto [first, last] = std::ranges::minmax_element(points, {}, &WirePoint::after_us);
  const std::uint32_t first_us = points.empty() ? 0 : first->after_us;
  PointsDatagram datagram{.last_us = scan.time_us + (points.empty() ? 0 : last->after_us)};
  datagram.bytes.resize(PointsPacket::kHeadBytes + PointsPacket::kPointBytes * points.size());
  wire::ByteWriter out(datagram.bytes);
  out.u32_le(PointsPacket::kMagic);
  out.u8(PointsPacket::kVersion);
  out.u8(static_cast<std::uint8_t>((sector ? 0 : PointsPacket::kIsShare) |
                                   (scan.are_places ? PointsPacket::kArePlaces : 0)));
  out.u16_le(static_cast<std::uint16_t>(points.size()));
  out.u32_le(scan.number);
  out.u16_le(static_cast<std::uint16_t>(number));
  out.u16_le(static_cast<std::uint16_t>(datagrams));
  out.u64_le(scan.time_us + first_us);
  out.u32_le(sector ? sector->begin : scan.sector_begin);
  out.u32_le(sector ? sector->width : scan.sector_width);
  for (const WirePoint& point : points) {
    out.u32_le(static_cast<std::uint32_t>(point.first));
    out.u32_le(static_cast<std::uint32_t>(point.second));
    out.u32_le(static_cast<std::uint32_t>(point.third));
    out.u16_le(offset_of(point.after_us - first_us));
    out.u8(point.flags);
    out.u8(0);
  }
  require(out.ok());
  return datagram;
}

std::vector<PointsDatagram> datagrams_of(const PointsScan& scan) {
  const std::size_t most = PointsPacket::kMostPoints;
  const std::size_t count = std::max<std::size_t>((scan.points.size() + most - 1) / most, 1);
  require(count <= std::numeric_limits<std::uint16_t>::max());
  const std::vector<PointsSector> sectors =
      sectors_of_scan(scan.points, most, {scan.sector_begin, scan.sector_width});
  std::size_t apart = sectors.empty() ? (3 * count + 7) / 8 : 1;
  while (std::gcd(apart, count) > 1) {
    ++apart;
  }
  std::vector<PointsDatagram> datagrams;
  auto rest = std::span(scan.points);
  for (std::size_t number = 0; number < count; ++number) {
    const auto its = rest.first(std::min(most, rest.size()));
    datagrams.push_back(
        datagram_of(scan, number * apart % count, count, its,
                    sectors.empty() ? std::nullopt : std::optional(sectors[number])));
    rest = rest.subspan(its.size());
  }
  return datagrams;
}

WirePoint direction_of(double x_m, double y_m, double z_m) {
  const double flat_m = std::hypot(x_m, y_m);
  const double elevation = std::atan2(z_m, flat_m) * kDegrees * PointsPacket::kPartsPerDegree;
  const double range_mm =
      std::min<double>(std::round(std::hypot(flat_m, z_m) * 1000), lidar::kMaxRangeMm);
  return {.first = azimuth_parts(std::atan2(y_m, x_m) * kDegrees),
          .second = static_cast<std::int32_t>(std::lround(elevation)),
          .third = static_cast<std::int32_t>(range_mm)};
}

std::int32_t azimuth_parts(double degrees) {
  constexpr std::int64_t kTurn = PointsPacket::kPartsPerTurn;
  const std::int64_t parts = std::llround(degrees * PointsPacket::kPartsPerDegree) % kTurn;
  return static_cast<std::int32_t>(parts < 0 ? parts + kTurn : parts);
}

}  // namespace iog::tools
