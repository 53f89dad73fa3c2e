// Bringing the controller up, and up again, by IMX6DQRM, chapter "10/100/1000-Mbps Ethernet MAC
// (ENET)", section "Initialization". Everything is set while ETHEREN is clear, and ETHEREN comes
// last.
#include "ethernet/enet_port.hpp"

namespace iog::imx6 {
namespace {

using R = EnetRegisters;

constexpr std::uint32_t kMaxFrameWithFcs = EnetPort::kMaxFrameBytes + 4;
// Reset takes eight clocks of the module; a thousand reads are 50 us.
constexpr unsigned kMaxResetPolls = 1000;
// The longest that the controller may rightly keep a frame: at 10 Mbit/s and half duplex it backs
// off 15 times from collisions, at most 7151 slots of 51.2 us in all (802.3, 4.2.3.2.5), and sends
// 16 times for 1.2 ms, 386 ms. At full duplex it is 1.2 ms. Half a second is also many passes of
// the loop, each of which wakes a transmitter that only slept (erratum ERR006358).
constexpr std::uint64_t kStuckUs = 500'000;
// Of a bus that stays bad: at most so often.
constexpr std::uint64_t kBusErrorPauseUs = 100'000;
// PAUR's low half is the type of a pause frame, fixed by the standard.
constexpr std::uint32_t kPauseType = 0x8808;
// Opcode 1 is fixed in the upper half; the lower half is how long a pause of ours would be.
constexpr std::uint32_t kPauseOpcode = 0x0001'0020;
constexpr std::uint32_t kCrcPolynomial = 0xEDB8'8320;

}  // namespace

[[gnu::section(".dma")]] constinit EnetMemory enet_memory{};

void EnetPort::start(const MacAddress& address) {
  address_ = address;
  set_up(Link{});
  phy_ = start_phy(mdio_);
  run();
}

// All that must not change while ETHEREN is set, and the rings, which the controller forgets when
// it is cleared.
void EnetPort::set_up(const Link& mode) {
  reset();
  set_address();
  set_frame_limits();
  receive_ring_.start();
  transmit_ring_.start();
  registers_.rdsr.write(receive_ring_.bus_address());
  registers_.tdsr.write(transmit_ring_.bus_address());
  mdio_.start();
  set_mode(mode);
}

void EnetPort::run() {
  registers_.ecr.set_bits(R::kEcrEtherEn);
  // Only now: RDAR is cleared whenever ETHEREN is.
  registers_.rdar.write(R::kRdarActive);
  // A received frame is the one event that may end the loop's sleep.
  registers_.eimr.write(R::kEirReceivedFrame);
}

// Stops first, and leaves the order of octets as it is: DMA that is under way ends in that order.
void EnetPort::reset() {
  registers_.eimr.write(0);
  registers_.ecr.clear_bits(R::kEcrEtherEn);
  registers_.ecr.write(R::kEcrReset);
  for (unsigned polls = 0; polls < kMaxResetPolls; ++polls) {
    if ((registers_.ecr.read() & R::kEcrReset) == 0) {
      break;
    }
  }
  registers_.eir.clear(R::kEirAll);
  // The statistics count from 0; reset does not clear them. One is used.
  registers_.mibc.write(R::kMibcDisable | R::kMibcClear);
  registers_.mibc.write(R::kMibcDisable);
  registers_.mibc.write(0);
}

namespace {

// A group has the bin that the six highest bits of the CRC-32 of its address name: that of the FCS
// before it is inverted (ENET, "Ethernet address recognition"; Linux fec_main.c set_multicast_list,
// FreeBSD if_ffec.c ffec_hash_maddr). One bit at a time, because it happens once.
std::uint64_t bin_of(const MacAddress& group) {
  std::uint32_t crc = 0xFFFF'FFFF;
  for (const std::uint8_t octet : group) {
    crc ^= octet;
    for (int bit = 0; bit < 8; ++bit) {
      crc = crc >> 1 ^ ((crc & 1) != 0 ? kCrcPolynomial : 0);
    }
  }
  return std::uint64_t{1} << (crc >> 26);
}

}  // namespace

// The filter lets our address, broadcast and the bins of joined groups through; no second address
// is answered to. The network layer checks again, because QEMU has no filter and a bin many groups.
void EnetPort::set_address() {
  const auto byte = [this](std::size_t index) { return std::uint32_t{address_[index]}; };
  registers_.palr.write(byte(0) << 24 | byte(1) << 16 | byte(2) << 8 | byte(3));
  registers_.paur.write(byte(4) << 24 | byte(5) << 16 | kPauseType);
  registers_.iaur.write(0);
  registers_.ialr.write(0);
  set_groups();
}

void EnetPort::set_groups() {
  registers_.gaur.write(static_cast<std::uint32_t>(groups_ >> 32));
  registers_.galr.write(static_cast<std::uint32_t>(groups_));
}

// The table may change while frames come; a restart writes it again.
void EnetPort::join(const MacAddress& group) {
  groups_ |= bin_of(group);
  set_groups();
}

void EnetPort::set_frame_limits() {
  registers_.opd.write(kPauseOpcode);
  registers_.mrbr.write(ReceiveRing::kUsableBytes);
  // Truncate where MRBR ends, which must not be below MAX_FL.
  static_assert(kMaxFrameWithFcs <= ReceiveRing::kUsableBytes);
  registers_.ftrl.write(ReceiveRing::kUsableBytes);
  // A frame goes out when all of it is in the FIFO: memory may be slow, the wire must not notice.
  registers_.tfwr.write(R::kTfwrStoreAndForward);
  // No checksum insertion, no padding removal, no shift by 16 bits: frames are what is on the wire.
  registers_.tacc.write(0);
  registers_.racc.write(0);
}

// Speed and duplex, by the manual only while ETHEREN is clear (TCR.FDEN). MII_MODE "must always be
// set", for RGMII too. Pause frames are not obeyed (FCE clear): a receiver that cannot keep up
// loses frames, it does not stop the loop.
void EnetPort::set_mode(const Link& mode) {
  mode_ = mode;
  std::uint32_t rcr = kMaxFrameWithFcs << R::kRcrMaxFrameShift | R::kRcrMiiMode | R::kRcrRgmii;
  if (mode.speed == Link::Speed::k10) {
    rcr |= R::kRcr10Mbit;
  }
  if (!mode.full_duplex) {
    rcr |= R::kRcrHalfDuplexNoEcho;
  }
  registers_.rcr.write(rcr);
  registers_.tcr.write(mode.full_duplex ? R::kTcrFullDuplex : 0);
  // DBSWP: descriptors are little-endian, like the core. QEMU ignores the bit, silicon does not.
  const bool is_gigabit = mode.speed == Link::Speed::k1000;
  registers_.ecr.write(R::kEcrDescriptorSwap | (is_gigabit ? R::kEcrSpeed1000 : 0));
}

// A bus error has stopped the controller by the manual ("ETHEREN is cleared"), a frame that never
// leaves has stopped the transmitter whatever the reason, and another speed or duplex may be set
// only while it is stopped. A link that is down keeps the mode it had.
bool EnetPort::must_start_anew(std::uint64_t now_us) {
  const bool stuck = is_stuck(now_us);  // always asked: it watches
  const Link& link = link_monitor_.link();
  const bool mode_differs =
      link.up && (link.speed != mode_.speed || link.full_duplex != mode_.full_duplex);
  const bool bus_error =
      (registers_.eir.read() & R::kEirBusError) != 0 && now_us - restarted_us_ >= kBusErrorPauseUs;
  return acquired_.empty() && (stuck || mode_differs || bus_error);
}

// Whether frames are in flight and none has left for kStuckUs. Without a link that is no wonder: it
// may be the PHY that has stopped the clock.
bool EnetPort::is_stuck(std::uint64_t now_us) {
  const std::uint32_t sent = transmit_ring_.sent();
  if (transmit_ring_.in_flight() == 0 || sent != progress_sent_ || !link_monitor_.link().up) {
    progress_sent_ = sent;
    progress_us_ = now_us;
  }
  return now_us - progress_us_ >= kStuckUs;
}

// What waits in either ring is lost, and counted: of half a ring it is not known where the
// controller was. Takes some 0.2 ms, most of it the descriptors.
void EnetPort::start_anew(std::uint64_t now_us) {
  ++counters_.restarts;
  counters_.lost_received += static_cast<std::uint32_t>(receive_ring_.waiting());
  counters_.lost_unsent +=
      static_cast<std::uint32_t>(transmit_ring_.queued() + transmit_ring_.in_flight());
  counters_.receive_overflows += registers_.ieee_r_macerr.read();
  in_long_frame_ = false;
  link_monitor_.abandon();
  const Link& link = link_monitor_.link();
  set_up(link.up ? link : mode_);
  run();
  restarted_us_ = now_us;
  progress_us_ = now_us;
}

}  // namespace iog::imx6
