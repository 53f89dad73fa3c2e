// Defines the receive ring, whose buffers the controller fills, and the transmit ring, whose
// buffers the controller sends. The rings manage the ownership and the order of buffers, but do not
// interpret frames.
//
// Format (ethernet/descriptor.hpp of the board) defines the content of a Descriptor, and
// Format::Memory drains stores to memory. To hand over a descriptor, first drain all earlier
// stores, including the buffer and the buffer's length. Then store the word with the owner bit.
// Before waking the controller, drain stores once more, so that the controller reads the new owner
// bit.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "board/common/ethernet/transmit_order.hpp"
#include "machine.hpp"

namespace iog::board {

// Descriptors with one buffer of kBytes each.
template <typename Format, std::size_t kBytes>
class Ring {
 public:
  using Descriptor = typename Format::Descriptor;
  using Memory = typename Format::Memory;
  static constexpr std::size_t kBufferBytes = kBytes;

  // Returns the address of the ring for the controller.
  std::uint32_t bus_address() const { return machine::bus_address(descriptors_.front()); }

 protected:
  Ring(std::span<Descriptor> descriptors, std::span<std::byte> buffers, Memory& memory)
      : descriptors_(descriptors), buffers_(buffers), memory_(memory) {}

  std::span<std::byte> buffer(std::size_t index) const {
    return buffers_.subspan(index * kBytes, kBytes);
  }
  std::uint32_t buffer_address(std::size_t index) const {
    return machine::bus_address(buffer(index).front());
  }
  bool is_last(std::size_t index) const { return index + 1 == descriptors_.size(); }

  std::span<Descriptor> descriptors_;
  std::span<std::byte> buffers_;
  Memory& memory_;
};

template <typename Format>
class ReceiveRing : public Ring<Format, Format::kReceiveBytes> {
 public:
  using Base = Ring<Format, Format::kReceiveBytes>;
  using typename Base::Descriptor;

  ReceiveRing(std::span<Descriptor> descriptors, std::span<std::byte> buffers,
              typename Base::Memory& memory)
      : Base(descriptors, buffers, memory) {}

  // Gives all buffers to the controller, and begins with the first buffer.
  void start() {
    for (next_ = 0; next_ < this->descriptors_.size(); ++next_) {
      Format::place(this->descriptors_[next_], this->buffer_address(next_));
      give();
    }
    next_ = 0;
    recycled_ = 0;
    this->memory_.drain_stores();
  }

  // Returns the number of buffers that the controller has filled and that were not recycled.
  std::size_t waiting() const {
    return static_cast<std::size_t>(std::ranges::count_if(this->descriptors_, Format::is_filled));
  }

  // Returns true if the controller has filled the next buffer.
  bool filled() const {
    if (!Format::is_filled(descriptor())) {
      return false;
    }
    // The buffer and its length must not be read before the owner bit.
    machine::barrier();
    return true;
  }

  // These functions return the next descriptor and the next buffer. Both are valid while filled()
  // returns true.
  const Descriptor& descriptor() const { return this->descriptors_[next_]; }
  std::span<std::byte> buffer() const { return Base::buffer(next_); }

  // Returns true if the ring may have been full, because all buffers were filled in a row. Call
  // this function after filled() has returned false.
  bool was_full() { return std::exchange(recycled_, 0U) >= this->descriptors_.size(); }

  // Returns the next buffer to the controller and advances.
  void recycle() {
    give();
    ++recycled_;
    next_ = this->is_last(next_) ? 0 : next_ + 1;
  }

 private:
  void give() {
    Descriptor& descriptor = this->descriptors_[next_];
    Format::empty(descriptor);
    this->memory_.drain_stores();
    Format::give(descriptor, this->buffer_address(next_), this->is_last(next_));
  }

  std::size_t next_ = 0;
  std::size_t recycled_ = 0;  // since filled() last found none
};

// The length of the longest frame, 1514 bytes, rounded up to whole 64-byte bursts.
inline constexpr std::size_t kTransmitBytes = 1536;

template <typename Format>
class TransmitRing : public Ring<Format, kTransmitBytes> {
 public:
  using Base = Ring<Format, kTransmitBytes>;
  using typename Base::Descriptor;

  TransmitRing(std::span<Descriptor> descriptors, std::span<std::byte> buffers,
               typename Base::Memory& memory)
      : Base(descriptors, buffers, memory), order_(descriptors.size()) {}

  // Frees all buffers, including buffers that were queued or in flight.
  void start() {
    for (std::size_t index = 0; index < this->descriptors_.size(); ++index) {
      Format::place_free(this->descriptors_[index], this->buffer_address(index),
                         this->is_last(index));
    }
    order_.start();
    this->memory_.drain_stores();
  }

  const TransmitOrder& order() const { return order_; }

  // Returns the buffer to fill next. The ring must have room.
  std::span<std::byte> buffer() const { return Base::buffer(order_.next()); }

  // Queues the first `bytes` of buffer(). `hand_over_queued()` sets the owner bit.
  void commit(std::size_t bytes) {
    Format::set_length(this->descriptors_[order_.next()], bytes);
    order_.commit();
  }

  // Hands at most `frames` queued buffers to the controller, oldest first, and returns the number
  // of these buffers. The caller must wake the controller.
  std::size_t hand_over_queued(std::size_t frames) {
    const std::size_t handed = std::min(frames, order_.queued());
    // One drain is enough for all frames, because it precedes the first owner bit.
    if (handed != 0) {
      this->memory_.drain_stores();
    }
    for (std::size_t count = 0; count < handed; ++count) {
      Format::send(this->descriptors_[order_.oldest_queued()]);
      order_.hand_over();
    }
    return handed;
  }

  // Frees the buffers that have been sent.
  void reclaim() {
    while (order_.in_flight() != 0 &&
           Format::is_sent(this->descriptors_[order_.oldest_in_flight()])) {
      order_.reclaim();
    }
  }

 private:
  TransmitOrder order_;
};

}  // namespace iog::board
