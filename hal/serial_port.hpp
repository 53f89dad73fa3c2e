// The seam to a serial port: bytes out, nothing blocks, nothing comes in.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::hal {

// bytes_per_second():  what the link carries.
// free_bytes():        how many bytes write() takes now.
// write(bytes):        queues them, at most free_bytes().
// pump():              hands the transmitter what it has room for, a bounded number of bytes. As
//                      often as the link would run dry otherwise; write() does it, too.
template <typename Port>
concept SerialPort = requires(Port& port, const Port& view, std::span<const std::byte> bytes) {
  { view.bytes_per_second() } -> std::same_as<std::uint32_t>;
  { view.free_bytes() } -> std::same_as<std::size_t>;
  { port.write(bytes) } -> std::same_as<void>;
  { port.pump() } -> std::same_as<void>;
};

}  // namespace iog::hal
