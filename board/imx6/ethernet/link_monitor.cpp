#include "ethernet/link_monitor.hpp"

namespace iog::imx6 {
namespace {

// An access takes 27 us. One that takes a hundred times as long has met a bus that is stuck.
constexpr std::uint32_t kAccessTimeoutUs = 3000;

}  // namespace

std::optional<Link> LinkMonitor::poll(std::uint64_t now_us) {
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

void LinkMonitor::begin(std::size_t step, std::uint64_t now_us) {
  step_ = step;
  began_us_ = now_us;
  reading_ = true;
  mdio_.begin_read(kSequence[step]);
}

std::optional<Link> LinkMonitor::take(std::uint16_t value, std::uint64_t now_us) {
  values_[step_] = value;
  if (step_ == 0) {
    // The link bit latches low: a loss between two polls is seen once, and the link is resolved
    // anew.
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

std::optional<Link> LinkMonitor::conclude(const Link& found) {
  reading_ = false;
  if (found == link_) {
    return std::nullopt;
  }
  link_ = found;
  return link_;
}

}  // namespace iog::imx6
