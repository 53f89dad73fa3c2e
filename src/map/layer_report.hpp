// What the map does for the window, and why it does nothing.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "pose/message.hpp"

namespace iog::map {

// Why no tile has a mask. The first that is met is the one.
enum class Cause : std::uint8_t {
  kNone,
  kNoMap,         // there is no block
  kNoTransform,   // the newest pose does not say where the local frame is in a map's plane
  kOtherOrigin,   // it does, of a plane of another origin
  kImprecise,     // the transform's standard deviation is above kMaxSigmaMm
  kBlurred,       // what is possible of a cell would be asked farther than kHalo away
  kNoPlace,       // the window has none: nothing is known in it
  kOutside,       // no tile of the window meets the extent of the map
  kContradicted,  // by the sensors (map/agreement.hpp): it is drawn, but names nothing
};
inline constexpr std::size_t kCauseCount = 9;

// A transform less certain than this draws nothing.
inline constexpr std::uint16_t kMaxSigmaMm = 300;

struct LayerReport {
  Cause cause = Cause::kNoMap;
  // How often each cause has begun since start; kNone: how often the map came into use.
  std::array<std::uint32_t, kCauseCount> begun{};

  std::uint32_t crc = 0;                          // names the map; 0 if there is none
  std::uint64_t origin = 0;                       // of its plane, likewise
  std::optional<pose::MapTransform> transform{};  // the newest
  std::uint8_t radius = 0;                        // of the blur, in cells; 0 where there is none

  std::uint16_t tiles_drawn = 0;    // that have a mask
  std::uint16_t tiles_outside = 0;  // that are outside of the extent
  std::uint16_t tiles_waiting = 0;
  // Of this frame:
  std::uint16_t tiles_finished = 0;   // drawn, or found outside
  std::uint16_t tiles_withdrawn = 0;  // that had a mask, and are as without a map again
  std::uint32_t work = 0;             // of kWorkPerFrame (map/layer.hpp)
};

}  // namespace iog::map
