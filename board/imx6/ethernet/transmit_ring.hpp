// The ring of buffers that the program fills and the controller sends. It knows ownership and
// order.
//
//      done                in flight            queued           free
//   ... free | oldest_ ............. | handed ............ | next_ ... free
//
// A buffer is free, then queued (committed, still ours), then in flight (the controller's), then
// free.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "ethernet/descriptor.hpp"

namespace iog::imx6 {

class TransmitRing {
 public:
  // 1514 bytes of the longest frame, rounded up to whole 64-byte bursts.
  static constexpr std::size_t kBufferBytes = 1536;

  // One buffer of kBufferBytes for each descriptor.
  TransmitRing(std::span<Descriptor> descriptors, std::span<std::byte> buffers, L2Cache& cache)
      : descriptors_(descriptors), buffers_(buffers), cache_(cache) {}

  // All buffers are free; what was queued or in flight is forgotten.
  void start();

  // What the controller is told (TDSR).
  std::uint32_t bus_address() const { return machine::bus_address(descriptors_.front()); }

  std::size_t room() const { return descriptors_.size() - queued_ - in_flight_; }
  bool full() const { return room() == 0; }
  std::size_t queued() const { return queued_; }
  std::size_t in_flight() const { return in_flight_; }
  // Frames that have left since the ring was made; wraps.
  std::uint32_t sent() const { return sent_; }

  // The buffer to fill next. Only while not full().
  std::span<std::byte> buffer() const {
    return buffers_.subspan(next_ * kBufferBytes, kBufferBytes);
  }

  // Queues the first `bytes` of buffer().
  void commit(std::size_t bytes);

  // Hands at most `frames` queued buffers to the controller, oldest first; returns how many. The
  // caller wakes the controller.
  std::size_t hand_over_queued(std::size_t frames);

  // Takes back what has been sent.
  void reclaim();

 private:
  std::size_t after(std::size_t index, std::size_t steps) const;

  std::span<Descriptor> descriptors_;
  std::span<std::byte> buffers_;
  L2Cache& cache_;
  std::size_t next_ = 0;       // the first free one, unless full
  std::size_t queued_ = 0;     // counted back from next_
  std::size_t in_flight_ = 0;  // counted back from the queued ones
  std::uint32_t sent_ = 0;
};

}  // namespace iog::imx6
