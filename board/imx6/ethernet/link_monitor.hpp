// Watches the link without ever waiting: each poll starts or finishes at most one MDIO access.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "ethernet/mdio.hpp"
#include "ethernet/phy.hpp"

namespace iog::imx6 {

class LinkMonitor {
 public:
  static constexpr std::uint32_t kPeriodUs = 100'000;

  explicit LinkMonitor(Mdio& mdio) : mdio_(mdio) {}

  // The new state of the link if it has changed, nothing otherwise. Once per pass of the loop.
  std::optional<Link> poll(std::uint64_t now_us);

  // The access that has begun will not end: the controller was reset. The next round asks again.
  void abandon() { reading_ = false; }

  const Link& link() const { return link_; }

 private:
  // Read in this order, the status in every round, the abilities only when the link has come up.
  static constexpr std::array<unsigned, 5> kSequence = {phy::kBasicStatus, phy::kAdvertised,
                                                        phy::kPartnerAbility, phy::kGigabitControl,
                                                        phy::kGigabitStatus};

  void begin(std::size_t step, std::uint64_t now_us);
  std::optional<Link> conclude(const Link& found);
  std::optional<Link> take(std::uint16_t value, std::uint64_t now_us);

  Mdio& mdio_;
  Link link_;
  bool reading_ = false;
  std::size_t step_ = 0;
  std::uint64_t began_us_ = 0;
  std::array<std::uint16_t, kSequence.size()> values_{};
};

}  // namespace iog::imx6
