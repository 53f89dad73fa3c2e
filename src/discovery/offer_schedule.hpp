// Schedules a service's offers according to the server phases of AUTOSAR
// PRS_SOMEIPServiceDiscoveryProtocol (section "Startup Behavior"). The first offer is sent after a
// random delay. The next few offers follow at intervals that double each time. After that, one
// offer is sent per second.
#pragma once

#include <cstdint>

namespace iog::discovery {

inline constexpr std::uint32_t kInitialDelayMinUs = 10'000;
inline constexpr std::uint32_t kInitialDelayMaxUs = 100'000;
inline constexpr std::uint32_t kRepetitionsBaseUs = 100'000;
inline constexpr unsigned kRepetitionsMax = 3;
inline constexpr std::uint32_t kCyclicOfferUs = 1'000'000;

// The lifetime of an offer. If a client has missed two consecutive offers, it assumes that the
// target has left.
inline constexpr std::uint32_t kOfferTtlS = 3;

// The times passed to an OfferSchedule must not decrease.
class OfferSchedule {
 public:
  // `noise` is a random value that determines the initial delay. This value must differ between
  // targets.
  constexpr explicit OfferSchedule(std::uint32_t noise) : noise_(noise) {}

  // Returns true in the initial wait phase. In this phase, the server sends neither offers nor
  // answers.
  [[nodiscard]] constexpr bool is_waiting() const { return offers_ == 0; }

  // Returns true if an offer is due, and counts it as sent. Time starts with the first call. Missed
  // offers are not sent later.
  [[nodiscard]] constexpr bool take_due(std::uint64_t now_us) {
    if (!has_begun_) {
      has_begun_ = true;
      next_us_ = now_us + initial_delay_us();
    }
    if (now_us < next_us_) {
      return false;
    }
    next_us_ =
        now_us + (offers_ < kRepetitionsMax ? kRepetitionsBaseUs << offers_ : kCyclicOfferUs);
    offers_ = offers_ < kRepetitionsMax ? offers_ + 1 : offers_;
    return true;
  }

 private:
  // Maps the upper 16 bits of the noise to a delay between the two bounds. The product
  // 2^16 * 90,000 needs more than 32 bits.
  [[nodiscard]] constexpr std::uint32_t initial_delay_us() const {
    constexpr std::uint32_t kRangeUs = kInitialDelayMaxUs - kInitialDelayMinUs;
    return kInitialDelayMinUs +
           static_cast<std::uint32_t>(std::uint64_t{noise_ >> 16} * kRangeUs >> 16);
  }

  std::uint32_t noise_;
  std::uint64_t next_us_ = 0;
  unsigned offers_ = 0;  // counts the first and the repeated offers
  bool has_begun_ = false;
};

}  // namespace iog::discovery
