// IMX6DQRM, chapter "10/100/1000-Mbps Ethernet MAC (ENET)". According to its section
// "Initialization", all registers are set while ETHEREN is clear, and ETHEREN is set last.
#include "ethernet/enet.hpp"

#include "board/common/ethernet/port_functions.hpp"

template class iog::board::Port<iog::imx6::Enet>;

namespace iog::imx6 {

static_assert(hal::EthernetPort<EnetPort>);

namespace {

using R = EnetRegisters;

constexpr std::uint32_t kFcsBytes = 4;
constexpr std::uint32_t kMaxFrameWithFcs = board::kMaxFrameBytes + kFcsBytes;
// Reset takes eight clock cycles of the module. A thousand reads take 50 us.
constexpr unsigned kMaxResetPolls = 1000;
// PAUR's low half is the type of a pause frame, fixed by the standard.
constexpr std::uint32_t kPauseType = 0x8808;
// The upper half is fixed (opcode 1). The lower half is the duration of pause frames, which are
// never sent.
constexpr std::uint32_t kPauseOpcode = 0x0001'0020;
constexpr std::uint32_t kCrcPolynomial = 0xEDB8'8320;

}  // namespace

[[gnu::section(".dma")]] constinit EnetMemory enet_memory{};

// Stops the controller before the reset and keeps the byte order, because DMA in progress finishes
// in that order.
void Enet::stop() {
  registers_.eimr.write(0);
  registers_.ecr.clear_bits(R::kEcrEtherEn);
  registers_.ecr.write(R::kEcrReset);
  for (unsigned polls = 0; polls < kMaxResetPolls; ++polls) {
    if ((registers_.ecr.read() & R::kEcrReset) == 0) {
      break;
    }
  }
  registers_.eir.clear(R::kEirAll);
  // Clears the statistics, because the reset does not. Only one of them is used.
  registers_.mibc.write(R::kMibcDisable | R::kMibcClear);
  registers_.mibc.write(R::kMibcDisable);
  registers_.mibc.write(0);
  overflows_seen_ = registers_.ieee_r_macerr.read();
  in_long_frame_ = false;
}

void Enet::set_up(const PortSettings& settings) {
  set_address(settings.address);
  set_groups(settings.groups);
  set_frame_limits();
  registers_.rdsr.write(settings.receive_ring);
  registers_.tdsr.write(settings.transmit_ring);
  mdio_.start();
  set_mode(settings.mode);
}

void Enet::run() {
  registers_.ecr.set_bits(R::kEcrEtherEn);
  // RDAR must be set after ETHEREN, because clearing ETHEREN also clears RDAR.
  registers_.rdar.write(R::kRdarActive);
  // Of the controller's events, only a received frame may wake the loop.
  registers_.eimr.write(R::kEirReceivedFrame);
}

// The bin of a group is the six highest bits of the CRC-32 of its address. This is the CRC of the
// FCS before its inversion (ENET, "Ethernet address recognition"; Linux fec_main.c
// set_multicast_list, FreeBSD if_ffec.c ffec_hash_maddr). It is computed bit by bit, because it is
// needed only once.
unsigned Enet::bin_of(const MacAddress& group) {
  std::uint32_t crc = 0xFFFF'FFFF;
  for (const std::uint8_t octet : group) {
    crc ^= octet;
    for (int bit = 0; bit < 8; ++bit) {
      crc = crc >> 1 ^ ((crc & 1) != 0 ? kCrcPolynomial : 0);
    }
  }
  return crc >> 26;
}

// The filter passes our address, broadcast and the bins of joined groups. There is no second
// address. The network layer checks again, because QEMU has no filter and a bin contains many
// groups.
void Enet::set_address(const MacAddress& address) {
  const auto byte = [&address](std::size_t index) { return std::uint32_t{address[index]}; };
  registers_.palr.write(byte(0) << 24 | byte(1) << 16 | byte(2) << 8 | byte(3));
  registers_.paur.write(byte(4) << 24 | byte(5) << 16 | kPauseType);
  registers_.iaur.write(0);
  registers_.ialr.write(0);
}

void Enet::set_groups(std::uint64_t groups) {
  registers_.gaur.write(static_cast<std::uint32_t>(groups >> 32));
  registers_.galr.write(static_cast<std::uint32_t>(groups));
}

void Enet::set_frame_limits() {
  registers_.opd.write(kPauseOpcode);
  registers_.mrbr.write(kUsableBytes);
  // Truncates frames at the size in MRBR, which must not be below MAX_FL.
  static_assert(kMaxFrameWithFcs <= kUsableBytes);
  registers_.ftrl.write(kUsableBytes);
  // Transmission begins when the whole frame is in the FIFO, so slow memory cannot interrupt it.
  registers_.tfwr.write(R::kTfwrStoreAndForward);
  // No checksum insertion, no padding removal and no shift by 16 bits: buffers contain the frames
  // as on the wire.
  registers_.tacc.write(0);
  registers_.racc.write(0);
}

// Sets speed and duplex. By the manual, this requires ETHEREN to be clear (TCR.FDEN). MII_MODE
// "must always be set", even for RGMII. Pause frames are ignored (FCE clear), so a receiver that
// cannot keep up loses frames and does not stop the loop.
void Enet::set_mode(const Link& mode) {
  std::uint32_t rcr = kMaxFrameWithFcs << R::kRcrMaxFrameShift | R::kRcrMiiMode | R::kRcrRgmii;
  if (mode.speed == Link::Speed::k10) {
    rcr |= R::kRcr10Mbit;
  }
  if (!mode.full_duplex) {
    rcr |= R::kRcrHalfDuplexNoEcho;
  }
  registers_.rcr.write(rcr);
  registers_.tcr.write(mode.full_duplex ? R::kTcrFullDuplex : 0);
  // DBSWP makes descriptors little-endian, like the core. QEMU ignores the bit, but the chip does
  // not.
  const bool is_gigabit = mode.speed == Link::Speed::k1000;
  registers_.ecr.write(R::kEcrDescriptorSwap | (is_gigabit ? R::kEcrSpeed1000 : 0));
}

// The length in the last buffer is the length of the frame with its FCS. A length outside the
// bounds of a frame is never used.
std::size_t Enet::frame_bytes(const Descriptor& descriptor, hal::PortCounters& counters) {
  const std::uint16_t flags = machine::load(descriptor.flags);
  const std::size_t bytes = machine::load(descriptor.length);
  const bool last = (flags & receive_flag::kLast) != 0;
  if (in_long_frame_) {
    in_long_frame_ = !last;  // counted at its first buffer
    return 0;
  }
  if (!last || (flags & (receive_flag::kTooLong | receive_flag::kTruncated)) != 0) {
    in_long_frame_ = !last;
    ++counters.oversized;
    return 0;
  }
  constexpr std::uint16_t kBad =
      receive_flag::kNonOctet | receive_flag::kBadCrc | receive_flag::kOverrun;
  if ((flags & kBad) != 0 || bytes < board::kMinFrameBytes + kFcsBytes ||
      bytes > kMaxFrameWithFcs) {
    ++counters.receive_errors;
    return 0;
  }
  return bytes - kFcsBytes;
}

// When the controller finds no empty buffer, it stops until RDAR is written. RDAR must also be
// written after a bad frame. Otherwise, a ring full of bad frames would stop reception forever.
void Enet::gave_back(L2Cache& cache) {
  cache.drain_stores();
  registers_.rdar.write(R::kRdarActive);
}

// Erratum ERR006358: a write to TDAR is lost if the controller clears TDAR at the same time.
void Enet::send() {
  if ((registers_.tdar.read() & R::kTdarActive) == 0) {
    registers_.tdar.write(R::kTdarActive);
  }
}

// If there is no empty buffer in time, frames fill the controller's FIFO, and later frames are lost
// (IMX6DQRM, ENET_IEEE_R_MACERR: "Receive FIFO overflow count").
void Enet::collect(hal::PortCounters& counters) {
  const std::uint32_t overflows = registers_.ieee_r_macerr.read();
  counters.receive_overflows += overflows - overflows_seen_;
  overflows_seen_ = overflows;
}

// True if RDAR is active. The controller clears RDAR when it finds no empty buffer or is stopped
// (IMX6DQRM, ENET_RDAR). By the manual, a bus error clears ETHEREN.
bool Enet::can_receive() const {
  return (registers_.ecr.read() & R::kEcrEtherEn) != 0 &&
         (registers_.rdar.read() & R::kRdarActive) != 0;
}

}  // namespace iog::imx6
