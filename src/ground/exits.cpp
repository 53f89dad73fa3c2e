#include "ground/exits.hpp"

#include <algorithm>
#include <span>

#include "ground/outlook.hpp"

namespace iog::ground {
namespace {

// Per layer, in steps of 2 mm.
using Distances = std::array<std::uint16_t, vehicle::kMaxLayers>;

}  // namespace

void Exits::find(std::uint32_t sector, const Fan& fan, Limits limits, const Surface& surface) {
  const Beams& beams = fan.beams();
  const std::span<const std::uint8_t> layers = fan.layers();
  Distances below;
  Outlook down(beams, surface.row(sector), limits.low_mm, Side::kBelow);
  for (const std::uint8_t layer : layers) {
    below[layer] = fan.along_2_mm(layer, down.leave(fan.slope(layer)));
  }
  Row& row = rows_[sector];
  Outlook up(beams, surface.row(sector), limits.top_mm, Side::kAbove);
  std::size_t leave_below = layers.size();  // layers below this index leave below, the others above
  for (std::size_t i = layers.size(); i > 0; --i) {
    const std::uint8_t layer = layers[i - 1];
    const std::uint16_t above = fan.along_2_mm(layer, up.leave(fan.slope(layer)));
    leave_below = above < below[layer] ? i - 1 : leave_below;
    row[layer].to_2_mm = std::min(above, below[layer]);
  }
  if (!fan.is_level()) {
    return;
  }
  // Exits are farthest where the two lists meet, so the merge starts there.
  std::size_t lower = leave_below;
  std::size_t upper = leave_below;
  for (std::size_t rank = 0; rank < layers.size(); ++rank) {
    const bool is_lower = upper == layers.size() || (lower > 0 && row[layers[lower - 1]].to_2_mm >=
                                                                      row[layers[upper]].to_2_mm);
    const std::uint8_t layer = is_lower ? layers[--lower] : layers[upper++];
    row[rank].of_rank = layer;
    row[layer].rank = static_cast<std::uint8_t>(rank);
  }
}

}  // namespace iog::ground
