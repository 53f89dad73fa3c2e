#include "numeric/rotation.hpp"

namespace iog::numeric {

// The difference of two table entries is below 2^21 and a fraction below 2^20, so the product is
// below 2^41.
std::int32_t sine_of(std::uint32_t angle) {
  constexpr int kTickBits = 12;
  constexpr int kFractionBits = 32 - kTickBits;
  constexpr SineTable kTable = kSineTable<1 << kTickBits>;
  const std::uint32_t tick = angle >> kFractionBits;
  const std::int64_t fraction = angle % (1U << kFractionBits);
  const std::int32_t here = kTable.sine(tick);
  const std::int32_t step = kTable.sine((tick + 1) % (1U << kTickBits)) - here;
  const std::int64_t risen = (step * fraction + (1 << (kFractionBits - 1))) >> kFractionBits;
  return here + static_cast<std::int32_t>(risen);
}

Rotation rotation_of(std::uint32_t angle) {
  constexpr std::uint32_t kQuarter = 1U << 30;
  return {.cos_q30 = sine_of(angle + kQuarter), .sin_q30 = sine_of(angle)};
}

}  // namespace iog::numeric
