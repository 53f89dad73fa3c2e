#include "ground/surface.hpp"

namespace iog::ground {

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
