// Scans as datagrams of points (docs/spec.md, section 1.2.6).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace iog::tools {

// A point as on the wire: azimuth, elevation and range, or x, y and z.
struct WirePoint {
  std::int32_t first = 0;
  std::int32_t second = 0;
  std::int32_t third = 0;
  std::uint32_t after_us = 0;  // the scan's time
  std::uint8_t flags = 0;      // lidar::PointsPacket's
};

// What was scanned, with or without returns, in 3,200ths of a degree: counter-clockwise from its
// beginning.
struct PointsSector {
  std::uint32_t begin = 0;
  std::uint32_t width = 0;
};

struct PointsScan {
  std::uint32_t number = 0;
  std::uint64_t time_us = 0;
  bool are_places = false;
  std::uint32_t sector_begin = 0;
  std::uint32_t sector_width = 0;
  std::vector<WirePoint> points{};
};

struct PointsDatagram {
  std::uint64_t last_us = 0;  // of its points
  std::vector<std::byte> bytes{};
};

// One of them: with these points of the scan, at most as many as it may have. Without a sector of
// its own, it has its share of the scan's.
[[nodiscard]] PointsDatagram datagram_of(const PointsScan& scan, std::size_t number,
                                         std::size_t datagrams, std::span<const WirePoint> points,
                                         std::optional<PointsSector> sector = std::nullopt);

// All points in their order. One datagram if there is no point. If the points are in the order of
// their azimuths, datagrams have sectors of their own (turn_sectors.hpp). Otherwise, the numbers of
// successive datagrams, and so their shares of the sector, are far apart: lost ones thin out all
// directions, and not those of one share.
[[nodiscard]] std::vector<PointsDatagram> datagrams_of(const PointsScan& scan);

// The direction of a place in metres, and its range in millimetres, each rounded to the nearest.
[[nodiscard]] WirePoint direction_of(double x_m, double y_m, double z_m);

// How many 3,200ths of a degree so many degrees are, 0 to less than a turn.
[[nodiscard]] std::int32_t azimuth_parts(double degrees);

}  // namespace iog::tools
