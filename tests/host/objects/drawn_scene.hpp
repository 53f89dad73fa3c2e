// A scene drawn by hand: things that move as their equations say, a car that looks at them, and
// what a perception grid would call the cells. Nothing of it is the tracker's code.
//
// A beam every quarter of a degree all around, 40 ms a turn in five slices; each beam is cast at
// its own slice's time, with a range error of up to 3 cm. The grid is told by hand what a grid can
// know by itself: a cell that was hit for 0.8 s stands; one that was hit for less is occupied; one
// that nothing covers any more is unknown for a frame and free after it. It never says "moving"
// unless a test wants it to. Ground is open where nothing was hit in the second before.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "fakes/random.hpp"
#include "objects/frame.hpp"
#include "objects/grid_names.hpp"
#include "objects/tracker.hpp"

namespace iog::objects::tests {

// Metres, radians, counter-clockwise from x.
struct Place {
  double x = 0;
  double y = 0;
  double heading = 0;
};
// Where something is at a time in seconds.
using Motion = std::function<Place(double)>;

inline Motion at_rest(Place at) {
  return [=](double) { return at; };
}
// From `at` with so many m/s along its heading.
inline Motion straight(Place at, double speed) {
  return [=](double s) {
    return Place{at.x + speed * s * std::cos(at.heading), at.y + speed * s * std::sin(at.heading),
                 at.heading};
  };
}

struct Thing {
  Motion middle;
  double length = 4.5;
  double width = 1.8;
  bool is_told = false;          // the grid calls it moving for 0.3 s where it comes to open ground
  std::int32_t rough_mm = 30;    // the largest range error, as of leaves at any depth
  std::int32_t lost_of_ten = 0;  // beams that do not return
};

inline constexpr std::uint64_t kStartUs = 1'000'000'000;
inline constexpr double kFrameS = 0.04;

class Scene {
 public:
  Scene(Motion car, std::vector<Thing> things) : car_(std::move(car)), things_(std::move(things)) {}

  // Shows the next frame to the tracker.
  FrameCounts show(Tracker& tracker);
  // Shows frames until so many seconds have passed, and asks after each of them.
  template <typename Ask>
  void show_until(double seconds, Tracker& tracker, Ask&& ask) {
    while (now_s() < seconds - kFrameS / 2) {
      show(tracker);
      ask();
    }
  }
  void show_until(double seconds, Tracker& tracker) {
    show_until(seconds, tracker, [] {});
  }

  // The middle of the last slice.
  [[nodiscard]] double now_s() const { return frames_ * kFrameS; }
  [[nodiscard]] Place place_of(std::size_t thing) const { return things_[thing].middle(now_s()); }
  // m/s, by the difference over a millisecond.
  [[nodiscard]] std::pair<double, double> velocity_of(std::size_t thing) const {
    const Place before = things_[thing].middle(now_s() - 5e-4);
    const Place after = things_[thing].middle(now_s() + 5e-4);
    return {(after.x - before.x) / 1e-3, (after.y - before.y) / 1e-3};
  }
  // The track that has most of the last frame's hits on a thing; none if none has one.
  [[nodiscard]] const Track* track_of(std::size_t thing, const Tracker& tracker) const;
  // Of its hits in the last frame, the share on something that moves.
  [[nodiscard]] double moving_share(std::size_t thing, const Tracker& tracker) const;

  // As GridNames asks.
  [[nodiscard]] CellName look_at(geometry::Cell cell) const {
    return {.name = name_of(cell), .is_open = is_open(cell)};
  }
  [[nodiscard]] Names names_around(geometry::Cell cell) const;

  // For how long the grid calls a cell by its old name when nothing covers it any more.
  std::uint64_t lag_us = 0;
  // Within this distance of the car no beam opens a cell: the grid never calls one open or moving,
  // and keeps the old name of what was left for two seconds.
  double blind_m = 0;
  // The part of a turn in a frame, and where the first frame begins, in turns from the rear.
  double turns_of_a_frame = 1;
  double begins_at = 0;
  // The order in which the frame's hits are given.
  std::function<void(std::vector<Hit>&)> reorder = [](std::vector<Hit>&) {};
  // How the tracker is given a frame.
  std::function<FrameCounts(Tracker&, const Frame&, const GridNames&)> add =
      [](Tracker& tracker, const Frame& frame, const GridNames& grid) {
        return tracker.add(frame, grid);
      };

 private:
  static constexpr std::size_t kSlices = 5;
  static constexpr std::array<std::uint8_t, kSlices> kAges{32, 24, 16, 8, 0};
  static constexpr std::uint64_t kStandsUs = 800'000;

  struct Memory {
    std::uint64_t first_us = 0;  // of the hits without a gap
    std::uint64_t last_us = 0;
    std::uint64_t before_us = 0;  // the last one before this frame
    std::size_t thing = 0;
    bool began_open = false;  // the ground was open when the hits began
  };
  using Key = std::pair<std::int32_t, std::int32_t>;

  void look(std::uint64_t end_us, std::vector<Hit>& hits);
  void look_along(double angle, const Place& car, const std::vector<Place>& places,
                  std::uint8_t slice, std::uint64_t end_us, std::vector<Hit>& hits);
  void meet(geometry::Cell cell, std::size_t thing, std::uint64_t end_us);
  [[nodiscard]] Name name_of(geometry::Cell cell) const;
  [[nodiscard]] bool is_open(geometry::Cell cell) const;
  [[nodiscard]] bool is_blind(geometry::Cell cell) const;
  [[nodiscard]] const Memory* memory_of(geometry::Cell cell) const;

  Motion car_;
  std::vector<Thing> things_;
  iog::tests::Random random_{31};
  std::uint32_t frames_ = 0;
  std::map<Key, Memory> cells_{};
};

// The distance of a rectangle's face along a ray from (x, y); infinite if it is not met.
double distance_to(const Thing& thing, const Place& at, double x, double y, double angle);

}  // namespace iog::objects::tests
