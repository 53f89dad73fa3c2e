// When a service is offered to everybody: the phases of a server (AUTOSAR
// PRS_SOMEIPServiceDiscoveryProtocol, "Startup Behavior"). After a delay drawn at random the first
// offer, then some that follow each other at twice the distance each time, then one a second.
#pragma once

#include <cstdint>

namespace iog::discovery {

inline constexpr std::uint32_t kInitialDelayMinUs = 10'000;
inline constexpr std::uint32_t kInitialDelayMaxUs = 100'000;
inline constexpr std::uint32_t kRepetitionsBaseUs = 100'000;
inline constexpr unsigned kRepetitionsMax = 3;
inline constexpr std::uint32_t kCyclicOfferUs = 1'000'000;

// How long an offer holds: a client that has missed two knows that the target is gone.
inline constexpr std::uint32_t kOfferTtlS = 3;

// Time never goes backwards from call to call.
class OfferSchedule {
 public:
  // noise: what the initial delay is drawn from; another target has another.
  constexpr explicit OfferSchedule(std::uint32_t noise) : noise_(noise) {}

  // True in the initial wait phase, in which nothing is offered and no question answered.
  [[nodiscard]] constexpr bool is_waiting() const { return offers_ == 0; }

  // Whether an offer is due, which then counts as sent. Time begins with the first call. Offers
  // that were missed are not made up for.
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
  // Within its bounds by the upper half of the noise; 2^16 * 90,000 needs more than 32 bits.
  [[nodiscard]] constexpr std::uint32_t initial_delay_us() const {
    constexpr std::uint32_t kRangeUs = kInitialDelayMaxUs - kInitialDelayMinUs;
    return kInitialDelayMinUs +
           static_cast<std::uint32_t>(std::uint64_t{noise_ >> 16} * kRangeUs >> 16);
  }

  std::uint32_t noise_;
  std::uint64_t next_us_ = 0;
  unsigned offers_ = 0;  // of the first and the repeated ones
  bool has_begun_ = false;
};

}  // namespace iog::discovery
