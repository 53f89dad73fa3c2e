// Monitors the link without blocking. Each poll starts or finishes at most one MDIO access.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "board/common/ethernet/clause_22.hpp"

namespace iog::board {

template <typename Mdio>
class LinkMonitor {
 public:
  static constexpr std::uint32_t kPeriodUs = 100'000;
  // An access takes 27 us at 2.4 MHz and 150 us at 0.4 MHz. If an access takes twenty times as
  // long, the bus is stuck.
  static constexpr std::uint32_t kAccessTimeoutUs = 3000;

  explicit LinkMonitor(Mdio& mdio) : mdio_(mdio) {}

  // Returns the new state of the link if the state has changed. Call this function once per pass of
  // the loop.
  std::optional<Link> poll(std::uint64_t now_us) {
    if (!reading_) {
      if (now_us - began_us_ >= kPeriodUs) {
        begin(0, now_us);
      }
      return std::nullopt;
    }
    if (mdio_.finished()) {
      return take(mdio_.result(), now_us);
    }
    if (now_us - began_us_ >= kAccessTimeoutUs) {
      return conclude(Link{});
    }
    return std::nullopt;
  }

  // Call this function after a reset of the controller, because an access that was started before
  // the reset never finishes. The next poll starts a new access.
  void abandon() { reading_ = false; }

  const Link& link() const { return link_; }

 private:
  // The registers in reading order. The status is read in every round. The other registers are read
  // only after the link has come up.
  static constexpr std::array<unsigned, 5> kSequence = {phy::kBasicStatus, phy::kAdvertised,
                                                        phy::kPartnerAbility, phy::kGigabitControl,
                                                        phy::kGigabitStatus};

  void begin(std::size_t step, std::uint64_t now_us) {
    step_ = step;
    began_us_ = now_us;
    reading_ = true;
    mdio_.begin_read(kSequence[step]);
  }

  std::optional<Link> take(std::uint16_t value, std::uint64_t now_us) {
    values_[step_] = value;
    if (step_ == 0) {
      // The link bit latches low. A loss between two polls is therefore seen once, and the mode is
      // resolved again.
      constexpr std::uint16_t kReady = phy::kStatusLinkUp | phy::kStatusNegotiated;
      if ((value & kReady) != kReady || value == 0xffff) {
        return conclude(Link{});
      }
      if (link_.up) {
        reading_ = false;
        return std::nullopt;
      }
    }
    if (step_ + 1 < kSequence.size()) {
      begin(step_ + 1, now_us);
      return std::nullopt;
    }
    return conclude(phy::resolve(values_[1], values_[2], values_[3], values_[4]));
  }

  std::optional<Link> conclude(const Link& found) {
    reading_ = false;
    if (found == link_) {
      return std::nullopt;
    }
    link_ = found;
    return link_;
  }

  Mdio& mdio_;
  Link link_;
  bool reading_ = false;
  std::size_t step_ = 0;
  std::uint64_t began_us_ = 0;
  std::array<std::uint16_t, kSequence.size()> values_{};
};

}  // namespace iog::board
