#include "app/object_follower.hpp"

#include <algorithm>
#include <array>

namespace iog::app {
namespace {

class NamesOf {
 public:
  explicit NamesOf(const window::WindowView& window) : window_(window) {}

  [[nodiscard]] objects::CellName look_at(geometry::Cell cell) const {
    return {.name = objects::name_of(decision::class_of(window_.name_of(cell))),
            .is_open = window_.is_open(cell)};
  }
  [[nodiscard]] objects::Names names_around(geometry::Cell cell) const {
    return objects::Names(window_.classes_around(cell));
  }

 private:
  window::WindowView window_;
};

// Hits per task of a round.
constexpr std::size_t kLookedAt = 64;

// Confidence of a class label, 1 to 7: it grows with that of the track.
std::uint8_t sureness_of(const objects::Track& track) {
  return static_cast<std::uint8_t>(std::min<std::int32_t>(track.confidence / 2 + 1, 7));
}

// The most hits of a frame whose neighbour cells are labelled, too.
constexpr std::uint32_t kMostBeside = 1024;

// Labels the occupied neighbours of a moving object's hit that lie within its box. They were hit in
// an earlier turn, and belong to the object, too.
void name_beside(const objects::FrameHit& hit, const objects::Track& track,
                 perception::WindowFusion& window) {
  const window::WindowView view = window.view();
  // Most hits have no such neighbour.
  if (!objects::Names(view.classes_around(hit.cell)).has<objects::Name::kOccupied>()) {
    return;
  }
  for (std::int32_t y = hit.cell.y - 1; y <= hit.cell.y + 1; ++y) {
    for (std::int32_t x = hit.cell.x - 1; x <= hit.cell.x + 1; ++x) {
      const geometry::Cell cell{x, y};
      const auto its = decision::class_of(view.name_of(cell));
      if (its == decision::Class::kOccupied && track.box().outside(objects::centre_of(cell)) == 0) {
        window.name_moving(cell, sureness_of(track));
      }
    }
  }
}

}  // namespace

void ObjectFollower::begin(std::uint64_t end_us, std::span<const fusion::PlacedSlice> slices,
                           const pose::Pose& car, const perception::WindowFusion& window) {
  std::array<std::uint8_t, objects::kMostSlices> ages_ms{};
  const std::size_t count = std::min(slices.size(), ages_ms.size());
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t middle_us = std::min(slices[i].slice.middle_us, end_us);
    ages_ms[i] =
        static_cast<std::uint8_t>(std::min<std::uint64_t>((end_us - middle_us) / 1000, 0xFF));
  }
  is_begun_ = tracker_.begin({.end_us = end_us,
                              .car = {car.x_mm, car.y_mm},
                              .blind_mm = window.blind_mm(),
                              .area = window.view().area(),
                              .ages_ms = std::span(ages_ms).first(count),
                              .hits = window.hits()});
}

void ObjectFollower::look_at_hits(const perception::WindowFusion& window, const work::Crew& crew) {
  if (!is_begun_) {
    return;
  }
  const NamesOf names(window.view());
  const std::size_t hits = tracker_.hits().size();
  crew.share(work::items_of(hits, kLookedAt), [&](std::size_t item, std::size_t /*core*/) {
    const std::size_t first = item * kLookedAt;
    tracker_.look_at_hits(first, std::min(kLookedAt, hits - first), objects::GridNames(names));
  });
}

objects::FrameCounts ObjectFollower::follow(perception::WindowFusion& window) {
  objects::FrameCounts counts;
  if (is_begun_) {
    const NamesOf names(window.view());
    counts = tracker_.end(objects::GridNames(names));
  }
  counts.hits.beyond += window.hits_left();
  name(window);
  return counts;
}

void ObjectFollower::pass(std::uint64_t end_us, perception::WindowFusion& window) {
  tracker_.pass(end_us);
  name(window);
}

void ObjectFollower::name(perception::WindowFusion& window) const {
  std::uint32_t beside = 0;
  for (const objects::FrameHit& hit : tracker_.hits()) {
    if (tracker_.is_moving(hit)) {
      const objects::Track& track = tracker_.tracks()[static_cast<std::size_t>(hit.owner)];
      window.name_moving(hit.cell, sureness_of(track));
      if (beside++ < kMostBeside) {
        name_beside(hit, track, window);
      }
    }
  }
  window.withdraw_moving([this](geometry::Cell first, std::uint32_t asked) {
    return tracker_.in_moving_boxes(first, asked);
  });
}

}  // namespace iog::app
