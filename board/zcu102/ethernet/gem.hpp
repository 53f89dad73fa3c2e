// The GEM is the controller of this board's Ethernet port (board/common/ethernet/port.hpp). The
// GEM's DMA bypasses the cache-coherent interconnect.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "board/common/ethernet/port.hpp"
#include "ethernet/descriptor.hpp"
#include "ethernet/management_port.hpp"
#include "ethernet/phy.hpp"
#include "registers/gem.hpp"
#include "time/clock.hpp"

namespace iog::zcu102 {

class Gem {
 public:
  using Format = DescriptorFormat;
  using Mdio = zcu102::Mdio;
  using Clock = zcu102::Clock;

  Gem(GemRegisters& registers, CrlApbRegisters& clocks) : registers_(registers), clocks_(clocks) {}

  // The interface that Port requires.
  Mdio& mdio() { return mdio_; }
  void stop();
  void set_up(const PortSettings& settings);
  void run();
  phy::Identity start_phy() { return zcu102::start_phy(mdio_); }
  static unsigned bin_of(const MacAddress& group);
  void set_groups(std::uint64_t groups);
  std::size_t frame_bytes(const Descriptor& descriptor, hal::PortCounters& counters);
  void gave_back(DescriptorFormat::Memory& /*memory*/) {}
  void found_none(bool was_full, hal::PortCounters& counters);
  void send() { registers_.network_control.set_bits(GemRegisters::kControlStartTransmit); }
  void collect(hal::PortCounters& counters);
  bool can_receive() const;
  bool has_bus_error() const;
  // According to UG1087, writing a one clears an event. In QEMU, reading clears the event.
  void clear_event() { registers_.int_status.clear(registers_.int_status.read()); }

 private:
  void set_rings(std::uint32_t receive, std::uint32_t transmit);
  void set_address(const MacAddress& address);
  void set_mode(const Link& mode);

  GemRegisters& registers_;
  CrlApbRegisters& clocks_;
  Mdio mdio_{registers_};
  std::uint32_t overflows_seen_ = 0;  // value of receive_overflows when the ring was last full
};

using GemPort = board::Port<Gem>;
using GemMemory = board::PortMemory<DescriptorFormat>;
// The memory of the firmware's only controller, and one descriptor for the unused queue of each
// direction. Their definitions are constinit. NOLINTBEGIN(bugprone-dynamic-static-initializers)
extern GemMemory gem_memory;
extern std::array<Descriptor, 2> parked_queues;
// NOLINTEND(bugprone-dynamic-static-initializers)
static_assert(sizeof(GemMemory) + sizeof(parked_queues) <= 4u << 20, "fits two blocks of 2 MiB");

}  // namespace iog::zcu102

extern template class iog::board::Port<iog::zcu102::Gem>;
