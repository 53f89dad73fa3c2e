#include "objects/drawn_scene.hpp"

#include <algorithm>
#include <limits>

namespace iog::objects::tests {
namespace {

constexpr double kReachM = 60;
constexpr int kBeams = 1440;
constexpr double kTurn = 6.283185307179586;

std::uint64_t us_of(double s) {
  return kStartUs + static_cast<std::uint64_t>(std::llround(s * 1e6));
}
std::int32_t mm_of(double m) { return static_cast<std::int32_t>(std::round(m * 1e3)); }
geometry::Cell cell_at(double x, double y) {
  return {static_cast<std::int32_t>(std::floor(x * 1e3 / geometry::kCellMm)),
          static_cast<std::int32_t>(std::floor(y * 1e3 / geometry::kCellMm))};
}
bool covers(const Thing& thing, const Place& at, geometry::Cell cell) {
  const Point centre = centre_of(cell);
  const double dx = centre.x_mm * 1e-3 - at.x;
  const double dy = centre.y_mm * 1e-3 - at.y;
  const double c = std::cos(at.heading);
  const double s = std::sin(at.heading);
  return std::abs(dx * c + dy * s) <= thing.length / 2 + 0.1 &&
         std::abs(dy * c - dx * s) <= thing.width / 2 + 0.1;
}

}  // namespace

double distance_to(const Thing& thing, const Place& at, double x, double y, double angle) {
  const double c = std::cos(at.heading);
  const double s = std::sin(at.heading);
  const std::array from{(x - at.x) * c + (y - at.y) * s, (y - at.y) * c - (x - at.x) * s};
  const std::array by{std::cos(angle - at.heading), std::sin(angle - at.heading)};
  const std::array half{thing.length / 2, thing.width / 2};
  double enters = 0;
  double leaves = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 2; ++i) {
    const double a = (-half[i] - from[i]) / by[i];
    const double b = (half[i] - from[i]) / by[i];
    enters = std::max(enters, std::min(a, b));
    leaves = std::min(leaves, std::max(a, b));
  }
  return enters > 0 && enters <= leaves ? enters : std::numeric_limits<double>::infinity();
}

FrameCounts Scene::show(Tracker& tracker) {
  ++frames_;
  const std::uint64_t end_us = us_of(now_s());
  std::vector<Hit> hits;
  look(end_us, hits);
  reorder(hits);
  const Place car = car_(now_s());
  const Frame frame{.end_us = end_us,
                    .car = {mm_of(car.x), mm_of(car.y)},
                    .blind_mm = mm_of(blind_m),
                    .area = window::Area::around(cell_at(car.x, car.y)),
                    .ages_ms = kAges,
                    .hits = hits};
  return add(tracker, frame, GridNames(*this));
}

void Scene::look(std::uint64_t end_us, std::vector<Hit>& hits) {
  const int beams = static_cast<int>(kBeams * turns_of_a_frame);
  const double begin =
      kTurn * std::fmod(begins_at + turns_of_a_frame * (frames_ - 1), 1) - kTurn / 2;
  for (std::size_t slice = 0; slice < kSlices; ++slice) {
    const double time = now_s() - kAges[slice] * 1e-3;
    const Place car = car_(time);
    std::vector<Place> places;
    places.reserve(things_.size());
    for (const Thing& thing : things_) {
      places.push_back(thing.middle(time));
    }
    const int of_slices = static_cast<int>(kSlices);
    const int first = static_cast<int>(slice) * beams / of_slices;
    const int end = (static_cast<int>(slice) + 1) * beams / of_slices;
    for (int number = first; number < end; ++number) {
      look_along(car.heading + begin + number * kTurn / kBeams, car, places,
                 static_cast<std::uint8_t>(slice), end_us, hits);
    }
  }
}

void Scene::look_along(double angle, const Place& car, const std::vector<Place>& places,
                       std::uint8_t slice, std::uint64_t end_us, std::vector<Hit>& hits) {
  double nearest = kReachM;
  std::size_t met = things_.size();
  for (std::size_t i = 0; i < things_.size(); ++i) {
    const double its = distance_to(things_[i], places[i], car.x, car.y, angle);
    if (its < nearest) {
      nearest = its;
      met = i;
    }
  }
  if (met == things_.size()) {
    return;
  }
  const Thing& thing = things_[met];
  if (thing.lost_of_ten == 0 || random_.between(0, 9) >= thing.lost_of_ten) {
    const double range = nearest + random_.between(-thing.rough_mm, thing.rough_mm) * 1e-3;
    const geometry::Cell cell =
        cell_at(car.x + range * std::cos(angle), car.y + range * std::sin(angle));
    hits.push_back({.cell = cell, .slice = slice});
    meet(cell, met, end_us);
  }
}

void Scene::meet(geometry::Cell cell, std::size_t thing, std::uint64_t end_us) {
  Memory& its = cells_[{cell.x, cell.y}];
  if (its.last_us == end_us) {
    return;
  }
  if (its.last_us == 0 || its.thing != thing || end_us - its.last_us > 200'000) {
    its.began_open = is_open(cell);
    its.first_us = end_us;
  }
  its.before_us = its.last_us;
  its.last_us = end_us;
  its.thing = thing;
}

const Scene::Memory* Scene::memory_of(geometry::Cell cell) const {
  const auto found = cells_.find({cell.x, cell.y});
  return found == cells_.end() ? nullptr : &found->second;
}

Name Scene::name_of(geometry::Cell cell) const {
  const Memory* its = memory_of(cell);
  if (its == nullptr) {
    return Name::kFree;
  }
  const Thing& thing = things_[its->thing];
  const std::uint64_t now_us = us_of(now_s());
  const std::uint64_t old_us = is_blind(cell) ? 2'000'000 : lag_us;
  if (now_us - its->last_us <= old_us || covers(thing, thing.middle(now_s()), cell)) {
    if (thing.is_told && !is_blind(cell) && its->began_open && now_us - its->first_us < 300'000) {
      return Name::kMoving;
    }
    return its->last_us - its->first_us >= kStandsUs ? Name::kStanding : Name::kOccupied;
  }
  return now_us - its->last_us <= 40'000 ? Name::kUnknown : Name::kFree;
}

// Of each name one class that is called so.
Names Scene::names_around(geometry::Cell cell) const {
  using decision::Class;
  const auto class_of = [](Name name) {
    switch (name) {
      case Name::kUnknown:
        return Class::kUnknown;
      case Name::kFree:
        return Class::kFree;
      case Name::kMoving:
        return Class::kMoving;
      case Name::kStanding:
        return Class::kStopped;
      case Name::kOccupied:
        break;
    }
    return Class::kOccupied;
  };
  std::uint32_t classes = 0;
  for (std::int32_t y = cell.y - 1; y <= cell.y + 1; ++y) {
    for (std::int32_t x = cell.x - 1; x <= cell.x + 1; ++x) {
      classes |= 1U << static_cast<unsigned>(class_of(name_of({x, y})));
    }
  }
  return Names(classes);
}

bool Scene::is_blind(geometry::Cell cell) const {
  const Point at = centre_of(cell);
  const Place car = car_(now_s());
  return std::hypot(at.x_mm * 1e-3 - car.x, at.y_mm * 1e-3 - car.y) < blind_m;
}

bool Scene::is_open(geometry::Cell cell) const {
  if (is_blind(cell)) {
    return false;
  }
  const std::uint64_t now_us = us_of(now_s());
  for (std::int32_t y = cell.y - 1; y <= cell.y + 1; ++y) {
    for (std::int32_t x = cell.x - 1; x <= cell.x + 1; ++x) {
      const Memory* its = memory_of({x, y});
      const std::uint64_t last = its == nullptr           ? 0
                                 : its->last_us == now_us ? its->before_us
                                                          : its->last_us;
      if (last != 0 && now_us - last < 1'000'000) {
        return false;
      }
    }
  }
  return true;
}

const Track* Scene::track_of(std::size_t thing, const Tracker& tracker) const {
  std::map<std::int16_t, int> votes;
  for (const FrameHit& hit : tracker.hits()) {
    const Memory* its = memory_of(hit.cell);
    if (its != nullptr && its->thing == thing && hit.owner != kNobody) {
      ++votes[hit.owner];
    }
  }
  const auto most = std::ranges::max_element(
      votes, [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == votes.end() ? nullptr : &tracker.tracks()[static_cast<std::size_t>(most->first)];
}

double Scene::moving_share(std::size_t thing, const Tracker& tracker) const {
  int all = 0;
  int moving = 0;
  for (const FrameHit& hit : tracker.hits()) {
    const Memory* its = memory_of(hit.cell);
    if (its != nullptr && its->thing == thing) {
      ++all;
      moving += tracker.is_moving(hit) ? 1 : 0;
    }
  }
  return all == 0 ? 0 : static_cast<double>(moving) / all;
}

}  // namespace iog::objects::tests
