// The Ethernet port on a controller made of RAM: the test is the wire, the DMA, and the PHY.
#pragma once

#include <array>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

#include "ethernet/enet.hpp"
#include "trace.hpp"

namespace iog::imx6 {

class PortOnRam : public testing::Test {
 protected:
  static constexpr std::size_t kReceive = 4;
  static constexpr std::size_t kTransmit = 40;  // more than one burst of the shaper
  static constexpr MacAddress kAddress = {0x02, 0x11, 0x22, 0x33, 0x44, 0x55};

  PortOnRam() {
    machine::recorder.reset();
    listen();
    port_.start(kAddress);
  }

  // Forgets what was written so far.
  void forget() {
    machine::recorder.reset();
    listen();
  }

  // An event of the controller's.
  void raise(std::uint32_t event) {
    events_ |= event;
    machine::poke(registers_.eir, events_);
  }
  [[nodiscard]] std::uint32_t events() const { return events_; }

  // What the controller does with a frame: the bytes, the length with FCS, E cleared.
  void arrive(std::size_t bytes_with_fcs, std::uint16_t flags = receive_flag::kLast) {
    Descriptor& descriptor = receive_[arrived_ % kReceive];
    ASSERT_NE(descriptor.flags & receive_flag::kEmpty, 0) << "the controller has no buffer";
    receive_bytes_[arrived_ % kReceive * DescriptorFormat::kReceiveBytes] = std::byte{arrived_};
    descriptor.length = static_cast<std::uint16_t>(bytes_with_fcs);
    descriptor.flags = static_cast<std::uint16_t>((descriptor.flags & receive_flag::kWrap) | flags);
    ++arrived_;
  }

  // The controller sends what it owns, at most so many; returns how many frames.
  std::size_t send(std::size_t most) {
    std::size_t sent = 0;
    for (std::size_t count = 0; count < kTransmit && sent < most; ++count) {
      Descriptor& descriptor = transmit_[(next_sent_ + sent) % kTransmit];
      if ((descriptor.flags & transmit_flag::kReady) == 0) {
        break;
      }
      descriptor.flags &= static_cast<std::uint16_t>(~transmit_flag::kReady);
      ++sent;
    }
    next_sent_ = (next_sent_ + sent) % kTransmit;
    machine::poke(registers_.tdar, 0u);
    return sent;
  }
  std::size_t send_all() { return send(kTransmit); }

  void queue(std::size_t frames) {
    for (std::size_t count = 0; count < frames; ++count) {
      ASSERT_FALSE(port_.acquire().empty());
      port_.commit(60);
    }
  }

  void pump_at(std::uint32_t now_us) {
    machine::poke(gpt_.cnt, now_us);
    port_.pump();
  }

  // The PHY has negotiated; the port has seen it when this returns, 200 ms later.
  void link_up(std::uint32_t now_us, std::uint16_t partner, std::uint16_t gigabit_status = 0) {
    phy_[phy::kBasicStatus] = phy::kStatusLinkUp | phy::kStatusNegotiated;
    phy_[phy::kAdvertised] = 0x01e1;
    phy_[phy::kPartnerAbility] = partner;
    phy_[phy::kGigabitControl] = 0x1f00;
    phy_[phy::kGigabitStatus] = gigabit_status;
    look_at_link(now_us);
  }
  void link_down(std::uint32_t now_us) {
    phy_[phy::kBasicStatus] = 0;
    look_at_link(now_us);
  }

  EnetRegisters registers_{};
  GptRegisters gpt_{};
  Pl310Registers pl310_{};
  GptClock clock_{gpt_};
  L2Cache cache_{pl310_};
  std::array<Descriptor, kReceive> receive_{};
  std::array<Descriptor, kTransmit> transmit_{};
  std::vector<std::byte> receive_bytes_ =
      std::vector<std::byte>(kReceive * DescriptorFormat::kReceiveBytes);
  std::vector<std::byte> transmit_bytes_ =
      std::vector<std::byte>(kTransmit * board::kTransmitBytes);
  EnetPort port_{
      Enet(registers_), {receive_, receive_bytes_, transmit_, transmit_bytes_}, cache_, clock_};
  std::uint8_t arrived_ = 0;

 private:
  void listen() {
    machine::recorder.on_store = [this](const void* address, std::uint32_t value) {
      if (address == &registers_.eir) {
        events_ &= ~value;
        machine::poke(registers_.eir, events_);
      }
      if (address == &registers_.ecr && (value & EnetRegisters::kEcrReset) != 0) {
        be_reset();
      }
      if (address == &registers_.mmfr) {
        answer(value);
      }
    };
  }

  // It forgets where it was in its rings; RDAR and TDAR are cleared.
  void be_reset() {
    machine::poke(registers_.ecr, 0u);
    machine::poke(registers_.rdar, 0u);
    machine::poke(registers_.tdar, 0u);
    arrived_ = 0;
    next_sent_ = 0;
  }

  void answer(std::uint32_t frame) {
    if ((frame >> 28 & 3) == 2) {
      machine::poke(registers_.mmfr, (frame & 0xffff'0000u) | phy_[frame >> 18 & 0x1f]);
    }
    raise(EnetRegisters::kEirMii);
  }

  void look_at_link(std::uint32_t now_us) {
    for (std::uint32_t step = 0; step < 20; ++step) {
      pump_at(now_us + step * 10'000);
    }
  }

  std::uint32_t events_ = 0;
  std::size_t next_sent_ = 0;
  std::array<std::uint16_t, 32> phy_{};
};

}  // namespace iog::imx6
