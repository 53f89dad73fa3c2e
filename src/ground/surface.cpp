#include "ground/surface.hpp"

#include <algorithm>

namespace iog::ground {

Surface::Row Surface::lowest_near(std::size_t sector) const {
  const Row& row = rows_[sector];
  Row lowest = row;
  for (std::size_t away = 1; away <= kNearBins; ++away) {
    for (std::size_t start = away; start < kStarts; ++start) {
      lowest[start] = std::min(lowest[start], row[start - away]);
    }
    for (std::size_t start = 0; start < kStarts - away; ++start) {
      lowest[start] = std::min(lowest[start], row[start + away]);
    }
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
