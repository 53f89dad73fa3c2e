#include "perception/standing.hpp"

#include <bit>

namespace iog::perception {
namespace {

constexpr int kNear = 2;
constexpr std::uint32_t kInside = ~std::uint32_t{0} << (2 * kNear) >> kNear;

// Sets one or two neighbours on both sides of each bit, too.
constexpr std::uint32_t widened(std::uint32_t bits, bool by_two) {
  const std::uint32_t by_one = bits | bits << 1U | bits >> 1U;
  return by_two ? by_one | bits << 2U | bits >> 2U : by_one;
}

}  // namespace

bool has_standing_inside(const window::Tile& tile) {
  std::uint32_t any = 0;
  for (const std::uint32_t row : tile.found.stands) {
    any |= row;
  }
  return (any & kInside) != 0;
}

StandingCounts standing_counts(const window::Tile& tile, const window::Plane& hit,
                               const window::Plane& crossed, const Around& around) {
  const bool by_two = around.gaps == kNear;
  StandingCounts counts;
  const window::Plane& stands = tile.found.stands;
  for (std::size_t y = kNear; y < stands.size() - kNear; ++y) {
    const std::uint32_t two_away = by_two ? hit[y - 2] | hit[y + 2] : 0U;
    const std::uint32_t near = widened(two_away | hit[y - 1] | hit[y] | hit[y + 1], by_two);
    const std::uint32_t inside = stands[y] & kInside;
    counts.met += static_cast<std::uint32_t>(std::popcount(inside & near));
    counts.crossed += static_cast<std::uint32_t>(std::popcount(inside & crossed[y] & ~near));
  }
  return counts;
}

}  // namespace iog::perception
