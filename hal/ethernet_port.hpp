// The seam to an Ethernet controller: whole frames in, whole frames out, nothing blocks.
//
// A frame is destination, source, type and payload, without preamble and without FCS.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace iog::hal {

// What a port has seen and lost since it was opened. Every counter wraps.
struct PortCounters {
  std::uint32_t received = 0;           // good frames handed to the caller
  std::uint32_t receive_errors = 0;     // frames the controller marked bad: CRC, length, overrun
  std::uint32_t oversized = 0;          // frames longer than one receive buffer, dropped
  std::uint32_t sent = 0;               // frames committed for sending
  std::uint32_t send_refused = 0;       // acquire() found the transmit ring full
  std::uint32_t receive_overflows = 0;  // frames that the controller had no room for
  std::uint32_t restarts = 0;           // pump() started the controller anew
  std::uint32_t lost_received = 0;      // buffers of frames that had come and were lost by that
  std::uint32_t lost_unsent = 0;        // frames that were sent or queued, and lost by that

  // In the stream (stream/target_table.hpp).
  static constexpr auto kNames =
      std::to_array<std::string_view>({"port received", "receive errors", "oversized", "port sent",
                                       "port refused", "port without room", "port restarts",
                                       "received lost by restarts", "unsent lost by restarts"});
};

// Whether a port lives.
struct PortLife {
  std::uint32_t moved = 0;  // frames that came, bad ones too, or left since it was opened; wraps
  bool is_excused = true;   // that none moves: there is no link, or it can receive and none waits
};

// receive():  the oldest frame that has arrived, empty if there is none. The view stays valid and
//             the same frame is returned until release().
// release():  done with that frame. Only after a non-empty receive().
// acquire():  a free transmit buffer of at least 1514 bytes, empty when the ring is full (counted).
//             Calling it again before commit() returns the same buffer.
// room():     how many buffers are free for acquire() now, at least.
// commit(n):  queues the first n bytes of the acquired buffer, 14 <= n <= 1514.
// pump():     hands a bounded number of queued frames to the controller. Once per pass of the loop.
//             May start a controller anew that has stopped, but not while a buffer is acquired.
template <typename Port>
concept EthernetPort = requires(Port& port, const Port& view, std::size_t frame_bytes) {
  { port.receive() } -> std::same_as<std::span<const std::byte>>;
  { port.release() } -> std::same_as<void>;
  { port.acquire() } -> std::same_as<std::span<std::byte>>;
  { port.room() } -> std::same_as<std::size_t>;
  { port.commit(frame_bytes) } -> std::same_as<void>;
  { port.pump() } -> std::same_as<void>;
  { view.counters() } -> std::convertible_to<PortCounters>;
  { view.life() } -> std::same_as<PortLife>;
};

}  // namespace iog::hal
