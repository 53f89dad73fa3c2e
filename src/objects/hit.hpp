// A hit of a frame, as it is kept while the frame is worked on.
#pragma once

#include <cstdint>

#include "geometry/cell.hpp"
#include "objects/name.hpp"
#include "objects/plane.hpp"
#include "placing/hit_list.hpp"

namespace iog::objects {

using placing::Hit;

// No track, no cluster.
inline constexpr std::int16_t kNobody = -1;

// A line of the level 1 cache.
struct alignas(32) FrameHit {
  geometry::Cell cell{};
  Point moved{};                   // to the frame's end, with the speed of its owner
  std::int32_t age_ms = 0;         // from its slice's middle to the frame's end, 0 ... 255
  std::int16_t owner = kNobody;    // a track's slot
  std::int16_t cluster = kNobody;  // its number in the frame
  Name name = Name::kUnknown;      // of its cell
  bool is_open = false;            // the ground was known to be open
  bool stands = false;             // it, or what lies beside it, is known to stand
  bool is_old = false;             // something was there for long
  std::uint8_t oldest_epoch = 0;   // how many epochs ago something was hit there first; 0: never

  // The cell's centre.
  [[nodiscard]] constexpr Point at() const { return centre_of(cell); }
};
static_assert(sizeof(FrameHit) == 32);

}  // namespace iog::objects
