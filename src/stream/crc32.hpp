// The CRCs of the stream's content.
#pragma once

#include "checksum/crc32.hpp"

namespace iog::stream {

// Identifies runs, cars and datagrams.
using checksum::Crc32;

// Identifies a grid by its cells.
using GridCrc32 = checksum::Crc32;

}  // namespace iog::stream
