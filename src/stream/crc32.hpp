// The CRCs of the stream's content.
#pragma once

#include "checksum/crc32.hpp"

namespace iog::stream {

// Identifies runs, cars and datagrams.
using checksum::Crc32;

// Identifies a grid by its cells. It is the CRC of the E2E protection, so that one pass over a tile
// can serve both.
using GridCrc32 = checksum::Crc32P4;

}  // namespace iog::stream
