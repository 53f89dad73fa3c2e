// A UDP datagram as a capture holds it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace iog::tools {

struct Endpoint {
  std::uint32_t ipv4 = 0;  // 10.0.2.15 is 0x0A00020F
  std::uint16_t port = 0;
};

struct CapturedDatagram {
  std::uint64_t time_us = 0;  // since 1970-01-01 UTC
  Endpoint source;
  Endpoint destination;
  std::vector<std::byte> payload;
};

}  // namespace iog::tools
