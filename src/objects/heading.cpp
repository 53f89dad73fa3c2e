#include "objects/heading.hpp"

#include <algorithm>

#include "numeric/square_root.hpp"
#include "objects/edges.hpp"

namespace iog::objects {
namespace {

// As a unit vector. |x|, |y| < 2^17 keep products within a word; length > 0.
Direction unit(std::int32_t x, std::int32_t y, std::int32_t length) {
  constexpr std::int32_t kOne = 1 << kDirectionBits;
  return {x * kOne / length, y * kOne / length};
}
static_assert(std::int64_t{kMostSpeed} << kDirectionBits <= INT32_MAX);

// The speed must exceed this many deviations before the box turns towards it.
std::int32_t deviations_of(const Track& track) {
  return track.moves() ? kTurnMovingDeviations : kTurnDeviations;
}

}  // namespace

void turn(std::span<const std::uint16_t> numbers, std::span<const FrameHit> hits, Track& track) {
  if (track.has_heading() && track.speed() < kWheelsSpeed &&
      longest_of(track.box().sides) > kSmallMm) {
    track.fade_across();
  }
  const bool is_slow =
      track.speed() < kTurnSpeed || track.speed_deviation() * deviations_of(track) > track.speed();
  const bool is_sure_enough =
      track.is_sure_car() && track.speed() >= std::max(kTurnSureSpeed, track.speed_deviation());
  if (track.updates < kTurnFrom || (is_slow && !is_sure_enough)) {
    return;
  }
  const Velocity its = track.velocity();
  Direction towards = unit(its.x, its.y, track.speed());
  if (track.has_heading()) {
    const Direction now = track.box().along;
    const std::int32_t share = is_slow ? kTurnSlowShare : kTurnShare;
    towards = {now.x + (towards.x - now.x) / share, now.y + (towards.y - now.y) / share};
  }
  const auto length = static_cast<std::int32_t>(numeric::square_root(static_cast<std::uint64_t>(
      std::int64_t{towards.x} * towards.x + std::int64_t{towards.y} * towards.y)));
  if (length == 0) {
    return;
  }
  track.turn(unit(towards.x, towards.y, length));
  if (!track.has_heading()) {
    track.begin_heading(sides_of(edges_of(track.box(), numbers, hits)));
  }
}

}  // namespace iog::objects
