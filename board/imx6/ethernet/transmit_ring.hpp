// The ring of buffers that the program fills and the controller sends. It knows ownership and
// order (transmit_order.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "board/common/ethernet/transmit_order.hpp"
#include "ethernet/descriptor.hpp"

namespace iog::imx6 {

class TransmitRing {
 public:
  // 1514 bytes of the longest frame, rounded up to whole 64-byte bursts.
  static constexpr std::size_t kBufferBytes = 1536;

  // One buffer of kBufferBytes for each descriptor.
  TransmitRing(std::span<Descriptor> descriptors, std::span<std::byte> buffers, L2Cache& cache)
      : descriptors_(descriptors), buffers_(buffers), cache_(cache), order_(descriptors.size()) {}

  // All buffers are free; what was queued or in flight is forgotten.
  void start();

  // What the controller is told (TDSR).
  std::uint32_t bus_address() const { return machine::bus_address(descriptors_.front()); }

  std::size_t room() const { return order_.room(); }
  bool full() const { return room() == 0; }
  std::size_t queued() const { return order_.queued(); }
  std::size_t in_flight() const { return order_.in_flight(); }
  std::uint32_t sent() const { return order_.sent(); }

  // The buffer to fill next. Only while not full().
  std::span<std::byte> buffer() const {
    return buffers_.subspan(order_.next() * kBufferBytes, kBufferBytes);
  }

  // Queues the first `bytes` of buffer().
  void commit(std::size_t bytes);

  // Hands at most `frames` queued buffers to the controller, oldest first; returns how many. The
  // caller wakes the controller.
  std::size_t hand_over_queued(std::size_t frames);

  // Takes back what has been sent.
  void reclaim();

 private:
  std::span<Descriptor> descriptors_;
  std::span<std::byte> buffers_;
  L2Cache& cache_;
  board::TransmitOrder order_;
};

}  // namespace iog::imx6
