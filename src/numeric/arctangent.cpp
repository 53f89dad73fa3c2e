#include "numeric/arctangent.hpp"

#include "numeric/rotation.hpp"

namespace iog::numeric {
namespace {

constexpr int kHeadBits = 16;  // of the 32 bits of an angle

// x > 0, y >= 0. Returns 0 ... 2^14, because an angle just below a quarter is rounded up to it.
std::uint32_t angle_in_quarter(std::int64_t x, std::int64_t y) {
  std::uint32_t angle = 0;
  for (std::uint32_t bit = 1U << 14; bit != 0; bit >>= 1) {
    const Rotation bound = rotation_of(((angle + bit) << kHeadBits) - (1U << (kHeadBits - 1)));
    if (bound.cos_q30 * y >= bound.sin_q30 * x) {
      angle += bit;
    }
  }
  return angle;
}

}  // namespace

std::uint16_t angle_of(std::int32_t x, std::int32_t y) {
  if (x == 0 && y == 0) {
    return 0;
  }
  std::int64_t along = x;
  std::int64_t across = y;
  std::uint32_t quarters = 0;
  while (along <= 0 || across < 0) {  // rotates back by a quarter, at most three times
    const std::int64_t before = along;
    along = across;
    across = -before;
    ++quarters;
  }
  return static_cast<std::uint16_t>((quarters << 14) + angle_in_quarter(along, across));
}

}  // namespace iog::numeric
