// Defines the CRCs used in the stream.
#pragma once

#include "checksum/crc32.hpp"

namespace iog::stream {

// Crc32 identifies runs, cars and datagrams.
using checksum::Crc32;

// GridCrc32 identifies a grid by its cells. The E2E protection uses the same CRC, so one pass over
// a tile can serve both purposes.
using GridCrc32 = checksum::Crc32P4;

}  // namespace iog::stream
