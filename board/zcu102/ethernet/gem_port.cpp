// GEM by UG1085, chapter "GEM Ethernet", section "Programming Model".
#include "ethernet/gem_port.hpp"

#include <cstring>

#include "require/require.hpp"

namespace iog::zcu102 {

[[gnu::section(".dma")]] constinit GemMemory gem_memory{};

static_assert(hal::EthernetPort<GemPort>);

namespace {

using R = GemRegisters;

namespace receive_flag {
constexpr std::uint32_t kUsed = 1u << 0;  // of the address: the processor's
constexpr std::uint32_t kWrap = 1u << 1;  // of the address
constexpr std::uint32_t kLengthBits = 0x1fff;
constexpr std::uint32_t kFirst = 1u << 14;
constexpr std::uint32_t kLast = 1u << 15;
}  // namespace receive_flag

namespace transmit_flag {
constexpr std::uint32_t kLast = 1u << 15;
constexpr std::uint32_t kWrap = 1u << 30;
constexpr std::uint32_t kUsed = 1u << 31;  // the processor's
}  // namespace transmit_flag

constexpr std::uint32_t kRunning = R::kNwctrlReceive | R::kNwctrlTransmit | R::kNwctrlMdio;

}  // namespace

void GemPort::fill_rings() {
  for (std::size_t i = 0; i < memory_.receive_descriptors.size(); ++i) {
    const bool is_last = i + 1 == memory_.receive_descriptors.size();
    const std::uint32_t address =
        machine::bus_address(memory_.receive_buffers[i * GemMemory::kBufferBytes]);
    memory_.receive_descriptors[i] = {address | (is_last ? receive_flag::kWrap : 0), 0, 0, 0};
  }
  for (std::size_t i = 0; i < memory_.transmit_descriptors.size(); ++i) {
    const bool is_last = i + 1 == memory_.transmit_descriptors.size();
    memory_.transmit_descriptors[i] = {
        machine::bus_address(memory_.transmit_buffers[i * GemMemory::kBufferBytes]),
        transmit_flag::kUsed | (is_last ? transmit_flag::kWrap : 0), 0, 0};
  }
  memory_.parked[0] = {receive_flag::kUsed | receive_flag::kWrap, 0, 0, 0};
  memory_.parked[1] = {0, transmit_flag::kUsed | transmit_flag::kWrap, 0, 0};
}

void GemPort::start(const MacAddress& address) {
  registers_.nwctrl.write(0);
  registers_.idr.write(0x07ff'ffff);
  registers_.nwctrl.write(R::kNwctrlClearStatistics);
  registers_.txstatus.clear(0xff);
  registers_.rxstatus.clear(0x0f);
  fill_rings();
  registers_.nwcfg.write(R::kNwcfgFullDuplex | R::kNwcfgGigabit | R::kNwcfgRemoveFcs |
                         R::kNwcfgMdcBy224 | R::kNwcfg64BitBus | R::kNwcfgReceiveChecksum |
                         R::kNwcfgMulticastHash);
  registers_.dmacfg.write(R::kDmacfg64BitAddresses | (GemMemory::kBufferBytes / 64) << 16 |
                          R::kDmacfgWholeMemories | R::kDmacfgBurst16);
  registers_.hash[0].write(0);
  registers_.hash[1].write(0);
  registers_.address[0].low.write(address[0] | std::uint32_t{address[1]} << 8 |
                                  std::uint32_t{address[2]} << 16 |
                                  std::uint32_t{address[3]} << 24);
  registers_.address[0].high.write(address[4] | std::uint32_t{address[5]} << 8);
  machine::barrier();
  registers_.rxqbase.write(machine::bus_address(memory_.receive_descriptors));
  registers_.txqbase.write(machine::bus_address(memory_.transmit_descriptors));
  registers_.rxqbase_high.write(0);
  registers_.txqbase_high.write(0);
  registers_.rxq1base.write(machine::bus_address(memory_.parked[0]));
  registers_.txq1base.write(machine::bus_address(memory_.parked[1]));
  registers_.ier.write(R::kIerReceived);
  registers_.nwctrl.write(kRunning);
}

// The bin is the exclusive or of the address's eight groups of six bits (UG1085, "Hash
// Addressing").
void GemPort::join(const MacAddress& group) {
  std::uint64_t bits = 0;
  for (std::size_t octet = group.size(); octet > 0; --octet) {
    bits = bits << 8 | group[octet - 1];
  }
  std::uint32_t bin = 0;
  for (; bits != 0; bits >>= 6) {
    bin ^= static_cast<std::uint32_t>(bits & 0x3f);
  }
  registers_.hash[bin / 32].set_bits(1u << bin % 32);
}

void GemPort::clear_event() {
  const std::uint32_t seen = registers_.isr.read();
  static_cast<void>(seen);
  registers_.rxstatus.clear(R::kRxstatusReceived);
}

std::span<const std::byte> GemPort::receive() {
  while (frame_.empty()) {
    GemDescriptor& next = memory_.receive_descriptors[next_receive_];
    const std::uint32_t address = machine::load(next.address);
    if ((address & receive_flag::kUsed) == 0) {
      break;
    }
    const std::uint32_t flags = machine::load(next.flags);
    constexpr std::uint32_t kWhole = receive_flag::kFirst | receive_flag::kLast;
    const std::size_t bytes = flags & receive_flag::kLengthBits;
    if ((flags & kWhole) == kWhole && bytes <= kMaxFrameBytes && bytes >= kMinFrameBytes) {
      std::memcpy(copy_.data(), &memory_.receive_buffers[next_receive_ * GemMemory::kBufferBytes],
                  bytes);
      frame_ = std::span(copy_).first(bytes);
      ++counters_.received;
    } else {
      ++counters_.oversized;
    }
    machine::barrier();  // read before it is given back
    machine::store(next.address, address & ~receive_flag::kUsed);
    next_receive_ = (next_receive_ + 1) % memory_.receive_descriptors.size();
  }
  return frame_;
}

// A full ring is looked at again when NWCTRL is written.
void GemPort::pump() {
  reclaim();
  if ((registers_.rxstatus.read() & R::kRxstatusNoBuffer) != 0) {
    ++counters_.receive_overflows;
    registers_.rxstatus.clear(R::kRxstatusNoBuffer);
    registers_.nwctrl.write(kRunning);
  }
}

void GemPort::reclaim() {
  while (in_flight_ > 0 && (machine::load(memory_.transmit_descriptors[oldest_in_flight_].flags) &
                            transmit_flag::kUsed) != 0) {
    oldest_in_flight_ = (oldest_in_flight_ + 1) % memory_.transmit_descriptors.size();
    --in_flight_;
  }
}

std::span<std::byte> GemPort::transmit_buffer(std::size_t index) {
  return std::span(memory_.transmit_buffers)
      .subspan(index * GemMemory::kBufferBytes, GemMemory::kBufferBytes);
}

std::span<std::byte> GemPort::acquire() {
  if (room() == 0) {
    reclaim();
  }
  if (room() == 0) {
    ++counters_.send_refused;
    return {};
  }
  is_acquired_ = true;
  return transmit_buffer(next_transmit_);
}

void GemPort::commit(std::size_t frame_bytes) {
  require(is_acquired_ && frame_bytes >= kMinFrameBytes && frame_bytes <= kMaxFrameBytes);
  is_acquired_ = false;
  machine::barrier();  // the frame, before it is the controller's
  const bool wraps = next_transmit_ + 1 == memory_.transmit_descriptors.size();
  machine::store(memory_.transmit_descriptors[next_transmit_].flags,
                 static_cast<std::uint32_t>(frame_bytes) | transmit_flag::kLast |
                     (wraps ? transmit_flag::kWrap : 0));
  next_transmit_ = (next_transmit_ + 1) % memory_.transmit_descriptors.size();
  ++in_flight_;
  ++counters_.sent;
  machine::barrier();
  registers_.nwctrl.write(kRunning | R::kNwctrlStartTransmit);
}

hal::PortLife GemPort::life() const {
  return {.moved = counters_.received + counters_.sent, .is_excused = in_flight_ == 0};
}

}  // namespace iog::zcu102
