// The Ethernet controller as a hal::EthernetPort. It has its own memory, and it limits how fast
// frames leave (transmit_shaper.hpp).
//
// The controller's memory is uncached, because its DMA goes past the cache-coherent interconnect.
// So a received frame is copied once, in bursts, into cached memory, and its buffer goes back at
// once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "board/common/ethernet/link_monitor.hpp"
#include "board/common/ethernet/transmit_shaper.hpp"
#include "ethernet/phy.hpp"
#include "ethernet/receive_ring.hpp"
#include "ethernet/transmit_ring.hpp"
#include "hal/ethernet_port.hpp"
#include "health/guard.hpp"

namespace iog::zcu102 {

using MacAddress = std::array<std::uint8_t, 6>;

// Everything the controller's DMA touches. One of these, in the uncached region.
//
// Receive: 1024 frames. Two fast lidars send some 3000 frames a second, so this is a third of a
// second, and in QEMU a full ring loses all frames that wait behind it (gem_port.cpp).
// Transmit: as on the i.MX6: a complete grid of 1024 tiles, 64 other frames, 64 still in flight,
// and 256 for a subscriber's copies.
// Parked: one descriptor each for the unused queues of both directions. The GEM may read ahead
// behind a ring; what stands there it does not own.
struct GemMemory {
  static constexpr std::size_t kReceiveFrames = 1024;
  static constexpr std::size_t kTransmitFrames = 1024 + 64 + 64 + 256;
  static constexpr std::size_t kBudgetBytes = 4u << 20;

  health::Guard below;
  alignas(64) std::array<Descriptor, kReceiveFrames> receive_descriptors;
  health::Guard behind_receive_descriptors;
  alignas(64) std::array<Descriptor, kTransmitFrames> transmit_descriptors;
  alignas(64) std::array<Descriptor, 2> parked;
  health::Guard behind_transmit_descriptors;
  alignas(64) std::array<std::byte, kReceiveFrames * ReceiveRing::kBufferBytes> receive_buffers;
  health::Guard behind_receive_buffers;
  alignas(64) std::array<std::byte, kTransmitFrames * TransmitRing::kBufferBytes> transmit_buffers;
  health::Guard behind_transmit_buffers;
};
static_assert(sizeof(GemMemory) <= GemMemory::kBudgetBytes, "fits two blocks of 2 MiB");

// From low to high.
constexpr std::array<health::Guard*, 5> guards_of(GemMemory& memory) {
  return {&memory.below, &memory.behind_receive_descriptors, &memory.behind_transmit_descriptors,
          &memory.behind_receive_buffers, &memory.behind_transmit_buffers};
}

// The memory of the firmware's one controller, constinit where it is defined.
extern GemMemory gem_memory;  // NOLINT(bugprone-dynamic-static-initializers)

class GemPort {
 public:
  static constexpr std::size_t kMinFrameBytes = 14;
  static constexpr std::size_t kMaxFrameBytes = 1514;
  static constexpr std::size_t kFrameBursts =
      (kMaxFrameBytes + machine::kBurstBytes - 1) / machine::kBurstBytes;

  struct Rings {
    std::span<Descriptor> receive_descriptors;
    std::span<std::byte> receive_buffers;
    std::span<Descriptor> transmit_descriptors;
    std::span<std::byte> transmit_buffers;
    std::span<Descriptor, 2> parked;
  };
  using NowUs = std::uint64_t (*)();  // hal::Clock::now_us()

  GemPort(GemRegisters& registers, CrlApbRegisters& clocks, const Rings& rings, NowUs now_us)
      : registers_(registers),
        clocks_(clocks),
        now_us_(now_us),
        parked_(rings.parked),
        receive_ring_(rings.receive_descriptors, rings.receive_buffers),
        transmit_ring_(rings.transmit_descriptors, rings.transmit_buffers) {}

  GemPort(const GemPort&) = delete;  // the rings refer to each other's memory
  GemPort& operator=(const GemPort&) = delete;

  // Sets the controller up, finds the PHY, starts receiving. The loader has set up pads, and has
  // released the reset.
  void start(const MacAddress& address);

  // From now on frames to this group of stations are received, too, and some to other groups.
  void join(const MacAddress& group);

  // hal::EthernetPort; see there.
  std::span<const std::byte> receive();
  void release();
  std::span<std::byte> acquire();
  std::size_t room();
  void commit(std::size_t frame_bytes);
  void pump();
  hal::PortCounters counters() const { return counters_; }
  hal::PortLife life() const;

  // Withdraws the wake-up request of the frames received so far. Poll the rings after it.
  void clear_event();

  const Link& link() const { return link_monitor_.link(); }
  const phy::Identity& phy() const { return phy_; }

 private:
  void set_up(const Link& mode);
  void stop();
  void park_unused_queues();
  void set_rings();
  void set_address();
  void set_groups();
  void set_mode(const Link& mode);
  void run();
  bool must_start_anew(std::uint64_t now_us);
  bool is_stuck(std::uint64_t now_us);
  void start_anew(std::uint64_t now_us);
  void accept();
  void look_again();
  void collect_statistics();

  GemRegisters& registers_;
  CrlApbRegisters& clocks_;
  NowUs now_us_;
  std::span<Descriptor, 2> parked_;
  ReceiveRing receive_ring_;
  TransmitRing transmit_ring_;
  TransmitShaper shaper_;
  Mdio mdio_{registers_};
  LinkMonitor<Mdio> link_monitor_{mdio_};
  hal::PortCounters counters_;
  // The newest good frame, in whole bursts.
  alignas(64) std::array<std::byte, kFrameBursts * machine::kBurstBytes> copy_{};
  std::span<const std::byte> frame_;  // of copy_, until release()
  std::span<std::byte> acquired_;     // what acquire() returned and commit() has not queued
  phy::Identity phy_;
  MacAddress address_{};
  std::uint64_t groups_ = 0;          // bins of the filter's hash table for groups
  Link mode_;                         // the speed and duplex that the controller is set to
  std::uint64_t restarted_us_ = 0;    // never: 0
  std::uint64_t progress_us_ = 0;     // when a frame was last seen to leave, or none was in flight
  std::uint32_t progress_sent_ = 0;   // frames that had left by then
  std::uint64_t collected_us_ = 0;    // when the statistics were last read
  std::uint32_t overflows_seen_ = 0;  // receive_overflows when the ring was last found full
};

}  // namespace iog::zcu102
