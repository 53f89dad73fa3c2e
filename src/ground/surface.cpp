#include "ground/surface.hpp"

#include "numeric/division.hpp"

namespace iog::ground {

// Compares nearby starts with a straight continuation of the ground. Its slope is the less steep
// one of the six bins before and the six bins behind, or level if one rises and the other falls.
// All heights are in sixths of a millimetre.
Surface::Row Surface::lowest_near(std::size_t sector) const {
  constexpr std::int32_t kSlopeBins = 6;
  const Row& row = rows_[sector];
  const auto height = [&](std::int32_t start) -> std::int32_t {
    return row[static_cast<std::size_t>(std::clamp<std::int32_t>(start, 0, kBins))];
  };
  Row lowest{};
  for (std::int32_t start = 0; start <= std::int32_t{kBins}; ++start) {
    const std::int32_t before = height(start) - height(start - kSlopeBins);
    const std::int32_t behind = height(start + kSlopeBins) - height(start);
    const std::int32_t slope = before > 0 && behind > 0   ? std::min(before, behind)
                               : before < 0 && behind < 0 ? std::max(before, behind)
                                                          : 0;
    constexpr std::int32_t kNear = kNearBins;
    const std::int32_t last = std::min(start + kNear, std::int32_t{kBins});
    std::int32_t least = height(start);
    std::int32_t least_in_sixths = kSlopeBins * least;
    for (std::int32_t near = std::max<std::int32_t>(start - kNear, 0); near <= last; ++near) {
      least = std::min(least, height(near));
      least_in_sixths =
          std::min(least_in_sixths, kSlopeBins * height(near) - (near - start) * slope);
    }
    lowest[static_cast<std::size_t>(start)] =
        static_cast<std::int16_t>(std::max(least, numeric::div_floor(least_in_sixths, kSlopeBins)));
  }
  return lowest;
}

std::size_t Surface::count(Source source) const {
  std::size_t sectors = 0;
  for (std::size_t sector = 0; sector < kSectors; ++sector) {
    sectors += this->source(sector) == source ? 1U : 0U;
  }
  return sectors;
}

void Surface::keep(std::size_t sector) {
  std::uint8_t& turns = turns_kept_[sector];
  if (turns == kNever) {
    return;
  }
  if (turns == kMostTurnsKept) {
    turns = kNever;
    rows_[sector] = {};
    return;
  }
  ++turns;
}

void Surface::forget() {
  for (Row& row : rows_) {
    row.fill(0);
  }
  turns_kept_.fill(kNever);
}

}  // namespace iog::ground
