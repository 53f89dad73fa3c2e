// Bringing the controller up, and up again, by UG1085, chapter "GEM Ethernet", section "Programming
// model". Everything is set while receiver and transmitter are off.
#include "ethernet/gem_port.hpp"

namespace iog::zcu102 {
namespace {

using R = GemRegisters;
using Clocks = CrlApbRegisters;

// As on the i.MX6 (enet_start.cpp): at 10 Mbit/s and half duplex a frame may take 386 ms.
constexpr std::uint64_t kStuckUs = 500'000;
// Of a bus that stays bad: at most so often.
constexpr std::uint64_t kBusErrorPauseUs = 100'000;

// The transmit clock of RGMII: 125, 25 or 2.5 MHz. Every loader sets the IOPLL to 1500 MHz
// (psu_init of the board).
constexpr std::uint32_t kIoPllMhz = 1500;
constexpr std::uint32_t kDivisor0 = 12;
static_assert(kIoPllMhz / kDivisor0 == 125);

constexpr std::uint32_t divisor1_of(Link::Speed speed) {
  switch (speed) {
    case Link::Speed::k10:
      return 50;
    case Link::Speed::k100:
      return 5;
    case Link::Speed::k1000:
      break;
  }
  return 1;
}

// A group has the bin whose six bits are sums of every sixth bit of its address, the first bit on
// the wire first (UG1085, "Hash addressing").
std::uint64_t bin_of(const MacAddress& group) {
  std::uint64_t bits = 0;
  for (std::size_t index = 0; index < group.size(); ++index) {
    bits |= std::uint64_t{group[index]} << 8 * index;
  }
  std::uint64_t bin = 0;
  for (unsigned shift = 0; shift < 48; shift += 6) {
    bin ^= bits >> shift & 0x3f;
  }
  return std::uint64_t{1} << bin;
}

}  // namespace

[[gnu::section(".dma")]] constinit GemMemory gem_memory{};

void GemPort::start(const MacAddress& address) {
  address_ = address;
  set_up(Link{});
  phy_ = start_phy(mdio_);
  run();
}

void GemPort::set_up(const Link& mode) {
  stop();
  set_mode(mode);
  // Descriptors of four words, bursts of 16, the whole packet memory, buffers of the ring's size.
  registers_.dma_config.write(R::kDmaAddress64 | R::kDmaWholePacketMemory | R::kDmaBurst16 |
                              ReceiveRing::kBufferBytes / 64 << R::kDmaBufferShift);
  receive_ring_.start();
  transmit_ring_.start();
  park_unused_queues();
  set_rings();
  set_address();
  set_groups();
  registers_.network_control.write(R::kControlManagement);
}

void GemPort::run() {
  // A received frame is the one event that may end the loop's sleep.
  registers_.int_enable.write(R::kInterruptReceived);
  registers_.network_control.write(R::kControlManagement | R::kControlReceive |
                                   R::kControlTransmit);
}

void GemPort::stop() {
  registers_.int_disable.write(R::kAll);
  registers_.network_control.write(0);
  registers_.network_control.write(R::kControlClearStatistics);
  registers_.transmit_status.clear(R::kAll);
  registers_.receive_status.clear(R::kAll);
  clear_event();
}

// The second queues of both directions are not used, but the controller has them. Each has one
// descriptor that is never the controller's. In QEMU, frames would overwrite buffers that hold
// others if the second receive queue were not parked, and the transmitter would read address 0.
void GemPort::park_unused_queues() {
  parked_[0] = {};
  parked_[1] = {};
  machine::store(parked_[0].address, receive_flag::kOurs | receive_flag::kWrap);
  machine::store(parked_[1].control, transmit_flag::kOurs | transmit_flag::kWrap);
  machine::barrier();
}

void GemPort::set_rings() {
  const std::uint64_t receive = receive_ring_.bus_address();
  const std::uint64_t transmit = transmit_ring_.bus_address();
  // One upper half for all queues of a direction: all descriptors are in the same 4 GiB.
  registers_.upper_rx_q_base_addr.write(high_half(receive));
  registers_.upper_tx_q_base_addr.write(high_half(transmit));
  registers_.receive_q_ptr.write(low_half(receive));
  registers_.transmit_q_ptr.write(low_half(transmit));
  registers_.receive_q1_ptr.write(low_half(machine::bus_address(parked_[0])));
  registers_.transmit_q1_ptr.write(low_half(machine::bus_address(parked_[1])));
}

// The filter lets our address, broadcast and the bins of joined groups through. The write of the
// upper half makes the address valid, so it comes last.
void GemPort::set_address() {
  const auto byte = [this](std::size_t index) { return std::uint32_t{address_[index]}; };
  registers_.spec_add1_bottom.write(byte(3) << 24 | byte(2) << 16 | byte(1) << 8 | byte(0));
  registers_.spec_add1_top.write(byte(5) << 8 | byte(4));
}

void GemPort::set_groups() {
  registers_.hash_bottom.write(static_cast<std::uint32_t>(groups_));
  registers_.hash_top.write(static_cast<std::uint32_t>(groups_ >> 32));
}

// The table may change while frames come; a restart writes it again.
void GemPort::join(const MacAddress& group) {
  groups_ |= bin_of(group);
  set_groups();
}

// Pause frames are not obeyed: a receiver that cannot keep up loses frames, it does not stop the
// loop. The FCS is removed, and no checksum is looked at: the network layer does it.
void GemPort::set_mode(const Link& mode) {
  mode_ = mode;
  std::uint32_t config =
      R::kConfigBus64 | R::kConfigMdcBy224 | R::kConfigRemoveFcs | R::kConfigMulticastHash;
  config |= mode.full_duplex ? R::kConfigFullDuplex : 0;
  config |= mode.speed == Link::Speed::k1000 ? R::kConfigGigabit : 0;
  config |= mode.speed == Link::Speed::k100 ? R::kConfig100 : 0;
  registers_.network_config.write(config);
  clocks_.gem3_ref_ctrl.write(Clocks::kReceiveActive | Clocks::kActive | Clocks::kFromIoPll |
                              divisor1_of(mode.speed) << Clocks::kDivisor1Shift |
                              kDivisor0 << Clocks::kDivisor0Shift);
}

// A bus error leaves it open where the DMA was, a frame that never leaves has stopped the
// transmitter whatever the reason, and another speed or duplex may be set only while it is stopped.
// A link that is down keeps the mode it had.
bool GemPort::must_start_anew(std::uint64_t now_us) {
  const bool stuck = is_stuck(now_us);  // always asked: it watches
  const Link& link = link_monitor_.link();
  const bool mode_differs =
      link.up && (link.speed != mode_.speed || link.full_duplex != mode_.full_duplex);
  const bool bus_error = ((registers_.transmit_status.read() & R::kTransmitBusError) != 0 ||
                          (registers_.receive_status.read() & R::kReceiveBusError) != 0) &&
                         now_us - restarted_us_ >= kBusErrorPauseUs;
  return acquired_.empty() && (stuck || mode_differs || bus_error);
}

// Whether frames are in flight and none has left for kStuckUs. Without a link that is no wonder: it
// may be the PHY that has stopped the clock.
bool GemPort::is_stuck(std::uint64_t now_us) {
  const TransmitOrder& order = transmit_ring_.order();
  if (order.in_flight() == 0 || order.sent() != progress_sent_ || !link_monitor_.link().up) {
    progress_sent_ = order.sent();
    progress_us_ = now_us;
  }
  return now_us - progress_us_ >= kStuckUs;
}

// What waits in either ring is lost, and counted: of half a ring it is not known where the
// controller was.
void GemPort::start_anew(std::uint64_t now_us) {
  ++counters_.restarts;
  counters_.lost_received += static_cast<std::uint32_t>(receive_ring_.waiting());
  const TransmitOrder& order = transmit_ring_.order();
  counters_.lost_unsent += static_cast<std::uint32_t>(order.queued() + order.in_flight());
  collect_statistics();
  link_monitor_.abandon();
  const Link& link = link_monitor_.link();
  set_up(link.up ? link : mode_);
  run();
  restarted_us_ = now_us;
  progress_us_ = now_us;
}

}  // namespace iog::zcu102
