// The ring of buffers that the controller fills. It knows ownership and order, and nothing about
// frames.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "ethernet/descriptor.hpp"

namespace iog::zcu102 {

class ReceiveRing {
 public:
  // The longest frame is 1518 bytes; the controller counts in units of 64.
  static constexpr std::size_t kBufferBytes = 1536;

  // One buffer of kBufferBytes for each descriptor.
  ReceiveRing(std::span<Descriptor> descriptors, std::span<std::byte> buffers)
      : descriptors_(descriptors), buffers_(buffers) {}

  // Gives all buffers to the controller; the next one is the first.
  void start();

  std::uint64_t bus_address() const { return machine::bus_address(descriptors_.front()); }

  // How many buffers it has filled that were not recycled.
  std::size_t waiting() const;

  // Whether the controller has filled the next buffer.
  bool filled() const;

  // Of the next buffer, while filled().
  std::uint32_t control() const { return machine::load(next().control); }
  std::span<std::byte> buffer() const { return buffer(next_); }

  // Gives the next buffer back and goes on to the one after it.
  void recycle();

 private:
  Descriptor& next() const { return descriptors_[next_]; }
  std::span<std::byte> buffer(std::size_t index) const {
    return buffers_.subspan(index * kBufferBytes, kBufferBytes);
  }
  static bool is_filled(const Descriptor& descriptor) {
    return (machine::load(descriptor.address) & receive_flag::kOurs) != 0;
  }
  void give(std::size_t index);

  std::span<Descriptor> descriptors_;
  std::span<std::byte> buffers_;
  std::size_t next_ = 0;
};

}  // namespace iog::zcu102
