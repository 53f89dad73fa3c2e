// The CRC-32 that identifies grids and cars.
#pragma once

#include "checksum/crc32.hpp"

namespace iog::stream {

using checksum::Crc32;

}  // namespace iog::stream
