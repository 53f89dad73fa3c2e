#include "ground/low_beams.hpp"

#include <algorithm>
#include <span>

#include "ground/outlook.hpp"

namespace iog::ground {
// Visits the layers in the order in which they leave a height, as Outlook requires.
void LowBeams::find(std::uint32_t sector, const Fan& fan, std::int32_t low_mm,
                    const Surface& surface) {
  constexpr std::int32_t kUnderCarsMm = vehicle::MovedLimits::kUnderCarsMm;
  const Beams& beams = fan.beams();
  const bool comes_down = beams.origin_mm() > low_mm;
  const bool passes_under = beams.origin_mm() > kUnderCarsMm;
  const auto whole = static_cast<std::uint16_t>(beams.range_mm() / 2);
  const auto left_by = [&](Outlook& outlook, std::uint8_t layer) {
    return fan.along_2_mm(layer, outlook.leave(fan.slope(layer)));
  };
  const Surface::Row lowest = surface.lowest_near(sector);
  Outlook low(beams, lowest, low_mm, comes_down ? Side::kBelow : Side::kAbove);
  Outlook under(beams, surface.row(sector), kUnderCarsMm, Side::kBelow);
  const std::span<const std::uint8_t> layers = fan.layers();
  for (const std::uint8_t layer : layers) {
    ends_[sector][layer] = {.from_2_mm = comes_down ? left_by(low, layer) : std::uint16_t{0},
                            .to_2_mm = passes_under ? left_by(under, layer) : whole};
  }
  for (std::size_t i = comes_down ? 0 : layers.size(); i > 0; --i) {
    std::uint16_t& to_2_mm = ends_[sector][layers[i - 1]].to_2_mm;
    to_2_mm = std::min(to_2_mm, left_by(low, layers[i - 1]));
  }
}

}  // namespace iog::ground
