// Implements hal::EthernetPort with an Ethernet controller. Port manages the rings and the link,
// limits the transmit rate (transmit_shaper.hpp), and restarts the controller when the controller
// has stopped.
//
// The controller's memory is uncached. A received frame is therefore copied once, in bursts, into
// cached memory, where it is parsed. The frame's buffer is returned immediately. On the i.MX6, 1500
// bytes are 47 bursts of about 140 cycles, or 7 us. If a frame were parsed in place, reading each
// field and each word of the checksum would take as long as a burst. The cost model
// (docs/a9_model.md) predicts 100 us per LUX packet, which adds 2 ms to a frame of four LUX,
// whereas the copies add 0.12 ms. Cached buffers would save most of the copying. However, all 47
// lines would have to be invalidated in both cache levels, before and after the transfer, through
// the PL310's slow port and with erratum 764369 in mind. Invalidation would cost as much as
// copying, and would be more error-prone.
//
// Each board provides a Controller with the types Format (rings.hpp), Mdio (mdio.hpp) and Clock,
// and the following functions:
//
//   stop()              resets the controller, its events and its statistics
//   set_up(settings)    writes the settings of the stopped controller; then mdio() works
//   run()               starts reception and transmission
//   start_phy()         finds the PHY and sets it up
//   bin_of(group)       the group's bit in the filter's hash table
//   set_groups(bits)    sets this table; may be called at any time
//   frame_bytes(descriptor, counters)  the length of the good frame in a filled buffer; if there is
//                       none, counts a bad frame and returns 0
//   gave_back(memory)   called after each buffer that the controller may fill again
//   found_none(was_full, counters)     called when no buffer is filled
//   send()              wakes the transmitter, once the descriptors are in memory
//   collect(counters)   adds the events that its statistics have counted since the last call
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

// The rings and their buffers, which the controller's DMA accesses. The only instance is in the
// uncached region. Guards separate the parts of this memory.
//
// The transmit ring has room for a complete grid: 1024 tiles, 64 other frames at the same time
// (status, ARP, echo replies), and 64 earlier frames that may still be in flight. Another 256
// buffers are for copies to a subscriber, which never take buffers that the peer needs
// (app/offering.hpp).
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

// Returns the guards in ascending order of addresses.
template <typename Format>
constexpr std::array<health::Guard*, 5> guards_of(PortMemory<Format>& memory) {
  return {&memory.below, &memory.behind_receive_descriptors, &memory.behind_transmit_descriptors,
          &memory.behind_receive_buffers, &memory.behind_transmit_buffers};
}

// The header port_functions.hpp, which one file of each board includes, defines the functions of
// Port.
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

  // Resets the controller, finds the PHY, and starts receiving. Pads and clocks must already be set
  // up.
  void start(const MacAddress& address);

  // Starts receiving frames to a multicast group. The port also receives some frames to other
  // groups, because groups share hash bins.
  void join(const MacAddress& group);

  // The interface of hal::EthernetPort.
  std::span<const std::byte> receive();
  void release();
  std::span<std::byte> acquire();
  std::size_t room();
  void commit(std::size_t frame_bytes);
  void pump();
  hal::PortCounters counters() const { return counters_; }
  hal::PortLife life() const;

  // Clears the receive event, which wakes the loop. Poll the rings after this call, so that no
  // frame is missed.
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
  // A copy of the newest good frame, in whole bursts.
  alignas(64) std::array<std::byte, kFrameBursts * machine::kBurstBytes> copy_{};
  std::span<const std::byte> frame_;  // of copy_, until release()
  std::span<std::byte> acquired_;     // buffer from acquire(), until commit()
  phy::Identity phy_;
  MacAddress address_{};
  std::uint64_t groups_ = 0;         // bins of the filter's hash table for groups
  Link mode_;                        // the speed and duplex that the controller is set to
  std::uint64_t restarted_us_ = 0;   // 0 if never
  std::uint64_t progress_us_ = 0;    // last time at which a frame left or none was in flight
  std::uint32_t progress_sent_ = 0;  // frames sent by then
  std::uint64_t collected_us_ = 0;   // last time at which the statistics were read
};

}  // namespace iog::board
