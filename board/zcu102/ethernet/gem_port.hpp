// The Ethernet controller GEM3 as a hal::EthernetPort, with its own uncached memory.
//
// Two rings of queue 0; queue 1 is parked. A received frame is copied once into cached memory and
// parsed there. When the receive ring is full the controller looks at it again only when NWCTRL is
// written, so the ring holds what comes while the loop is away.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/ethernet_port.hpp"
#include "health/guard.hpp"
#include "registers/gem.hpp"

namespace iog::zcu102 {

using MacAddress = std::array<std::uint8_t, 6>;

// With 64-bit addresses (UG1085, tables "Rx/Tx Buffer Descriptor Entry").
struct GemDescriptor {
  std::uint32_t address;
  std::uint32_t flags;
  std::uint32_t upper_address;
  std::uint32_t unused;
};

// Everything the controller's DMA touches, in the uncached region; guards stand between its parts.
struct GemMemory {
  static constexpr std::size_t kBufferBytes = 1536;
  static constexpr std::size_t kReceiveFrames = 1024;
  static constexpr std::size_t kTransmitFrames = 1024 + 64 + 64 + 256;  // as EnetMemory

  health::Guard below;
  alignas(64) std::array<GemDescriptor, kReceiveFrames> receive_descriptors;
  health::Guard behind_receive_descriptors;
  alignas(64) std::array<GemDescriptor, kTransmitFrames> transmit_descriptors;
  alignas(64) std::array<GemDescriptor, 2> parked;  // queue 1: receive, transmit
  health::Guard behind_transmit_descriptors;
  alignas(64) std::array<std::byte, kReceiveFrames * kBufferBytes> receive_buffers;
  health::Guard behind_receive_buffers;
  alignas(64) std::array<std::byte, kTransmitFrames * kBufferBytes> transmit_buffers;
  health::Guard behind_transmit_buffers;
};

// From low to high.
constexpr std::array<health::Guard*, 5> guards_of(GemMemory& memory) {
  return {&memory.below, &memory.behind_receive_descriptors, &memory.behind_transmit_descriptors,
          &memory.behind_receive_buffers, &memory.behind_transmit_buffers};
}

extern GemMemory gem_memory;  // NOLINT(bugprone-dynamic-static-initializers)

class GemPort {
 public:
  static constexpr std::size_t kMinFrameBytes = 14;
  static constexpr std::size_t kMaxFrameBytes = 1514;

  GemPort(GemRegisters& registers, GemMemory& memory) : registers_(registers), memory_(memory) {}

  // Starts receiving at the speed of the loader's link: 1 Gbit/s, full duplex.
  void start(const MacAddress& address);

  // From now on frames to this group of stations are received, too, and some to other groups.
  void join(const MacAddress& group);

  // hal::EthernetPort; see there.
  std::span<const std::byte> receive();
  void release() { frame_ = {}; }
  std::span<std::byte> acquire();
  std::size_t room() const { return memory_.transmit_descriptors.size() - in_flight_; }
  void commit(std::size_t frame_bytes);
  void pump();
  hal::PortCounters counters() const { return counters_; }
  hal::PortLife life() const;

  // Withdraws the wake-up request of the frames received so far. Poll the ring after it.
  void clear_event();

 private:
  void fill_rings();
  void reclaim();
  std::span<std::byte> transmit_buffer(std::size_t index);

  GemRegisters& registers_;
  GemMemory& memory_;
  hal::PortCounters counters_;
  std::size_t next_receive_ = 0;
  std::size_t next_transmit_ = 0;
  std::size_t oldest_in_flight_ = 0;
  std::size_t in_flight_ = 0;
  bool is_acquired_ = false;
  alignas(64) std::array<std::byte, GemMemory::kBufferBytes> copy_{};
  std::span<const std::byte> frame_;  // of copy_, until release()
};

}  // namespace iog::zcu102
