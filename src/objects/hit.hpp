// A hit of the current frame, with the data that tracking adds to it.
#pragma once

#include <cstdint>

#include "geometry/cell.hpp"
#include "objects/name.hpp"
#include "objects/plane.hpp"
#include "placing/hit_list.hpp"

namespace iog::objects {

using placing::Hit;

// The value kNobody means that a hit has no track or no cluster.
inline constexpr std::int16_t kNobody = -1;

// A FrameHit fits into one L1 cache line.
struct alignas(32) FrameHit {
  geometry::Cell cell{};
  Point moved{};  // position at the end of the frame, predicted with the velocity of its owner
  std::int32_t age_ms = 0;       // from the middle of its slice to the end of the frame, 0 ... 255
  std::int16_t owner = kNobody;  // slot of a track
  std::int16_t cluster = kNobody;  // number of a cluster in the frame
  Name name = Name::kUnknown;      // class of its cell
  bool is_open = false;            // the ground was known to be open
  bool stands = false;             // its cell or a neighbouring cell is classified as standing
  bool is_old = false;             // standing, or the place was hit long before
  std::uint8_t oldest_epoch = 0;   // number of epochs since the place was first hit; 0 if it was
                                   // not hit before
  std::uint8_t contradicted = 0;   // number of tracks that it contradicts
  std::uint8_t contradicted_track = 0;  // slot of the first of them

  // Returns the centre of the hit's cell.
  [[nodiscard]] constexpr Point at() const { return centre_of(cell); }
};
static_assert(sizeof(FrameHit) == 32);

}  // namespace iog::objects
