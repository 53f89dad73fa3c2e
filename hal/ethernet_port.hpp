// Hardware interface for an Ethernet port, which sends and receives whole frames and never blocks.
//
// A frame consists of destination, source, type and payload, without preamble and FCS.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace iog::hal {

// The numbers of frames received, sent and lost since the port was opened. Every counter wraps
// around.
struct PortCounters {
  std::uint32_t received = 0;        // good frames handed to the caller
  std::uint32_t receive_errors = 0;  // bad frames according to the controller: CRC, length, overrun
  std::uint32_t oversized = 0;       // dropped frames that were longer than one receive buffer
  std::uint32_t sent = 0;            // frames committed for sending
  std::uint32_t send_refused = 0;    // calls of acquire() while the transmit ring was full
  std::uint32_t receive_overflows = 0;  // frames for which the controller had no free buffer
  std::uint32_t restarts = 0;           // times that pump() restarted the controller
  std::uint32_t lost_received = 0;      // buffers of received frames lost in restarts
  std::uint32_t lost_unsent = 0;        // sent or queued frames lost in restarts

  // The names of the counters in the stream (stream/target_table.hpp).
  static constexpr auto kNames =
      std::to_array<std::string_view>({"port received", "receive errors", "oversized", "port sent",
                                       "port refused", "port without room", "port restarts",
                                       "received lost by restarts", "unsent lost by restarts"});
};

// Shows whether a port is alive.
struct PortLife {
  std::uint32_t moved = 0;  // frames sent or received since opening, including bad ones; wraps
  bool is_excused = true;   // there is no link, or the port can receive and has nothing to send
};

// `receive()` returns the oldest received frame, or an empty span. The frame remains valid and
// unchanged until release(). `release()` frees the frame that receive() returned. Call this
// function only after receive() has returned a frame. `acquire()` returns a free transmit buffer of
// at least 1514 bytes. If the ring is full, acquire() returns an empty span and counts the failure.
// A second call before commit() returns the same buffer. `room()` returns the minimum number of
// buffers that acquire() can return now. `commit(n)` queues the first n bytes of the acquired
// buffer, 14 <= n <= 1514. `pump()` passes a bounded number of queued frames to the controller.
// Call this function once per pass of the loop. `pump()` may restart a stopped controller, but not
// while a buffer is acquired.
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
