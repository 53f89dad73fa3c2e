// The Ethernet controller as a hal::EthernetPort. It has its own memory, and it limits how fast
// frames leave (transmit_shaper.hpp).
//
// The controller's memory is uncached, so a received frame is copied once, in bursts, into cached
// memory, and parsed there; its buffer goes back at once. 1500 bytes are 47 bursts of some 140
// cycles, 7 us. Parsed in place, each field and each word of the checksum takes as long as a burst:
// by the cost model (docs/a9_model.md) 100 us a packet of a LUX and 2 ms more a frame of four,
// where the copies of a frame take 0.12 ms. Cached buffers would save most of that and cost an
// invalidation of each of the 47 lines in both cache levels, before and after (the PL310's by its
// slow port), with erratum 764369 to mind: no less, and much more to get wrong.
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
#include "memory/l2_cache.hpp"
#include "registers/enet.hpp"
#include "time/gpt_clock.hpp"

namespace iog::imx6 {

using MacAddress = std::array<std::uint8_t, 6>;

// Everything the controller's DMA touches. One of these, in the uncached region (linker/imx6.ld).
// Below and behind the region nothing is mapped, for a processor; between its parts stand guards.
//
// Receive: 256 frames. Four LUX at 25 Hz send some 1000 frames of 1500 bytes a second and a
// Velodyne 1500, so this is 100 ms of both together, longer than the slowest pass of the loop.
// Transmit: a complete grid without waiting: 1024 tiles, 64 frames of other kinds that may fall
// into the same moment (status, ARP, echo replies), and 64 that may still be in flight from before;
// and 256 for a subscriber's copies, which go only where the peer needs no room (app/offering.hpp).
struct EnetMemory {
  static constexpr std::size_t kReceiveFrames = 256;
  static constexpr std::size_t kTransmitFrames = 1024 + 64 + 64 + 256;
  static constexpr std::size_t kBudgetBytes = 3u << 20;

  health::Guard below;
  alignas(64) std::array<Descriptor, kReceiveFrames> receive_descriptors;
  health::Guard behind_receive_descriptors;
  alignas(64) std::array<Descriptor, kTransmitFrames> transmit_descriptors;
  health::Guard behind_transmit_descriptors;
  alignas(64) std::array<std::byte, kReceiveFrames * ReceiveRing::kBufferBytes> receive_buffers;
  health::Guard behind_receive_buffers;
  alignas(64) std::array<std::byte, kTransmitFrames * TransmitRing::kBufferBytes> transmit_buffers;
  health::Guard behind_transmit_buffers;
};
static_assert(EnetMemory::kTransmitFrames == 1408);
static_assert(sizeof(EnetMemory) <= EnetMemory::kBudgetBytes,
              "fits three sections of the DMA region");

// From low to high.
constexpr std::array<health::Guard*, 5> guards_of(EnetMemory& memory) {
  return {&memory.below, &memory.behind_receive_descriptors, &memory.behind_transmit_descriptors,
          &memory.behind_receive_buffers, &memory.behind_transmit_buffers};
}

// The memory of the firmware's one controller, constinit where it is defined.
extern EnetMemory enet_memory;  // NOLINT(bugprone-dynamic-static-initializers)

class EnetPort {
 public:
  static constexpr std::size_t kMinFrameBytes = 14;
  static constexpr std::size_t kMaxFrameBytes = 1514;
  static constexpr std::size_t kFrameBursts =
      (kMaxFrameBytes + machine::kBurstBytes - 1) / machine::kBurstBytes;

  EnetPort(EnetRegisters& registers, std::span<Descriptor> receive_descriptors,
           std::span<std::byte> receive_buffers, std::span<Descriptor> transmit_descriptors,
           std::span<std::byte> transmit_buffers, L2Cache& cache, GptClock& clock)
      : registers_(registers),
        cache_(cache),
        clock_(clock),
        receive_ring_(receive_descriptors, receive_buffers, cache),
        transmit_ring_(transmit_descriptors, transmit_buffers, cache) {}

  EnetPort(const EnetPort&) = delete;  // the rings refer to each other's memory
  EnetPort& operator=(const EnetPort&) = delete;

  // Resets the controller, finds the PHY, starts receiving. Pads and clocks must be up already.
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
  hal::PortCounters counters() const;
  hal::PortLife life() const;

  // Withdraws the wake-up request of the frames received so far. Poll the rings after it.
  void clear_event() { registers_.eir.clear(EnetRegisters::kEirReceivedFrame); }

  const Link& link() const { return link_monitor_.link(); }
  const phy::Identity& phy() const { return phy_; }

 private:
  void set_up(const Link& mode);
  void run();
  void reset();
  void set_address();
  void set_groups();
  void set_frame_limits();
  void set_mode(const Link& mode);
  bool must_start_anew(std::uint64_t now_us);
  bool is_stuck(std::uint64_t now_us);
  void start_anew(std::uint64_t now_us);
  void accept();
  void give_back();
  void kick_transmitter();

  EnetRegisters& registers_;
  L2Cache& cache_;
  GptClock& clock_;
  ReceiveRing receive_ring_;
  TransmitRing transmit_ring_;
  board::TransmitShaper shaper_;
  Mdio mdio_{registers_};
  board::LinkMonitor<Mdio> link_monitor_{mdio_};
  hal::PortCounters counters_;
  // The newest good frame, in whole bursts.
  alignas(64) std::array<std::byte, kFrameBursts * machine::kBurstBytes> copy_{};
  std::span<const std::byte> frame_;  // of copy_, until release()
  std::span<std::byte> acquired_;     // what acquire() returned and commit() has not queued
  bool in_long_frame_ = false;        // the buffers up to the next "last" belong to a dropped frame
  phy::Identity phy_;
  MacAddress address_{};
  std::uint64_t groups_ = 0;         // bins of the filter's hash table for groups
  Link mode_;                        // the speed and duplex that the controller is set to
  std::uint64_t restarted_us_ = 0;   // never: 0
  std::uint64_t progress_us_ = 0;    // when a frame was last seen to leave, or none was in flight
  std::uint32_t progress_sent_ = 0;  // frames that had left by then
};

}  // namespace iog::imx6
