// Ranges: the counts of a round are at most the cells of the window, 2^20, and their products with
// a share 2^30.
#include "map/agreement.hpp"

#include <bit>
#include <cstddef>

namespace iog::map {

window::Plane inside_buildings(const TileMask& mask) {
  window::Plane inside;
  for (std::size_t row = 0; row < inside.size(); ++row) {
    inside[row] = mask.building[row] & ~(mask.road[row] | mask.intermediate[row]);
  }
  return inside;
}

void Agreement::add(const window::Plane& free, const window::Plane& inside) {
  for (std::size_t row = 0; row < free.size(); ++row) {
    free_ += static_cast<std::uint32_t>(std::popcount(free[row]));
    inside_ += static_cast<std::uint32_t>(std::popcount(free[row] & inside[row]));
  }
}

void Agreement::end_round(std::int32_t cell_mm) {
  const auto cells = [area = static_cast<std::uint32_t>(cell_mm * cell_mm)](std::uint32_t usual) {
    constexpr std::uint32_t kUsualArea = geometry::kUsualCellMm * geometry::kUsualCellMm;
    return (usual * kUsualArea + area - 1) / area;
  };
  if (free_ >= cells(kFewestFree)) {
    const bool speaks_against =
        is_contradicted_ ? inside_ * kAgreeingShare <= free_
                         : inside_ >= cells(kFewestInside) && inside_ * kContradictingShare > free_;
    rounds_ = speaks_against ? rounds_ + 1 : 0;
    if (rounds_ == (is_contradicted_ ? kAgreeingRounds : kContradictingRounds)) {
      is_contradicted_ = !is_contradicted_;
      rounds_ = 0;
    }
  }
  free_ = 0;
  inside_ = 0;
}

}  // namespace iog::map
