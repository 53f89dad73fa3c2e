// Which sector each datagram of a turn covers, for points in the order in which a unit turned.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tools/formats/points/points_writer.hpp"

namespace iog::tools {

// The sectors of a scan's datagrams, with `most` points each; clockwise and counter-clockwise
// alike. The border of two datagrams lies midway between their mean azimuths, and each sector
// contains all points of its datagram. The first and the last sector meet, because a unit that
// turns scans the whole turn. Empty if the points are not in the order of a turn.
// clients/python/iogrid/points.py has the same rule.
[[nodiscard]] std::vector<PointsSector> sectors_of_turn(std::span<const WirePoint> points,
                                                        std::size_t most);

}  // namespace iog::tools
