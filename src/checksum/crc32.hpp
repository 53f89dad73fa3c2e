// The two CRC-32 of this project, each in the way that is fast on the machine at hand.
#pragma once

#include <type_traits>

#include "checksum/product_crc32.hpp"
#include "checksum/products.hpp"
#include "checksum/reflected_crc32.hpp"

namespace iog::checksum {

// CRC-32/ISO-HDLC, as in zlib: check value of "123456789" 0xCBF43926. It names grids and vehicles:
// any tool can compute it.
using Crc32 =
    std::conditional_t<kHasProducts, ProductCrc32<0x04C11DB7>, ReflectedCrc32<0x04C11DB7, 8>>;

// CRC-32/AUTOSAR: check value of "123456789" 0x1697D06A (AUTOSAR SWS CRCLibrary, CRC-32/P4).
using Crc32P4 =
    std::conditional_t<kHasProducts, ProductCrc32<0xF4ACFB13>, ReflectedCrc32<0xF4ACFB13, 8>>;

}  // namespace iog::checksum
