// Gigabit Ethernet controller (Cadence GEM), UG1087 module "GEM"; UG1085 chapter "GEM Ethernet".
#pragma once

#include <cstddef>

#include "registers/register.hpp"

namespace iog::zcu102 {

struct GemRegisters {
  Rw32 network_control;
  Rw32 network_config;
  Ro32 network_status;
  Gap<0x00c, 0x010> gap_00c;
  Rw32 dma_config;
  W1c32 transmit_status;
  Rw32 receive_q_ptr;
  Rw32 transmit_q_ptr;
  W1c32 receive_status;
  W1c32 int_status;
  Rw32 int_enable;
  Rw32 int_disable;
  Gap<0x030, 0x034> gap_030;
  Rw32 phy_management;
  Gap<0x038, 0x080> gap_038;
  Rw32 hash_bottom;
  Rw32 hash_top;
  Rw32 spec_add1_bottom;
  Rw32 spec_add1_top;
  Gap<0x090, 0x184> gap_090;
  Ro32 undersize_frames;
  Ro32 excessive_rx_length;
  Ro32 rx_jabbers;
  Ro32 fcs_errors;
  Ro32 rx_length_errors;
  Ro32 rx_symbol_errors;
  Ro32 alignment_errors;
  Ro32 rx_resource_errors;
  Ro32 rx_overruns;
  Gap<0x1a8, 0x440> gap_1a8;
  Rw32 transmit_q1_ptr;
  Gap<0x444, 0x480> gap_444;
  Rw32 receive_q1_ptr;
  Gap<0x484, 0x4c8> gap_484;
  Rw32 upper_tx_q_base_addr;
  Gap<0x4cc, 0x4d4> gap_4cc;
  Rw32 upper_rx_q_base_addr;

  static constexpr std::uint32_t kControlReceive = 1u << 2;
  static constexpr std::uint32_t kControlTransmit = 1u << 3;
  static constexpr std::uint32_t kControlManagement = 1u << 4;
  static constexpr std::uint32_t kControlClearStatistics = 1u << 5;
  static constexpr std::uint32_t kControlStartTransmit = 1u << 9;
  static constexpr std::uint32_t kConfig100 = 1u << 0;
  static constexpr std::uint32_t kConfigFullDuplex = 1u << 1;
  static constexpr std::uint32_t kConfigMulticastHash = 1u << 6;
  static constexpr std::uint32_t kConfigGigabit = 1u << 10;
  static constexpr std::uint32_t kConfigRemoveFcs = 1u << 17;
  static constexpr std::uint32_t kConfigMdcBy224 = 7u << 18;
  static constexpr std::uint32_t kConfigBus64 = 1u << 21;
  static constexpr std::uint32_t kNetworkManagementIdle = 1u << 2;
  static constexpr std::uint32_t kDmaBurst16 = 0x10;
  static constexpr std::uint32_t kDmaWholePacketMemory = 3u << 8 | 1u << 10;
  static constexpr unsigned kDmaBufferShift = 16;  // in units of 64 bytes
  static constexpr std::uint32_t kDmaAddress64 = 1u << 30;
  static constexpr std::uint32_t kTransmitBusError = 1u << 8 | 1u << 4;
  static constexpr std::uint32_t kReceiveNoBuffer = 1u << 0;
  static constexpr std::uint32_t kReceiveBusError = 1u << 3;
  static constexpr std::uint32_t kInterruptReceived = 1u << 1;
  static constexpr std::uint32_t kAll = 0xffff'ffff;
};

static_assert(offsetof(GemRegisters, dma_config) == 0x010);
static_assert(offsetof(GemRegisters, int_disable) == 0x02c);
static_assert(offsetof(GemRegisters, phy_management) == 0x034);
static_assert(offsetof(GemRegisters, hash_bottom) == 0x080);
static_assert(offsetof(GemRegisters, spec_add1_top) == 0x08c);
static_assert(offsetof(GemRegisters, undersize_frames) == 0x184);
static_assert(offsetof(GemRegisters, rx_overruns) == 0x1a4);
static_assert(offsetof(GemRegisters, transmit_q1_ptr) == 0x440);
static_assert(offsetof(GemRegisters, receive_q1_ptr) == 0x480);
static_assert(offsetof(GemRegisters, upper_tx_q_base_addr) == 0x4c8);
static_assert(offsetof(GemRegisters, upper_rx_q_base_addr) == 0x4d4);

// The clocks of GEM3 in the low-power domain (UG1087 module "CRL_APB").
struct CrlApbRegisters {
  Gap<0x000, 0x05c> gap_000;
  Rw32 gem3_ref_ctrl;

  static constexpr std::uint32_t kReceiveActive = 1u << 26;
  static constexpr std::uint32_t kActive = 1u << 25;
  static constexpr unsigned kDivisor1Shift = 16;
  static constexpr unsigned kDivisor0Shift = 8;
  static constexpr std::uint32_t kFromIoPll = 0;
};

static_assert(offsetof(CrlApbRegisters, gem3_ref_ctrl) == 0x05c);

}  // namespace iog::zcu102
