// A buffer descriptor of the GEM's DMA with 64-bit addresses consists of four words (UG1085,
// "Receive buffer descriptor entry", "Transmit buffer descriptor entry").
#pragma once

#include <cstddef>
#include <cstdint>

#include "machine.hpp"
#include "memory/uncached_memory.hpp"

namespace iog::zcu102 {

// UG1087 (receive_q_ptr, transmit_q_ptr) requires alignment to 64 bits.
struct alignas(16) Descriptor {
  std::uint32_t address;  // low half; for reception, its lowest bits are wrap and owner
  std::uint32_t control;
  std::uint32_t address_high;
  std::uint32_t unused;
};
static_assert(sizeof(Descriptor) == 16);

namespace receive_flag {
// In `address`.
inline constexpr std::uint32_t kOurs = 1u << 0;
inline constexpr std::uint32_t kWrap = 1u << 1;
// In `control`.
inline constexpr std::uint32_t kLength = 0x1fff;
inline constexpr std::uint32_t kFirst = 1u << 14;
inline constexpr std::uint32_t kLast = 1u << 15;
}  // namespace receive_flag

namespace transmit_flag {
// In `control`.
inline constexpr std::uint32_t kLength = 0x3fff;
inline constexpr std::uint32_t kLast = 1u << 15;
inline constexpr std::uint32_t kWrap = 1u << 30;
inline constexpr std::uint32_t kOurs = 1u << 31;
}  // namespace transmit_flag

// The descriptor format for rings.hpp. All memory is below 4 GiB.
struct DescriptorFormat {
  using Descriptor = zcu102::Descriptor;
  using Memory = UncachedMemory;
  // Two fast lidars send about 3000 frames per second, so the ring holds the frames of a third of a
  // second. In QEMU, all frames that wait for a full ring are lost (gem.cpp).
  static constexpr std::size_t kReceiveFrames = 1024;
  // The longest frame has 1518 bytes, and the controller counts in units of 64 bytes.
  static constexpr std::size_t kReceiveBytes = 1536;

  static void place(Descriptor& descriptor, std::uint32_t /*buffer*/) {
    machine::store(descriptor.address_high, std::uint32_t{0});
  }
  static void empty(Descriptor& descriptor) {
    machine::store(descriptor.control, std::uint32_t{0});
  }
  static void give(Descriptor& descriptor, std::uint32_t buffer, bool is_last) {
    machine::store(descriptor.address, buffer | (is_last ? receive_flag::kWrap : 0));
  }
  static bool is_filled(const Descriptor& descriptor) {
    return (machine::load(descriptor.address) & receive_flag::kOurs) != 0;
  }

  static void place_free(Descriptor& descriptor, std::uint32_t buffer, bool is_last) {
    machine::store(descriptor.control, transmit_flag::kOurs | (is_last ? transmit_flag::kWrap : 0));
    machine::store(descriptor.address, buffer);
    machine::store(descriptor.address_high, std::uint32_t{0});
  }
  static void set_length(Descriptor& descriptor, std::size_t bytes) {
    const std::uint32_t kept = machine::load(descriptor.control) & transmit_flag::kWrap;
    machine::store(descriptor.control,
                   transmit_flag::kOurs | kept | static_cast<std::uint32_t>(bytes));
  }
  static void send(Descriptor& descriptor) {
    const std::uint32_t kept =
        machine::load(descriptor.control) & (transmit_flag::kWrap | transmit_flag::kLength);
    machine::store(descriptor.control, transmit_flag::kLast | kept);
  }
  static bool is_sent(const Descriptor& descriptor) {
    return (machine::load(descriptor.control) & transmit_flag::kOurs) != 0;
  }
};

}  // namespace iog::zcu102
