// The ring of buffers that the program fills and the controller sends. It knows ownership and
// order (transmit_order.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "board/common/ethernet/transmit_order.hpp"
#include "ethernet/descriptor.hpp"

namespace iog::zcu102 {

class TransmitRing {
 public:
  // 1514 bytes of the longest frame, rounded up to whole 64-byte bursts.
  static constexpr std::size_t kBufferBytes = 1536;

  // One buffer of kBufferBytes for each descriptor.
  TransmitRing(std::span<Descriptor> descriptors, std::span<std::byte> buffers)
      : descriptors_(descriptors), buffers_(buffers), order_(descriptors.size()) {}

  // All buffers are free; what was queued or in flight is forgotten.
  void start();

  std::uint64_t bus_address() const { return machine::bus_address(descriptors_.front()); }
  const board::TransmitOrder& order() const { return order_; }

  // The buffer to fill next. Only while there is room.
  std::span<std::byte> buffer() const { return buffer(order_.next()); }

  // Queues the first `bytes` of buffer().
  void commit(std::size_t bytes);

  // Hands at most `frames` queued buffers to the controller, oldest first; returns how many. The
  // caller wakes the controller.
  std::size_t hand_over_queued(std::size_t frames);

  // Takes back what has been sent.
  void reclaim();

 private:
  std::span<std::byte> buffer(std::size_t index) const {
    return buffers_.subspan(index * kBufferBytes, kBufferBytes);
  }

  std::span<Descriptor> descriptors_;
  std::span<std::byte> buffers_;
  board::TransmitOrder order_;
};

}  // namespace iog::zcu102
