// A packet as its format's decoder takes it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "lidar/formats.hpp"
#include "lidar/unit.hpp"

namespace iog::lidar {

struct Decoded {
  Decoded(std::span<const std::byte> bytes, Format format, const Unit& unit = {});

  DecodeStatus status;
  PacketInfo info;
  std::vector<ScanPoint> points;  // of a sound packet
};

}  // namespace iog::lidar
