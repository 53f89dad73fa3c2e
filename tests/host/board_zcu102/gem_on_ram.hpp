// The GEM made of RAM: the test is the wire, the DMA, and the PHY.
#pragma once

#include <array>
#include <cstdint>
#include <gtest/gtest.h>
#include <map>
#include <vector>

#include "ethernet/gem.hpp"
#include "trace.hpp"

namespace iog::zcu102 {

class GemOnRam : public testing::Test {
 protected:
  static constexpr std::size_t kReceive = 4;
  static constexpr std::size_t kTransmit = 40;  // more than one burst of the shaper
  static constexpr MacAddress kAddress = {0x02, 0x11, 0x22, 0x33, 0x44, 0x55};
  static constexpr std::uint32_t kWhole = receive_flag::kFirst | receive_flag::kLast;

  GemOnRam() {
    machine::counter_us = 0;
    machine::poke(registers_.network_status, 4u);  // MDIO is always idle
    phy_[2] = 0x0141;                              // as in QEMU
    phy_[3] = 0x0cc2;
    forget();
    port_.start(kAddress);
  }

  // Forgets what was written so far.
  void forget() {
    machine::recorder.reset();
    machine::recorder.on_store = [this](const void* address, std::uint32_t value) {
      for (auto* status : {&registers_.transmit_status, &registers_.receive_status}) {
        if (address == status) {
          machine::poke(*status, before_.at(status) & ~value);
        }
      }
      if (address == &registers_.phy_management && (value >> 28 & 3) == 2) {
        const bool is_ours = (value >> 23 & 31) == phy_address_;
        machine::poke(registers_.phy_management, is_ours ? phy_[value >> 18 & 31] : 0xffffu);
      }
    };
    machine::recorder.on_load = [this](const void* /*address*/) { remember(); };
  }
  void raise(board::W1c32& status, std::uint32_t flags) {
    machine::poke(status, flags);
    remember();
  }

  // What the controller does with a frame.
  void arrive(std::uint32_t bytes, std::uint32_t flags = kWhole) {
    Descriptor& descriptor = receive_[arrived_ % kReceive];
    ASSERT_EQ(descriptor.address & receive_flag::kOurs, 0u) << "the controller has no buffer";
    receive_bytes_[arrived_ % kReceive * DescriptorFormat::kReceiveBytes] =
        std::byte{static_cast<std::uint8_t>(arrived_)};
    descriptor.control = bytes | flags;
    descriptor.address |= receive_flag::kOurs;
    ++arrived_;
  }

  void fill_the_ring() {
    for (std::size_t count = 0; count < kReceive; ++count) {
      arrive(60);
    }
  }
  void take(std::size_t frames) {
    for (std::size_t count = 0; count < frames; ++count) {
      EXPECT_FALSE(port_.receive().empty());
      port_.release();
    }
  }

  // The controller sends what it owns, at most so many; returns how many frames.
  std::size_t send(std::size_t most = kTransmit) {
    std::size_t sent = 0;
    for (; sent < most; ++sent) {
      Descriptor& descriptor = transmit_[(sent_ + sent) % kTransmit];
      if ((descriptor.control & transmit_flag::kOurs) != 0) {
        break;
      }
      descriptor.control |= transmit_flag::kOurs;
    }
    sent_ += sent;
    return sent;
  }

  void queue(std::size_t frames) {
    for (std::size_t count = 0; count < frames; ++count) {
      ASSERT_FALSE(port_.acquire().empty());
      port_.commit(60);
    }
  }
  void pump_at(std::uint64_t at_us) {
    machine::counter_us = at_us;
    port_.pump();
  }

  // The PHY has negotiated, or lost the link; the port has seen it when this returns.
  void link_up(std::uint64_t at_us, std::uint16_t partner, std::uint16_t gigabit_status) {
    phy_[1] = 0x24;
    phy_[4] = 0x01e1;
    phy_[5] = partner;
    phy_[9] = 0x0200;
    phy_[10] = gigabit_status;
    look_at_link(at_us);
  }
  void link_down(std::uint64_t at_us) {
    phy_[1] = 0;
    look_at_link(at_us);
  }

  GemRegisters registers_{};
  CrlApbRegisters clocks_{};
  std::array<Descriptor, kReceive> receive_{};
  std::array<Descriptor, kTransmit> transmit_{};
  std::vector<std::byte> receive_bytes_ =
      std::vector<std::byte>(kReceive * DescriptorFormat::kReceiveBytes);
  std::vector<std::byte> transmit_bytes_ =
      std::vector<std::byte>(kTransmit * board::kTransmitBytes);
  UncachedMemory memory_;
  Clock clock_;
  GemPort port_{{registers_, clocks_},
                {receive_, receive_bytes_, transmit_, transmit_bytes_},
                memory_,
                clock_};
  std::size_t arrived_ = 0;
  std::size_t sent_ = 0;
  std::uint32_t counted_ = 0;  // in each statistic
  std::uint32_t phy_address_ = 12;
  std::array<std::uint16_t, 32> phy_{};

 private:
  // What the flags were before a store: a one clears only its own flag.
  void remember() {
    for (auto* status : {&registers_.transmit_status, &registers_.receive_status}) {
      before_[status] = machine::peek<std::uint32_t>(*status);
    }
  }
  void look_at_link(std::uint64_t at_us) {
    for (std::uint64_t step = 0; step < 20; ++step) {
      pump_at(at_us + step * 10'000);
    }
  }

  std::map<board::W1c32*, std::uint32_t> before_{{&registers_.transmit_status, 0},
                                                 {&registers_.receive_status, 0}};
};

}  // namespace iog::zcu102
