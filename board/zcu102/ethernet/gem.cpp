// UG1085, chapter "GEM Ethernet". By its section "Programming model" everything is set while
// receiver and transmitter are off.
#include "ethernet/gem.hpp"

#include "board/common/ethernet/port_functions.hpp"

template class iog::board::Port<iog::zcu102::Gem>;

namespace iog::zcu102 {

static_assert(hal::EthernetPort<GemPort>);

namespace {

using R = GemRegisters;
using Clocks = CrlApbRegisters;

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

}  // namespace

[[gnu::section(".dma")]] constinit GemMemory gem_memory{};
[[gnu::section(".dma")]] constinit std::array<Descriptor, 2> parked_queues{};

void Gem::stop() {
  registers_.int_disable.write(R::kAll);
  registers_.network_control.write(0);
  registers_.network_control.write(R::kControlClearStatistics);
  registers_.transmit_status.clear(R::kAll);
  registers_.receive_status.clear(R::kAll);
  clear_event();
}

void Gem::set_up(const PortSettings& settings) {
  set_mode(settings.mode);
  // Descriptors of four words, bursts of 16, the whole packet memory, buffers of the ring's size.
  registers_.dma_config.write(R::kDmaAddress64 | R::kDmaWholePacketMemory | R::kDmaBurst16 |
                              Format::kReceiveBytes / 64 << R::kDmaBufferShift);
  set_rings(settings.receive_ring, settings.transmit_ring);
  set_address(settings.address);
  set_groups(settings.groups);
  registers_.network_control.write(R::kControlManagement);
}

void Gem::run() {
  // A received frame is the one event that may end the loop's sleep.
  registers_.int_enable.write(R::kInterruptReceived);
  registers_.network_control.write(R::kControlManagement | R::kControlReceive |
                                   R::kControlTransmit);
}

// The second queues of both directions are not used, but the controller has them. Each has one
// descriptor that is never the controller's. In QEMU, frames would overwrite buffers that hold
// others if the second receive queue were not parked, and the transmitter would read address 0.
void Gem::set_rings(std::uint32_t receive, std::uint32_t transmit) {
  parked_queues = {};
  machine::store(parked_queues[0].address, receive_flag::kOurs | receive_flag::kWrap);
  machine::store(parked_queues[1].control, transmit_flag::kOurs | transmit_flag::kWrap);
  machine::barrier();
  // One upper half for all queues of a direction.
  registers_.upper_rx_q_base_addr.write(0);
  registers_.upper_tx_q_base_addr.write(0);
  registers_.receive_q_ptr.write(receive);
  registers_.transmit_q_ptr.write(transmit);
  registers_.receive_q1_ptr.write(machine::bus_address(parked_queues[0]));
  registers_.transmit_q1_ptr.write(machine::bus_address(parked_queues[1]));
}

// The filter lets our address, broadcast and the bins of joined groups through. The write of the
// upper half makes the address valid, so it comes last.
void Gem::set_address(const MacAddress& address) {
  const auto byte = [&address](std::size_t index) { return std::uint32_t{address[index]}; };
  registers_.spec_add1_bottom.write(byte(3) << 24 | byte(2) << 16 | byte(1) << 8 | byte(0));
  registers_.spec_add1_top.write(byte(5) << 8 | byte(4));
}

// A group has the bin whose six bits are sums of every sixth bit of its address, the first bit on
// the wire first (UG1085, "Hash addressing").
unsigned Gem::bin_of(const MacAddress& group) {
  std::uint64_t bits = 0;
  for (std::size_t index = 0; index < group.size(); ++index) {
    bits |= std::uint64_t{group[index]} << 8 * index;
  }
  unsigned bin = 0;
  for (unsigned shift = 0; shift < 48; shift += 6) {
    bin ^= static_cast<unsigned>(bits >> shift & 0x3f);
  }
  return bin;
}

void Gem::set_groups(std::uint64_t groups) {
  registers_.hash_bottom.write(static_cast<std::uint32_t>(groups));
  registers_.hash_top.write(static_cast<std::uint32_t>(groups >> 32));
}

// Pause frames are not obeyed: a receiver that cannot keep up loses frames, it does not stop the
// loop. The FCS is removed, and no checksum is looked at: the network layer does it.
void Gem::set_mode(const Link& mode) {
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

// The controller drops frames with a wrong FCS and longer than 1518 bytes, and its statistics count
// them. The length is without FCS, and is believed only within the bounds of a frame.
std::size_t Gem::frame_bytes(const Descriptor& descriptor, hal::PortCounters& counters) {
  const std::uint32_t control = machine::load(descriptor.control);
  const bool first = (control & receive_flag::kFirst) != 0;
  if (!first || (control & receive_flag::kLast) == 0) {
    counters.oversized += first ? 1 : 0;  // a frame of several buffers, once
    return 0;
  }
  const std::size_t bytes = control & receive_flag::kLength;
  if (bytes < board::kMinFrameBytes || bytes > board::kMaxFrameBytes) {
    ++counters.receive_errors;
    return 0;
  }
  return bytes;
}

// Once the ring was full, QEMU's GEM keeps the descriptor that it found used, until NETWORK_CONTROL
// is written. That write delivers as many waiting frames as there are free buffers and drops the
// others, so it comes only when all buffers are free. The GEM itself looks again with each frame,
// and the write changes nothing. At least one frame was lost, also if no statistic says so. QEMU
// sets the flag for the parked queue, too, at each write of NETWORK_CONTROL.
void Gem::found_none(bool was_full, hal::PortCounters& counters) {
  if ((registers_.receive_status.read() & R::kReceiveNoBuffer) == 0) {
    return;
  }
  registers_.receive_status.clear(R::kReceiveNoBuffer);
  if (!was_full) {
    return;
  }
  collect(counters);
  counters.receive_overflows += counters.receive_overflows == overflows_seen_ ? 1 : 0;
  overflows_seen_ = counters.receive_overflows;
  machine::barrier();
  registers_.network_control.write(registers_.network_control.read());
}

// Reading a statistic clears it. QEMU's do not clear, but never count any of these.
void Gem::collect(hal::PortCounters& counters) {
  counters.receive_errors += registers_.undersize_frames.read() + registers_.fcs_errors.read() +
                             registers_.rx_length_errors.read() +
                             registers_.rx_symbol_errors.read() +
                             registers_.alignment_errors.read();
  counters.oversized += registers_.excessive_rx_length.read() + registers_.rx_jabbers.read();
  counters.receive_overflows +=
      registers_.rx_resource_errors.read() + registers_.rx_overruns.read();
}

bool Gem::can_receive() const {
  return (registers_.network_control.read() & R::kControlReceive) != 0 &&
         (registers_.receive_status.read() & R::kReceiveNoBuffer) == 0;
}

bool Gem::has_bus_error() const {
  return (registers_.transmit_status.read() & R::kTransmitBusError) != 0 ||
         (registers_.receive_status.read() & R::kReceiveBusError) != 0;
}

}  // namespace iog::zcu102
