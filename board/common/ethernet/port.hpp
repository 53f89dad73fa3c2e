// An Ethernet controller as a hal::EthernetPort: its rings, the link, a limit on how fast frames
// leave (transmit_shaper.hpp), and a start anew when it has stopped.
//
// The controller's memory is uncached, so a received frame is copied once, in bursts, into cached
// memory, and parsed there; its buffer goes back at once. On the i.MX6, 1500 bytes are 47 bursts of
// some 140 cycles, 7 us. Parsed in place, each field and each word of the checksum takes as long as
// a burst: by the cost model (docs/a9_model.md) 100 us a packet of a LUX and 2 ms more a frame of
// four, where the copies of a frame take 0.12 ms. Cached buffers would save most of that and cost
// an invalidation of each of the 47 lines in both cache levels, before and after (the PL310's by
// its slow port), with erratum 764369 to mind: no less, and much more to get wrong.
//
// Controller is of the board, and has beside Format (rings.hpp), Mdio (mdio.hpp) and Clock:
//
//   stop()              resets it; its events are cleared, and its statistics begin anew
//   set_up(settings)    writes them while it is stopped; then mdio() works
//   run()               it receives and sends
//   start_phy()         finds the PHY and sets it up
//   bin_of(group)       the bit of the filter's hash table; set_groups(bits) may come at any time
//   frame_bytes(descriptor, counters)  the length of the good frame in a filled buffer; 0 if the
//                       buffer has none, which is counted
//   gave_back()         called after each buffer that the controller may fill again
//   found_none(was_full, counters)     called when no buffer is filled
//   send()              wakes the transmitter, once the descriptors are in memory
//   collect(counters)   adds what its statistics have counted since the last call
//   can_receive(), has_bus_error(), clear_event()
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "board/common/ethernet/link_monitor.hpp"
#include "board/common/ethernet/rings.hpp"
#include "board/common/ethernet/settings.hpp"
#include "board/common/ethernet/transmit_shaper.hpp"
#include "hal/ethernet_port.hpp"
#include "health/guard.hpp"

namespace iog::board {

// Everything the controller's DMA touches. One of these, in the uncached region. Between its parts
// stand guards.
//
// Transmit: a complete grid without waiting: 1024 tiles, 64 frames of other kinds that may fall
// into the same moment (status, ARP, echo replies), and 64 that may still be in flight from before;
// and 256 for a subscriber's copies, which go only where the peer needs no room (app/offering.hpp).
template <typename Format>
struct PortMemory {
  using Descriptor = typename Format::Descriptor;
  static constexpr std::size_t kReceiveFrames = Format::kReceiveFrames;
  static constexpr std::size_t kTransmitFrames = 1024 + 64 + 64 + 256;

  health::Guard below;
  alignas(64) std::array<Descriptor, kReceiveFrames> receive_descriptors;
  health::Guard behind_receive_descriptors;
  alignas(64) std::array<Descriptor, kTransmitFrames> transmit_descriptors;
  health::Guard behind_transmit_descriptors;
  alignas(64) std::array<std::byte, kReceiveFrames * Format::kReceiveBytes> receive_buffers;
  health::Guard behind_receive_buffers;
  alignas(64) std::array<std::byte, kTransmitFrames * kTransmitBytes> transmit_buffers;
  health::Guard behind_transmit_buffers;
};

// From low to high.
template <typename Format>
constexpr std::array<health::Guard*, 5> guards_of(PortMemory<Format>& memory) {
  return {&memory.below, &memory.behind_receive_descriptors, &memory.behind_transmit_descriptors,
          &memory.behind_receive_buffers, &memory.behind_transmit_buffers};
}

// Its functions are in port_functions.hpp, which one file of each board includes.
template <typename Controller>
class Port {
 public:
  using Format = typename Controller::Format;
  using Descriptor = typename Format::Descriptor;
  using Memory = typename Format::Memory;
  using Clock = typename Controller::Clock;

  static constexpr std::size_t kFrameBursts =
      (kMaxFrameBytes + machine::kBurstBytes - 1) / machine::kBurstBytes;

  struct Rings {
    std::span<Descriptor> receive_descriptors;
    std::span<std::byte> receive_buffers;
    std::span<Descriptor> transmit_descriptors;
    std::span<std::byte> transmit_buffers;
  };
  static Rings rings_of(PortMemory<Format>& memory) {
    return {memory.receive_descriptors, memory.receive_buffers, memory.transmit_descriptors,
            memory.transmit_buffers};
  }

  Port(const Controller& controller, const Rings& rings, Memory& memory, Clock& clock)
      : controller_(controller),
        memory_(memory),
        clock_(clock),
        receive_ring_(rings.receive_descriptors, rings.receive_buffers, memory),
        transmit_ring_(rings.transmit_descriptors, rings.transmit_buffers, memory) {}

  Port(const Port&) = delete;  // the parts refer to each other
  Port& operator=(const Port&) = delete;

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
  hal::PortCounters counters() const { return counters_; }
  hal::PortLife life() const;

  // Withdraws the wake-up request of the frames received so far. Poll the rings after it.
  void clear_event() { controller_.clear_event(); }

  const Link& link() const { return link_monitor_.link(); }
  const phy::Identity& phy() const { return phy_; }

 private:
  void set_up(const Link& mode);
  bool must_start_anew(std::uint64_t now_us);
  bool is_stuck(std::uint64_t now_us);
  void start_anew(std::uint64_t now_us);
  void accept();

  Controller controller_;
  Memory& memory_;
  Clock& clock_;
  ReceiveRing<Format> receive_ring_;
  TransmitRing<Format> transmit_ring_;
  TransmitShaper shaper_;
  LinkMonitor<typename Controller::Mdio> link_monitor_{controller_.mdio()};
  hal::PortCounters counters_;
  // The newest good frame, in whole bursts.
  alignas(64) std::array<std::byte, kFrameBursts * machine::kBurstBytes> copy_{};
  std::span<const std::byte> frame_;  // of copy_, until release()
  std::span<std::byte> acquired_;     // what acquire() returned and commit() has not queued
  phy::Identity phy_;
  MacAddress address_{};
  std::uint64_t groups_ = 0;         // bins of the filter's hash table for groups
  Link mode_;                        // the speed and duplex that the controller is set to
  std::uint64_t restarted_us_ = 0;   // never: 0
  std::uint64_t progress_us_ = 0;    // when a frame was last seen to leave, or none was in flight
  std::uint32_t progress_sent_ = 0;  // frames that had left by then
  std::uint64_t collected_us_ = 0;   // when the statistics were last read
};

}  // namespace iog::board
