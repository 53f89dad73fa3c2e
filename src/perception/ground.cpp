#include "perception/ground.hpp"

namespace iog::perception {
namespace {

// Whether the bit is missing in a cell that is not beside a standing one.
bool is_lacking(const window::Plane& plane, const window::Plane& beside) {
  std::uint32_t bits = 0;
  for (std::size_t y = 0; y < plane.size(); ++y) {
    bits |= ~(plane[y] | beside[y]);
  }
  return bits != 0;
}

window::Plane cells_beside(const window::Window& window, std::size_t slot, const Around& around) {
  const window::NinePlanes stands = window.around(slot, &window::Found::stands);
  if (window::Window::are_empty(stands)) {
    return window::Plane{};
  }
  return window::middle_of(window::dilated(window::gather<1>(stands), around.beside));
}

// A tile without a seen cell has no dense cell. A tile without a freed cell has no free space: each
// of its cells lies in a square of at most 5 by 5 cells inside the tile, and the closing does not
// fill an empty square.
window::Plane cells_seen_around(const window::Window& window, std::size_t slot,
                                const Around& around) {
  if (!window.may_have(slot, &window::Found::seen) ||
      window::is_empty(window.tile(slot).found.seen)) {
    return window::Plane{};
  }
  return window::middle_of(
      window::eroded(window::gather<2>(window.around(slot, &window::Found::seen)), around.gaps));
}

window::Plane cells_open_around(const window::Window& window, std::size_t slot,
                                const Around& around) {
  if (!window.may_have(slot, &window::Found::freed) ||
      window::is_empty(window.tile(slot).found.freed)) {
    return window::Plane{};
  }
  const window::Rows closed = window::eroded(
      window::dilated(window::gather<7>(window.around(slot, &window::Found::freed)), around.gaps),
      around.gaps);
  const window::NinePlanes taken = window.around(slot, &window::Found::taken);
  return window::middle_of(
      window::eroded(window::Window::are_empty(taken)
                         ? closed
                         : window::joined<window::AndNot>(closed, window::gather<3>(taken)),
                     around.open));
}

}  // namespace

void remember(window::Window& window, std::size_t slot, bool is_new_period, const Around& around) {
  const window::Plane beside = cells_beside(window, slot, around);
  // Properties that all cells have already are not computed, because they persist.
  const window::Ground& before = window.tile(slot).ground;
  const window::Plane dense =
      is_lacking(before.dense, beside) ? cells_seen_around(window, slot, around) : window::Plane{};
  const window::Plane open = is_new_period || is_lacking(before.open, beside)
                                 ? cells_open_around(window, slot, around)
                                 : window::Plane{};
  const std::uint32_t period = is_new_period ? ~0U : 0U;
  window::Ground& ground = window.ground(slot);
  for (std::size_t y = 0; y < geometry::kTileSide; ++y) {
    const std::uint32_t kept = ~beside[y];
    const std::uint32_t low = ground.ticks_low[y];
    const std::uint32_t high = ground.ticks_high[y];
    const std::uint32_t up = open[y] & period & ~(low & high);
    ground.open[y] = (ground.open[y] | open[y]) & kept;
    ground.dense[y] = (ground.dense[y] | dense[y]) & kept;
    ground.ticks_low[y] = (low ^ up) & kept;
    ground.ticks_high[y] = (high ^ (up & low)) & kept;
  }
}

// Only half of the slots take their turn in a frame. It is a new period if one has begun since
// their previous turn.
void GroundMemory::end_frame(window::Window& window, placing::FrameEvidence& evidence,
                             const Frame& frame, const work::Crew& crew, work::Beside beside) {
  const std::size_t parity = frame.number % 2;
  const std::uint64_t period = frame.time_us / kPeriodUs;
  const bool is_new_period = last_turns_[parity].value_or(period) != period;
  last_turns_[parity] = period;
  before_.begin();
  const work::Runs runs(window::kSlotCount, kEnded);
  crew.share(
      runs.count(),
      [&](std::size_t item, std::size_t core) {
        keep_before(window, runs[item], item, core);
        for (std::size_t slot = runs[item].first; slot < runs[item].end; ++slot) {
          evidence.clear(slot);
          if (slot % 2 == parity && window.is_known(slot)) {
            remember(window, slot, is_new_period, around_);
          }
        }
      },
      beside);
}

void GroundMemory::keep_before(window::Window& window, work::Run run, std::size_t item,
                               std::size_t core) {
  if (Before* const before = before_.of(core)) {
    for (std::size_t slot = run.first; slot < run.end; ++slot) {
      (*before)[slot - run.first] = window.tile(slot).ground;
    }
    before_.keep(core, item);
  } else if (const Before* const left = before_.of_lost(item)) {
    for (std::size_t slot = run.first; slot < run.end; ++slot) {
      if (window.is_known(slot)) {
        window.ground(slot) = (*left)[slot - run.first];
      }
    }
  }
}

}  // namespace iog::perception
