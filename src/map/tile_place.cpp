// Widths. Let the local frame be at P = (X, Y) in the plane with heading h. A point p of the plane
// is at R(-h) (p - P) in the local frame.
//
// Coefficients: with 256 fine units per cell and 2^25 per unit, 1 cm is 2^33 * 10 / cell_mm, at
// most 2^30.7. They are rounded to the nearest, 2^-26 fine units per centimetre: 0.25 fine units at
// the border of the largest map, 84 km away, and a hundredth of that at 1 km. The sine table is
// accurate to 2^-21: 0.5 mm per kilometre.
//
// Products with 2^23 cm: below 2^53.7, two of them below 2^54.7.
//
// The origin: |cos X + sin Y| <= sqrt(2) 10^9 * 2^30 < 2^60.4, times 200 / cell_mm <= 4 below
// 2^62.4, and after the division by 25 below 2^57.8. A tile's corner is within 2^31 mm, 2^58.4 at
// 50 mm. The sum is below 2^60.
//
// Fine coordinates: a tile that overlaps the map is within its extent, and so are vertices. No two
// of these are farther apart than sqrt(2) 2^24 cm, 2^22.2 cells of 50 mm. So fine coordinates and
// their differences are below 2^30.2.
#include "map/tile_place.hpp"

#include <numeric>

#include "numeric/division.hpp"
#include "numeric/magnitude.hpp"
#include "numeric/rotation.hpp"

namespace iog::map {
namespace {

constexpr std::int64_t kOne = std::int64_t{1} << numeric::kSineFractionBits;

constexpr std::int64_t tile_mm_of(std::int32_t cell_mm) {
  return std::int64_t{window::kTileSide} * cell_mm;
}

// Scales by 2^33 * 10 / cell_mm / 2^30.
std::int32_t coefficient(std::int32_t q30, std::int32_t cell_mm) {
  return static_cast<std::int32_t>(
      numeric::div_nearest<std::int64_t>(std::int64_t{q30} * 80, cell_mm));
}

// Negates, and converts from 2^-30 mm to 2^-25 fine units by the factor 2^-30 * 2^33 / cell_mm =
// 200 / cell_mm / 25, rounded down.
std::int64_t offset(std::int64_t q30_mm, std::int32_t cell_mm) {
  const std::int64_t whole = std::gcd(200, cell_mm);
  return numeric::div_floor<std::int64_t>(-q30_mm * (200 / whole), cell_mm / whole * 25);
}

}  // namespace

TilePlace::TilePlace(const pose::Pose& local_frame, window::TileNumber tile, std::int32_t cell_mm)
    : cell_mm_(cell_mm) {
  const numeric::Rotation turn = numeric::rotation_of(local_frame.heading);
  const std::int64_t cos = turn.cos_q30;
  const std::int64_t sin = turn.sin_q30;
  cos_ = coefficient(turn.cos_q30, cell_mm);
  sin_ = coefficient(turn.sin_q30, cell_mm);
  const auto corner = [](std::int32_t number) {
    constexpr std::int64_t kHalfUnit = std::int64_t{1} << (kScaleBits - 1);
    return kHalfUnit -
           (std::int64_t{number} * window::kTileSide - kHalo) * (std::int64_t{kFine} << kScaleBits);
  };
  x_ = offset(cos * local_frame.x_mm + sin * local_frame.y_mm, cell_mm) + corner(tile.a);
  y_ = offset(cos * local_frame.y_mm - sin * local_frame.x_mm, cell_mm) + corner(tile.b);

  const std::int64_t tile_mm = tile_mm_of(cell_mm);
  const std::int64_t x_mm = tile.a * tile_mm + tile_mm / 2;
  const std::int64_t y_mm = tile.b * tile_mm + tile_mm / 2;
  middle_x_mm_ = local_frame.x_mm + ((cos * x_mm - sin * y_mm) >> numeric::kSineFractionBits);
  middle_y_mm_ = local_frame.y_mm + ((sin * x_mm + cos * y_mm) >> numeric::kSineFractionBits);
  // Rotations from the table are not quite orthogonal, which doubles the error of 2^-20 of the
  // distance to the tile.
  slack_mm_ = 20 + ((numeric::magnitude(x_mm) + numeric::magnitude(y_mm)) >> 19);
  reach_q30_ = numeric::magnitude(cos) + numeric::magnitude(sin);
}

// Not inline: in loops of its callers the compiler would keep the coefficients in 64 bits, and use
// 64-bit multiplications.
FinePoint TilePlace::fine(PointCm point) const {
  const std::int64_t x = std::int64_t{cos_} * point.x + std::int64_t{sin_} * point.y + x_;
  const std::int64_t y = std::int64_t{cos_} * point.y - std::int64_t{sin_} * point.x + y_;
  return {static_cast<std::int32_t>(x >> kScaleBits), static_cast<std::int32_t>(y >> kScaleBits)};
}

FineBox TilePlace::fine_box(const BoxCm& box) const {
  const bool is_right = cos_ >= 0;
  const bool is_up = sin_ >= 0;
  const FinePoint x_low = fine({is_right ? box.low.x : box.high.x, is_up ? box.low.y : box.high.y});
  const FinePoint x_high =
      fine({is_right ? box.high.x : box.low.x, is_up ? box.high.y : box.low.y});
  const FinePoint y_low = fine({is_up ? box.high.x : box.low.x, is_right ? box.low.y : box.high.y});
  const FinePoint y_high =
      fine({is_up ? box.low.x : box.high.x, is_right ? box.high.y : box.low.y});
  return {{x_low.x, y_low.y}, {x_high.x, y_high.y}};
}

BoxCm TilePlace::box(std::int32_t cells_around) const {
  const std::int64_t half_mm = std::int64_t{window::kTileSide / 2 + cells_around} * cell_mm_;
  const std::int64_t reach_mm = ((half_mm * reach_q30_) >> numeric::kSineFractionBits) + slack_mm_;
  const auto low = [reach_mm](std::int64_t middle_mm) {
    return static_cast<std::int32_t>(numeric::div_floor<std::int64_t>(middle_mm - reach_mm, 10));
  };
  const auto high = [reach_mm](std::int64_t middle_mm) {
    return static_cast<std::int32_t>(numeric::div_floor<std::int64_t>(middle_mm + reach_mm, 10));
  };
  return {{low(middle_x_mm_), low(middle_y_mm_)}, {high(middle_x_mm_), high(middle_y_mm_)}};
}

// A corner c moves by d + (R' - R) c. In 2^-30 mm: |c| < 2^30 mm and |d| < 2^31 mm, so each of the
// three terms is at most 2^61. Small movements are below 2^9 mm, 2^19 after the shift.
bool has_moved(window::TileNumber tile, const pose::Pose& from, const pose::Pose& to,
               std::int32_t cell_mm) {
  constexpr int kDropped = 20;
  const std::int64_t tile_mm = tile_mm_of(cell_mm);
  const std::int64_t cell = cell_mm * (kOne >> kDropped);
  const numeric::Rotation before = numeric::rotation_of(from.heading);
  const numeric::Rotation after = numeric::rotation_of(to.heading);
  const std::int64_t cos = std::int64_t{after.cos_q30} - before.cos_q30;
  const std::int64_t sin = std::int64_t{after.sin_q30} - before.sin_q30;
  const std::int64_t x = (std::int64_t{to.x_mm} - from.x_mm) * kOne;
  const std::int64_t y = (std::int64_t{to.y_mm} - from.y_mm) * kOne;
  for (std::int32_t corner = 0; corner < 4; ++corner) {
    const std::int64_t corner_x = (tile.a + corner % 2) * tile_mm;
    const std::int64_t corner_y = (tile.b + corner / 2) * tile_mm;
    const std::int64_t by_x = (x + cos * corner_x - sin * corner_y) >> kDropped;
    const std::int64_t by_y = (y + sin * corner_x + cos * corner_y) >> kDropped;
    const bool is_near = numeric::magnitude(by_x) <= cell && numeric::magnitude(by_y) <= cell;
    if (!is_near || by_x * by_x + by_y * by_y > cell * cell) {
      return true;
    }
  }
  return false;
}

}  // namespace iog::map
