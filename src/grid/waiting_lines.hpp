// What waits to be carved of a lidar that turns: hundreds of lines, and of each line its points. A
// point is a word, so that they fit into the caches; what becomes of it on its line is worked out
// when the line is carved.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "grid/beam_carver.hpp"
#include "grid/free_steps.hpp"
#include "lidar/scan_point.hpp"
#include "vehicle/beam.hpp"

namespace iog::grid {

// A point that carves or marks: its range along the line, its layer and what becomes of it, in one
// word.
class WaitingPoint {
 public:
  WaitingPoint() = default;
  // Its range is at most lidar::kMaxRangeMm.
  WaitingPoint(const WaitingBeam& its, std::uint32_t layer)
      : word_(its.evidence.bits() << kEvidenceAt |
              static_cast<std::uint32_t>(its.is_tall) << kTallAt | layer << kLayerAt |
              its.range_mm) {}

  [[nodiscard]] std::uint32_t along_mm() const { return word_ & lidar::kMaxRangeMm; }
  [[nodiscard]] std::uint32_t layer() const {
    return word_ >> kLayerAt & (vehicle::kMaxLayers - 1);
  }
  [[nodiscard]] bool is_tall() const { return (word_ >> kTallAt & 1U) != 0; }
  [[nodiscard]] vehicle::Evidence evidence() const {
    return vehicle::Evidence::of(word_ >> kEvidenceAt);
  }
  [[nodiscard]] WaitingBeam beam() const {
    return {.range_mm = along_mm(), .evidence = evidence(), .is_tall = is_tall()};
  }

 private:
  static constexpr int kLayerAt = 20;
  static constexpr int kTallAt = 27;
  static constexpr int kEvidenceAt = 28;  // the highest bits
  static_assert(lidar::kMaxRangeMm < 1U << kLayerAt &&
                vehicle::kMaxLayers <= 1U << (kTallAt - kLayerAt) &&
                kEvidenceAt + vehicle::Evidence::kBits <= 32);

  std::uint32_t word_ = 0;
};

// Some of a sensor's layers, by their ranks (turn_lines.hpp).
class RankSet {
 public:
  // False if it is there already.
  [[nodiscard]] bool insert(std::uint32_t rank) {
    std::uint32_t& word = words_[rank / 32];
    const std::uint32_t bit = kFirstBit >> rank % 32;
    const bool is_new = (word & bit) == 0;
    word |= bit;
    return is_new;
  }

  // Calls visit(rank) for each, in rising order, as long as it says true.
  template <typename Visit>
  void visit_while(Visit&& visit) const {
    for (std::uint32_t first = 0; first < vehicle::kMaxLayers; first += 32) {
      std::uint32_t word = words_[first / 32];
      while (word != 0) {
        const auto zeros = static_cast<std::uint32_t>(std::countl_zero(word));
        word &= ~(kFirstBit >> zeros);
        if (!visit(first + zeros)) {
          return;
        }
      }
    }
  }

 private:
  static constexpr std::uint32_t kFirstBit = std::uint32_t{1} << 31;

  std::array<std::uint32_t, vehicle::kMaxLayers / 32> words_{};
};

// The lines of a lidar that turns that wait at a time, each in the place that its azimuth step
// gives it. So many follow one another: lasers of an HDL-64E look up to 17 degrees to the side of
// one another, 390 of 8,192 steps.
class WaitingLines {
 public:
  // What a point asks of the line in its place, in a cache line; the points are apart. Of those
  // that are behind the band, as TurnLayer says, only the layers count.
  struct alignas(32) Line {
    std::uint32_t azimuth_step = kNone;
    std::uint32_t count = 0;
    vehicle::Ranges on_car;
    RankSet behind;
  };

  // Whether points of this line can be added.
  [[nodiscard]] bool has_room(std::uint32_t azimuth_step) const {
    const Line& line = lines_[azimuth_step % kPlaces];
    return line.azimuth_step == azimuth_step && line.count < kMostPoints;
  }
  // Begins it in its place, where none waits.
  void begin(std::uint32_t azimuth_step, const vehicle::Ranges& on_car) {
    lines_[azimuth_step % kPlaces] = {
        .azimuth_step = azimuth_step, .count = 0, .on_car = on_car, .behind = {}};
  }
  // Only if it has room.
  [[nodiscard]] const vehicle::Ranges& on_car(std::uint32_t azimuth_step) const {
    return lines_[azimuth_step % kPlaces].on_car;
  }
  // A point of the layer of this rank. False if there is one already.
  [[nodiscard]] bool add_behind(std::uint32_t azimuth_step, std::uint32_t rank) {
    return lines_[azimuth_step % kPlaces].behind.insert(rank);
  }
  void add(std::uint32_t azimuth_step, WaitingPoint point) {
    const std::uint32_t place = azimuth_step % kPlaces;
    points_[place][lines_[place].count] = point;
    ++lines_[place].count;
  }

  // Calls carve(azimuth_step, points, behind) for the line that waits in the place of this
  // one, if any, and then it waits no more.
  template <typename Carve>
  void take(std::uint32_t azimuth_step, Carve&& carve) {
    const std::uint32_t place = azimuth_step % kPlaces;
    Line& line = lines_[place];
    if (line.azimuth_step != kNone) {
      carve(line.azimuth_step, std::span(points_[place]).first(line.count), line.behind);
      line.azimuth_step = kNone;
    }
  }
  template <typename Carve>
  void take_all(Carve&& carve) {
    for (std::uint32_t place = 0; place < kPlaces; ++place) {
      take(place, carve);
    }
  }
  void drop() { lines_.fill({}); }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  static constexpr std::uint32_t kPlaces = 512;
  // An odd number of cache lines, so that places do not share the sets of a cache. Beams behind the
  // band, no more than are enough, change a line by less than two others.
  static constexpr std::size_t kMostPoints = 136;
  static_assert(kMostPoints * sizeof(WaitingPoint) % 64 == 32 &&
                kMostPoints + 2 <= FreeSteps::kMaxBeams);

  std::array<Line, kPlaces> lines_{};
  alignas(32) std::array<std::array<WaitingPoint, kMostPoints>, kPlaces> points_{};
};

}  // namespace iog::grid
