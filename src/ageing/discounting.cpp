#include "ageing/discounting.hpp"

namespace iog::ageing {
namespace {

// Converts from units of 2^-31 to units of 2^-15, rounding down. 1 becomes the bit pattern of
// kWhole in an int16.
constexpr std::int16_t factor(std::uint32_t left) { return static_cast<std::int16_t>(left >> 16); }
static_assert(factor(kUndecayed) == evidence::kWhole);

std::uint32_t left_of_occupied(std::uint32_t ms, Discounting discounting, const Decays& decays,
                               std::uint32_t dynamic, std::uint32_t fixed) {
  switch (discounting) {
    case Discounting::kOptimistic:
      return kUndecayed;
    case Discounting::kClassical:
      return dynamic;
    case Discounting::kProportional:
      return decay(decays.shared, ms);
    case Discounting::kConservative:
      break;
  }
  return product(dynamic, fixed);
}

}  // namespace

evidence::Fading left_after(std::uint32_t ms, Discounting discounting, const Decays& decays) {
  if (ms > 65'535) {
    return evidence::kForgotten;
  }
  const std::uint32_t dynamic = decay(decays.dynamic, ms);
  const std::uint32_t fixed =
      discounting == Discounting::kClassical ? dynamic : decay(decays.fixed, ms);
  return {.free = factor(dynamic),
          .occupied = factor(left_of_occupied(ms, discounting, decays, dynamic, fixed)),
          .moving = factor(dynamic),
          .standing = factor(fixed),
          .persistence = factor(fixed)};
}

}  // namespace iog::ageing
