// UG1085, chapter "GEM Ethernet". According to its section "Programming model", all registers are
// set while receiver and transmitter are off.
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
  // Uses descriptors of four words, bursts of 16, the whole packet memory, and buffers of the
  // ring's size.
  registers_.dma_config.write(R::kDmaAddress64 | R::kDmaWholePacketMemory | R::kDmaBurst16 |
                              Format::kReceiveBytes / 64 << R::kDmaBufferShift);
  set_rings(settings.receive_ring, settings.transmit_ring);
  set_address(settings.address);
  set_groups(settings.groups);
  registers_.network_control.write(R::kControlManagement);
}

void Gem::run() {
  // Of the controller's events, only a received frame may wake the loop.
  registers_.int_enable.write(R::kInterruptReceived);
  registers_.network_control.write(R::kControlManagement | R::kControlReceive |
                                   R::kControlTransmit);
}

// Parks the second queues of both directions, which are not used. Each gets one descriptor that the
// controller never owns. Without it, QEMU would receive frames into buffers that still contain
// other frames, and its transmitter would read address 0.
void Gem::set_rings(std::uint32_t receive, std::uint32_t transmit) {
  parked_queues = {};
  machine::store(parked_queues[0].address, receive_flag::kOurs | receive_flag::kWrap);
  machine::store(parked_queues[1].control, transmit_flag::kOurs | transmit_flag::kWrap);
  machine::barrier();
  // All queues of a direction share one upper half of their addresses.
  registers_.upper_rx_q_base_addr.write(0);
  registers_.upper_tx_q_base_addr.write(0);
  registers_.receive_q_ptr.write(receive);
  registers_.transmit_q_ptr.write(transmit);
  registers_.receive_q1_ptr.write(machine::bus_address(parked_queues[0]));
  registers_.transmit_q1_ptr.write(machine::bus_address(parked_queues[1]));
}

// The filter passes our address, broadcast and the bins of joined groups. Writing the upper half
// makes the address valid, so it is written last.
void Gem::set_address(const MacAddress& address) {
  const auto byte = [&address](std::size_t index) { return std::uint32_t{address[index]}; };
  registers_.spec_add1_bottom.write(byte(3) << 24 | byte(2) << 16 | byte(1) << 8 | byte(0));
  registers_.spec_add1_top.write(byte(5) << 8 | byte(4));
}

// Each of the six bits of a group's bin is the exclusive or of every sixth bit of its address,
// beginning with the first bit on the wire (UG1085, "Hash addressing").
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

// Pause frames are ignored, so a receiver that cannot keep up loses frames and does not stop the
// loop. The controller removes the FCS. The network layer checks the checksums.
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

// The controller drops and counts frames with a wrong FCS and frames of more than 1518 bytes. The
// length excludes the FCS. A length outside the bounds of a frame is never used.
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

// After the ring was full, QEMU's GEM does not check it again until NETWORK_CONTROL is written.
// This write delivers as many waiting frames as there are free buffers and drops the others, so it
// is done only when all buffers are free. The chip checks the ring with each frame, so the write
// has no effect. At least one frame was lost, even if no statistic shows it. QEMU also sets the
// flag at each write of NETWORK_CONTROL, because of the parked queue.
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

// Reading a statistic clears it. QEMU does not clear statistics, but it never counts any of these.
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
