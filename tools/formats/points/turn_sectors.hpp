// Which sector each datagram of a scan covers, for points in the order of their azimuths.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tools/formats/points/points_writer.hpp"

namespace iog::tools {

// The sectors of a scan's datagrams, with `most` points each; clockwise and counter-clockwise
// alike. The border of two datagrams lies midway between their mean azimuths, and each sector
// contains all points of its datagram that lie in the field. The outer sectors end with the field
// that was scanned or, in a whole turn, meet. Empty if the points are not in order.
// clients/python/iogrid/points.py has the same rule.
[[nodiscard]] std::vector<PointsSector> sectors_of_scan(std::span<const WirePoint> points,
                                                        std::size_t most,
                                                        const PointsSector& field);

}  // namespace iog::tools
