// A block as a picture: north is up.
#pragma once

#include "map/block.hpp"
#include "tools/formats/picture/canvas.hpp"

namespace iog::tools {

// Buildings are dark, roads light, both together red. The longer side has 3000 pixels at most, and
// no pixel is smaller than 10 cm. The map's attribution stands below.
[[nodiscard]] Canvas picture_of(const map::Block& block);

}  // namespace iog::tools
