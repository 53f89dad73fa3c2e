// The ring of buffers that the controller fills. It knows ownership and order, and nothing about
// frames.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "ethernet/descriptor.hpp"

namespace iog::imx6 {

class ReceiveRing {
 public:
  // 2048 bytes hold the longest frame (1518) and keep every buffer on a 64-byte burst.
  static constexpr std::size_t kBufferBytes = 2048;
  // What MRBR is told: below 2048 and a multiple of 16, because without enhanced descriptors a
  // receive buffer size of 2 KiB sends the DMA into a runaway (FreeBSD if_ffec.c,
  // ffec_init_locked).
  static constexpr std::uint32_t kUsableBytes = 2032;

  // One buffer of kBufferBytes for each descriptor.
  ReceiveRing(std::span<Descriptor> descriptors, std::span<std::byte> buffers, L2Cache& cache)
      : descriptors_(descriptors), buffers_(buffers), cache_(cache) {}

  // Gives all buffers to the controller; the next one is the first.
  void start();

  // What the controller is told (RDSR).
  std::uint32_t bus_address() const { return machine::bus_address(descriptors_.front()); }

  // How many buffers it has filled that were not recycled.
  std::size_t waiting() const;

  // Whether the controller has filled the next buffer.
  bool filled() const;

  // Of the next buffer, while filled(): its flags, the length in its descriptor, its bytes.
  std::uint16_t flags() const { return machine::load(next().flags); }
  std::uint16_t length() const { return machine::load(next().length); }
  std::span<std::byte> buffer() const;

  // Gives the next buffer back and goes on to the one after it.
  void recycle();

 private:
  Descriptor& next() const { return descriptors_[next_]; }
  static bool is_filled(const Descriptor& descriptor) {
    return (machine::load(descriptor.flags) & receive_flag::kEmpty) == 0;
  }
  std::uint16_t wrap() const;

  std::span<Descriptor> descriptors_;
  std::span<std::byte> buffers_;
  L2Cache& cache_;
  std::size_t next_ = 0;
};

}  // namespace iog::imx6
