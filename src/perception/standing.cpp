#include "perception/standing.hpp"

#include <bit>

namespace iog::perception {
namespace {

constexpr std::size_t kNear = 2;
constexpr std::uint32_t kInside = ~std::uint32_t{0} << (2 * kNear) >> kNear;

// Sets the two neighbours on both sides of each bit, too.
constexpr std::uint32_t widened(std::uint32_t bits) {
  return bits | bits << 1U | bits << 2U | bits >> 1U | bits >> 2U;
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
                               const window::Plane& crossed) {
  StandingCounts counts;
  const window::Plane& stands = tile.found.stands;
  for (std::size_t y = kNear; y < stands.size() - kNear; ++y) {
    const std::uint32_t near = widened(hit[y - 2] | hit[y - 1] | hit[y] | hit[y + 1] | hit[y + 2]);
    const std::uint32_t inside = stands[y] & kInside;
    counts.met += static_cast<std::uint32_t>(std::popcount(inside & near));
    counts.crossed += static_cast<std::uint32_t>(std::popcount(inside & crossed[y] & ~near));
  }
  return counts;
}

}  // namespace iog::perception
