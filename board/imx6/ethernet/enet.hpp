// The ENET is the controller of this board's Ethernet port (board/common/ethernet/port.hpp).
#pragma once

#include <cstddef>
#include <cstdint>

#include "board/common/ethernet/port.hpp"
#include "ethernet/descriptor.hpp"
#include "ethernet/management_port.hpp"
#include "ethernet/phy.hpp"
#include "registers/enet.hpp"
#include "time/gpt_clock.hpp"

namespace iog::imx6 {

class Enet {
 public:
  using Format = DescriptorFormat;
  using Mdio = imx6::Mdio;
  using Clock = GptClock;

  // The value of MRBR, a multiple of 16 below 2048. With legacy descriptors, a receive buffer size
  // of 2 KiB makes the DMA run away (FreeBSD if_ffec.c, ffec_init_locked).
  static constexpr std::uint32_t kUsableBytes = 2032;

  explicit Enet(EnetRegisters& registers) : registers_(registers) {}

  // The interface that Port requires.
  Mdio& mdio() { return mdio_; }
  void stop();
  void set_up(const PortSettings& settings);
  void run();
  phy::Identity start_phy() { return imx6::start_phy(mdio_); }
  static unsigned bin_of(const MacAddress& group);
  void set_groups(std::uint64_t groups);
  std::size_t frame_bytes(const Descriptor& descriptor, hal::PortCounters& counters);
  void gave_back(L2Cache& cache);
  void found_none(bool /*was_full*/, hal::PortCounters& /*counters*/) {}
  void send();
  void collect(hal::PortCounters& counters);
  bool can_receive() const;
  bool has_bus_error() const { return (registers_.eir.read() & EnetRegisters::kEirBusError) != 0; }
  void clear_event() { registers_.eir.clear(EnetRegisters::kEirReceivedFrame); }

 private:
  void set_address(const MacAddress& address);
  void set_frame_limits();
  void set_mode(const Link& mode);

  EnetRegisters& registers_;
  Mdio mdio_{registers_};
  bool in_long_frame_ = false;        // the buffers up to the next "last" are of a dropped frame
  std::uint32_t overflows_seen_ = 0;  // the last value of ENET_IEEE_R_MACERR
};

using EnetPort = board::Port<Enet>;
using EnetMemory = board::PortMemory<DescriptorFormat>;
static_assert(EnetMemory::kTransmitFrames == 1408);
static_assert(sizeof(EnetMemory) <= 3u << 20, "fits three sections of the DMA region");

// The memory of the firmware's only controller. The definition is constinit. For the cores, the
// addresses before and after the region are unmapped.
extern EnetMemory enet_memory;  // NOLINT(bugprone-dynamic-static-initializers)

}  // namespace iog::imx6

extern template class iog::board::Port<iog::imx6::Enet>;
