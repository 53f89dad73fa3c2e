// Bringing the controller up, by IMX6DQRM, chapter "10/100/1000-Mbps Ethernet MAC (ENET)", section
// "Initialization". Everything is set while ETHEREN is clear, and ETHEREN comes last.
#include "ethernet/enet_port.hpp"

namespace iog::imx6 {
namespace {

using R = EnetRegisters;

constexpr std::uint32_t kMaxFrameWithFcs = EnetPort::kMaxFrameBytes + 4;
// Reset takes eight clocks of the module; a thousand reads are 50 us.
constexpr unsigned kMaxResetPolls = 1000;
// PAUR's low half is the type of a pause frame, fixed by the standard.
constexpr std::uint32_t kPauseType = 0x8808;
// Opcode 1 is fixed in the upper half; the lower half is how long a pause of ours would be.
constexpr std::uint32_t kPauseOpcode = 0x0001'0020;

}  // namespace

[[gnu::section(".dma")]] constinit EnetMemory enet_memory{};

void EnetPort::start(const MacAddress& address) {
  reset();
  set_address(address);
  set_frame_limits();
  receive_ring_.start();
  transmit_ring_.start();
  registers_.rdsr.write(receive_ring_.bus_address());
  registers_.tdsr.write(transmit_ring_.bus_address());
  mdio_.start();
  phy_ = phy::start(mdio_);
  // DBSWP: descriptors are little-endian, like the core. QEMU ignores the bit, silicon does not.
  registers_.ecr.write(R::kEcrDescriptorSwap);
  apply(Link{});
  registers_.ecr.set_bits(R::kEcrEtherEn);
  // Only now: RDAR is cleared whenever ETHEREN is.
  registers_.rdar.write(R::kRdarActive);
  // A received frame is the one event that may end the loop's sleep.
  registers_.eimr.write(R::kEirReceivedFrame);
}

void EnetPort::reset() {
  registers_.ecr.write(R::kEcrReset);
  for (unsigned polls = 0; polls < kMaxResetPolls; ++polls) {
    if ((registers_.ecr.read() & R::kEcrReset) == 0) {
      break;
    }
  }
  registers_.eimr.write(0);
  registers_.eir.clear(R::kEirAll);
  // The statistics count from 0; reset does not clear them. One is used.
  registers_.mibc.write(R::kMibcDisable | R::kMibcClear);
  registers_.mibc.write(R::kMibcDisable);
  registers_.mibc.write(0);
}

// The filter lets our address and broadcast through. All hash tables empty: no group is joined and
// no second address answered to. The network layer checks again, because QEMU has no filter.
void EnetPort::set_address(const MacAddress& address) {
  const auto byte = [&address](std::size_t index) { return std::uint32_t{address[index]}; };
  registers_.palr.write(byte(0) << 24 | byte(1) << 16 | byte(2) << 8 | byte(3));
  registers_.paur.write(byte(4) << 24 | byte(5) << 16 | kPauseType);
  registers_.iaur.write(0);
  registers_.ialr.write(0);
  registers_.gaur.write(0);
  registers_.galr.write(0);
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

// Speed and duplex. The manual allows RCR and TCR to change while the controller runs; MII_MODE
// "must always be set", for RGMII too. Pause frames are not obeyed (FCE clear): a receiver that
// cannot keep up loses frames, it does not stop the loop.
void EnetPort::apply(const Link& link) {
  std::uint32_t rcr = kMaxFrameWithFcs << R::kRcrMaxFrameShift | R::kRcrMiiMode | R::kRcrRgmii;
  if (link.speed == Link::Speed::k10) {
    rcr |= R::kRcr10Mbit;
  }
  if (!link.full_duplex) {
    rcr |= R::kRcrHalfDuplexNoEcho;
  }
  registers_.rcr.write(rcr);
  registers_.tcr.write(link.full_duplex ? R::kTcrFullDuplex : 0);
  if (link.speed == Link::Speed::k1000) {
    registers_.ecr.set_bits(R::kEcrSpeed1000);
  } else {
    registers_.ecr.clear_bits(R::kEcrSpeed1000);
  }
}

}  // namespace iog::imx6
