// Ranges: entries are below 2^31 and the gain of the place is at most 2^16. The gain of the speed
// is limited to below 2^31; without the limit, `both` up to 2^31 divided by a sum of 1 could exceed
// it. So products stay below 2^62.
#include "objects/covariance.hpp"

#include <algorithm>

#include "numeric/divisor.hpp"
#include "numeric/magnitude.hpp"

namespace iog::objects {
namespace {

std::int32_t within(std::int64_t value) {
  return static_cast<std::int32_t>(
      std::clamp<std::int64_t>(value, -Covariance::kMost, Covariance::kMost));
}

}  // namespace

void Covariance::predict(Step step, std::int32_t wander) {
  place_ = std::max(within(place_ + 2 * step.of(both_) + step.of(step.of(speed_))), kLeastVariance);
  both_ = within(both_ + step.of(speed_));
  speed_ = within(speed_ + step.of(std::int64_t{wander} * wander));
}

Covariance::Gain Covariance::measure(std::int32_t variance) {
  const auto sum = static_cast<std::uint32_t>(std::int64_t{place_} + variance);
  const numeric::Divisor divisor(sum);
  constexpr std::uint64_t kMostQuotient = INT32_MAX;
  const std::uint64_t size = static_cast<std::uint64_t>(numeric::magnitude(std::int64_t{both_}))
                             << 16;
  const std::uint32_t quotient = size >> 31 >= sum ? kMostQuotient : divisor.divide(size);
  const Gain gain{
      .place = static_cast<std::int32_t>(divisor.divide(static_cast<std::uint64_t>(place_) << 16)),
      .speed =
          both_ < 0 ? -static_cast<std::int32_t>(quotient) : static_cast<std::int32_t>(quotient)};
  speed_ = std::max(within(speed_ - (std::int64_t{gain.speed} * both_ >> 16)), kLeastVariance);
  both_ = within(both_ - (std::int64_t{gain.place} * both_ >> 16));
  place_ = std::max(within(place_ - (std::int64_t{gain.place} * place_ >> 16)), kLeastVariance);
  return gain;
}

}  // namespace iog::objects
