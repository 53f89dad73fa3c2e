// Reports how the map affects the window, or why the map has no effect.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "pose/message.hpp"

namespace iog::map {

// The reason why the map has no effect. If several causes apply, only the first one in this list is
// reported.
enum class Cause : std::uint8_t {
  kNone,
  kNoMap,         // no block
  kNoTransform,   // the newest pose has no transform from the local frame to a map
  kOtherOrigin,   // the transform refers to a map with a different origin
  kImprecise,     // the standard deviation of the transform is above kMaxSigmaMm
  kBlurred,       // the radius of the blur exceeds kHalo
  kNoPlace,       // the window has no position, so it is unknown
  kOutside,       // no tile of the window overlaps the extent of the map
  kContradicted,  // contradicted by the sensors (map/agreement.hpp): drawn, but without effect
};
inline constexpr std::size_t kCauseCount = 9;

// If the standard deviation of the transform exceeds this limit, no tile is drawn.
inline constexpr std::uint16_t kMaxSigmaMm = 300;

struct LayerReport {
  Cause cause = Cause::kNoMap;
  // How often each cause has become active since start-up. The entry for kNone counts how often the
  // map has taken effect.
  std::array<std::uint32_t, kCauseCount> begun{};

  std::uint32_t crc = 0;                          // identifies the map; 0 if there is none
  std::uint64_t origin = 0;                       // of its plane; 0 if there is none
  std::optional<pose::MapTransform> transform{};  // the newest one
  std::uint8_t radius = 0;                        // of the blur, in cells; 0 if there is none

  std::uint16_t tiles_drawn = 0;    // with a mask
  std::uint16_t tiles_outside = 0;  // outside the extent
  std::uint16_t tiles_waiting = 0;
  // The following counts refer only to this frame.
  std::uint16_t tiles_finished = 0;   // drawn, or found to be outside
  std::uint16_t tiles_withdrawn = 0;  // lost their mask, so that the map has no effect on them
  std::uint32_t work = 0;             // out of kWorkPerFrame (map/layer.hpp)
};

}  // namespace iog::map
