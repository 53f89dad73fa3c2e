// A received UDP datagram, with its source, its destination port and its payload.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::intake {

struct Datagram {
  std::uint32_t source_ipv4 = 0;
  std::uint16_t destination_port = 0;
  std::span<const std::byte> payload;
};

}  // namespace iog::intake
