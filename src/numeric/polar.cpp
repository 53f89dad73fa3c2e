#include "numeric/polar.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "numeric/magnitude.hpp"

namespace iog::numeric {
namespace {

// The arctangents of 2^-i in 2^-32 turns.
constexpr std::array<std::uint32_t, 22> kArctangents{
    536'870'912, 316'933'406, 167'458'907, 85'004'756, 42'667'331, 21'354'465,
    10'679'838,  5'340'245,   2'670'163,   1'335'087,  667'544,    333'772,
    166'886,     83'443,      41'722,      20'861,     10'430,     5'215,
    2'608,       1'304,       652,         326};
// The rotations lengthen a vector by 1.64676. This is 2^32 over that.
constexpr std::uint64_t kShorter = 2'608'131'496;
constexpr int kBits = 29;  // of the longest component: below 2^31 after two rotations

struct Turned {
  std::uint32_t angle = 0;
  std::int32_t length = 0;
};

// Rotates a vector onto the first axis. It must not be (0, 0).
Turned turned(std::int32_t along, std::int32_t across) {
  std::uint32_t angle = 0;
  if (along < 0) {
    along = -along;
    across = -across;
    angle = std::uint32_t{1} << 31;
  }
  for (std::size_t i = 0; i < kArctangents.size(); ++i) {
    const std::int32_t sign = across < 0 ? -1 : 1;
    const std::int32_t before = along;
    along += sign * (across >> i);
    across -= sign * (before >> i);
    angle += static_cast<std::uint32_t>(sign) * kArctangents[i];
  }
  const std::uint64_t shorter = static_cast<std::uint64_t>(along) * kShorter;
  return {angle, static_cast<std::int32_t>((shorter + (std::uint64_t{1} << 31)) >> 32)};
}

}  // namespace

Polar polar_of(std::int32_t x, std::int32_t y, std::int32_t z) {
  const auto longest =
      static_cast<std::uint32_t>(std::max({magnitude(x), magnitude(y), magnitude(z)}));
  if (longest == 0) {
    return {};
  }
  const int shift = kBits - static_cast<int>(std::bit_width(longest));
  const std::int32_t scale = std::int32_t{1} << shift;
  const Turned flat = x == 0 && y == 0 ? Turned{} : turned(x * scale, y * scale);
  const Turned whole = turned(flat.length, z * scale);
  return {
      .azimuth = flat.angle,
      .elevation = static_cast<std::int32_t>(whole.angle),
      .range = (static_cast<std::uint32_t>(whole.length) + static_cast<std::uint32_t>(scale) / 2) >>
               shift};
}

}  // namespace iog::numeric
