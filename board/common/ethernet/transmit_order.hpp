// Tracks the owners of the buffers in a transmit ring.
//
//      sent                in flight            queued           free
//   ... free | oldest_in_flight .... | oldest_queued ... | next ... free
//
// A buffer is first free, then queued (committed but still owned by the driver), then in flight
// (owned by the controller), and then free again.
#pragma once

#include <cstddef>
#include <cstdint>

namespace iog::board {

class TransmitOrder {
 public:
  explicit TransmitOrder(std::size_t size) : size_(size) {}

  // Frees all buffers, including buffers that were queued or in flight.
  void start() { next_ = queued_ = in_flight_ = 0; }

  std::size_t room() const { return size_ - queued_ - in_flight_; }
  std::size_t queued() const { return queued_; }
  std::size_t in_flight() const { return in_flight_; }
  // Returns the number of frames sent since the ring was constructed. The number wraps around.
  std::uint32_t sent() const { return sent_; }

  // Returns the first free buffer. At least one buffer must be free.
  std::size_t next() const { return next_; }
  std::size_t oldest_queued() const { return after(next_, size_ - queued_); }
  std::size_t oldest_in_flight() const { return after(oldest_queued(), size_ - in_flight_); }

  // These functions make the next buffer queued, in flight or free.
  void commit() {
    next_ = after(next_, 1);
    ++queued_;
  }
  void hand_over() {
    --queued_;
    ++in_flight_;
  }
  void reclaim() {
    --in_flight_;
    ++sent_;
  }

 private:
  // `index` must be less than the size of the ring, and `steps` must be at most this size. The
  // function needs no division, which the Cortex-A9 does not have.
  std::size_t after(std::size_t index, std::size_t steps) const {
    const std::size_t sum = index + steps;
    return sum >= size_ ? sum - size_ : sum;
  }

  std::size_t size_;
  std::size_t next_ = 0;
  std::size_t queued_ = 0;     // counted back from next_
  std::size_t in_flight_ = 0;  // counted back from the queued buffers
  std::uint32_t sent_ = 0;
};

}  // namespace iog::board
