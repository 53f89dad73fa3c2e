// Hardware interface for a serial port that only sends and never blocks.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::hal {

// `bytes_per_second()` returns the data rate of the link.
// `free_bytes()` returns the number of bytes that write() accepts now.
// `write(bytes)` queues at most free_bytes() bytes.
// `pump()` passes a bounded number of bytes to the transmitter, until the transmitter is full. Call
// this function often enough that the link does not run idle. Each call of write() also calls
// pump().
template <typename Port>
concept SerialPort = requires(Port& port, const Port& view, std::span<const std::byte> bytes) {
  { view.bytes_per_second() } -> std::same_as<std::uint32_t>;
  { view.free_bytes() } -> std::same_as<std::size_t>;
  { port.write(bytes) } -> std::same_as<void>;
  { port.pump() } -> std::same_as<void>;
};

}  // namespace iog::hal
