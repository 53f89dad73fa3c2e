// A UDP datagram on its way in: where it comes from, where it was sent to, and what it carries.
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
