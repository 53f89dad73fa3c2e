#include "objects/motion_shown.hpp"

#include <algorithm>

#include "objects/own_beams.hpp"

namespace iog::objects {
namespace {

// The time after which motion at this speed is visible.
std::uint64_t shown_after_us(const Track& track) {
  const std::int32_t way_mm = track.may_have_a_standing_face() ? kShownTrailMm : kShownWayMm;
  const std::int32_t ms = way_mm * 1000 / std::max<std::int32_t>(track.speed(), 1);
  return static_cast<std::uint64_t>(std::clamp(ms, kShownLeastMs, kShownMostMs)) * 1000;
}

// Whether it travels with the car, 0 < v e < 1.5 e^2, as the visible part of a long object does.
bool goes_with(Velocity car, Velocity its) {
  const std::int64_t square = std::int64_t{car.x} * car.x + std::int64_t{car.y} * car.y;
  const std::int64_t both = std::int64_t{its.x} * car.x + std::int64_t{its.y} * car.y;
  return both > 0 && 2 * both < 3 * square;
}

// Judges the cells of a snapshot that the track has left. An occupied cell that is hidden behind
// the track may just not have been seen again, so it is neutral. It is bad for tracks that travel
// with the car.
void weigh_left(const Snapshot& then, Point car, bool open_counts, const GridNames& grid,
                Track& track) {
  for (const geometry::Cell cell : then.all()) {
    const Point place = centre_of(cell);
    if (track.box().outside(place) <= kLeftMm) {
      continue;
    }
    const Names near = grid.names_around(cell);
    Seen& seen = track.seen;
    if (near.has<Name::kStanding>()) {
      ++seen.bad;
    } else if (near.has<Name::kOccupied>()) {
      const bool is_hidden = open_counts && track.box().is_between(car, place);
      ++(is_hidden ? seen.neutral : seen.bad);
    } else if (grid.look_at(cell).name == Name::kFree) {
      ++seen.good;
    } else {
      ++seen.neutral;
    }
  }
}

// Judges the places that a receding track has left. The grid's classes lag behind there, so this
// frame decides whether they are free. Places that are hit again are bad, because something stands
// there. For a slow track, so are places that were hit lately, if the track was too far away then
// for hits of its own.
void weigh_trail(const Snapshot& then, Point car, std::span<const std::uint16_t> numbers,
                 const Hits& hits, const GridNames& grid, Track& track) {
  const bool is_slow = track.speed() < kLayersSpeed;
  const std::int32_t lately_mm = kLeftMm + track.speed() * kLayersMs / 1000;
  const OwnBeams beams(car, numbers, hits.of_view);
  Seen& seen = track.seen;
  for (const geometry::Cell cell : then.all()) {
    const Point place = centre_of(cell);
    const std::int32_t outside = track.box().outside(place);
    if (outside <= kLeftMm) {
      continue;
    }
    if (hits.now.is_hit_around(cell) ||
        (is_slow && outside > lately_mm && hits.recent.is_hit_lately(cell))) {
      ++seen.bad;
      ++seen.kept;
    } else if (beams.pass(place)) {
      ++seen.good;
      ++seen.passed;
    } else {
      ++(grid.look_at(cell).name == Name::kFree ? seen.good : seen.neutral);
    }
  }
}

// Judges the hits at places that the track has reached. Hits that a receding track hid from the car
// at the time of the snapshot count neither way.
void weigh_reached(const Snapshot& then, Point car, bool open_counts,
                   std::span<const std::uint16_t> numbers, std::span<const FrameHit> hits,
                   Track& track) {
  Seen& seen = track.seen;
  for (const std::uint16_t number : numbers) {
    const FrameHit& hit = hits[number];
    if (then.box.outside(hit.at()) <= kLeftMm) {
      continue;
    }
    if (hit.name == Name::kMoving || (open_counts && hit.is_open)) {
      ++seen.good;
    } else if (hit.name == Name::kStanding) {
      ++seen.bad;
    } else if (!track.is_receding || !then.box.is_between(car, hit.at())) {
      ++seen.neutral;
    }
  }
}

}  // namespace

void weigh_motion(std::uint64_t now_us, const OurCar& car, std::span<const std::uint16_t> numbers,
                  const Hits& hits, const GridNames& grid, Track& track) {
  track.seen.bad = track.seen.contradicted;
  const std::uint64_t after = shown_after_us(track);
  const Snapshot* then = now_us < after ? nullptr : track.snapshots.youngest_before(now_us - after);
  if (then == nullptr) {
    return;
  }
  const bool open_counts =
      track.speed() >= kOpenSpeed && !goes_with(car.velocity, track.velocity());
  if (track.is_receding) {
    weigh_trail(*then, car.at, numbers, hits, grid, track);
  } else {
    weigh_left(*then, car.at, open_counts, grid, track);
  }
  const std::int32_t surely_bad = track.is_receding ? track.seen.bad : track.seen.contradicted;
  track.follow_trail();
  weigh_reached(*then, car.at, open_counts, numbers, hits.of_view, track);
  if (track.moves() && range_mm(car.at, track.box().at) < car.blind_mm) {
    track.seen.neutral += track.seen.bad - surely_bad;
    track.seen.bad = surely_bad;
  }
}

bool is_shown(const Seen& seen) {
  return seen.good >= std::min(kGoodHits, std::max<std::int32_t>(seen.hits, 2)) &&
         seen.good >= kGoodOverBad * seen.bad && seen.good * 2 >= seen.neutral;
}

void remember(std::uint64_t now_us, std::span<const std::uint16_t> numbers,
              std::span<const FrameHit> hits, Track& track) {
  if (!track.snapshots.is_due(now_us)) {
    return;
  }
  Snapshot& now = track.snapshots.begin(now_us, track.box());
  const auto is_its = [&, with_standing = track.may_have_a_standing_face()](std::uint16_t number) {
    return with_standing || !hits[number].stands;
  };
  const auto own = static_cast<std::size_t>(std::ranges::count_if(numbers, is_its));
  const std::size_t every = std::max<std::size_t>((own + kSnapshotHits - 1) / kSnapshotHits, 1);
  std::size_t next = 0;
  for (const std::uint16_t number : numbers) {
    if (is_its(number) && next++ % every == 0) {
      now.cells[now.count++] = hits[number].cell;
    }
  }
}

}  // namespace iog::objects
