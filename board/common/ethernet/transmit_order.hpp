// Which buffer of a transmit ring is whose.
//
//      sent                in flight            queued           free
//   ... free | oldest_in_flight .... | oldest_queued ... | next ... free
//
// A buffer is free, then queued (committed, still ours), then in flight (the controller's), then
// free.
#pragma once

#include <cstddef>
#include <cstdint>

namespace iog::board {

class TransmitOrder {
 public:
  explicit TransmitOrder(std::size_t size) : size_(size) {}

  // All buffers are free; what was queued or in flight is forgotten.
  void start() { next_ = queued_ = in_flight_ = 0; }

  std::size_t room() const { return size_ - queued_ - in_flight_; }
  std::size_t queued() const { return queued_; }
  std::size_t in_flight() const { return in_flight_; }
  // Frames that have left since the ring was made; wraps.
  std::uint32_t sent() const { return sent_; }

  // The first free one, unless there is none.
  std::size_t next() const { return next_; }
  std::size_t oldest_queued() const { return after(next_, size_ - queued_); }
  std::size_t oldest_in_flight() const { return after(oldest_queued(), size_ - in_flight_); }

  // The buffers named above have become queued, in flight, free.
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
  // index < size and steps <= size; the Cortex-A9 has no division.
  std::size_t after(std::size_t index, std::size_t steps) const {
    const std::size_t sum = index + steps;
    return sum >= size_ ? sum - size_ : sum;
  }

  std::size_t size_;
  std::size_t next_ = 0;
  std::size_t queued_ = 0;     // counted back from next_
  std::size_t in_flight_ = 0;  // counted back from the queued ones
  std::uint32_t sent_ = 0;
};

}  // namespace iog::board
