// The pending lines of a rotating lidar. Hundreds of lines and their points are pending at the same
// time. Each point is stored in one word, so that all points fit into the caches. The effect of a
// point on its line is computed when the line is carved.
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

// A point that carves or marks. One word contains the point's horizontal range, layer and evidence.
class WaitingPoint {
 public:
  WaitingPoint() = default;
  // The range must be at most lidar::kMaxRangeMm.
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

// A set of a sensor's layers, represented by their ranks (turn_lines.hpp).
class RankSet {
 public:
  // Returns false if the rank was already in the set.
  [[nodiscard]] bool insert(std::uint32_t rank) {
    std::uint32_t& word = words_[rank / 32];
    const std::uint32_t bit = kFirstBit >> rank % 32;
    const bool is_new = (word & bit) == 0;
    word |= bit;
    return is_new;
  }

  // Calls visit(rank) for each rank in ascending order until visit() returns false.
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

// The pending lines of a rotating lidar. The azimuth step of a line determines its slot. There are
// enough slots even for lasers that are far apart in azimuth. For example, the lasers of an HDL-64E
// are up to 17 degrees apart, which is 390 of 8,192 steps.
class WaitingLines {
 public:
  // The data of a pending line that every point needs. This data fits into one cache line. The
  // points are stored separately. For points beyond the band (TurnLayer::behind_mm), only the
  // layers are recorded.
  struct alignas(32) Line {
    std::uint32_t azimuth_step = kNone;
    std::uint32_t count = 0;
    vehicle::Ranges on_car;
    RankSet behind;
  };

  // Returns true if this line is pending and has room for another point.
  [[nodiscard]] bool has_room(std::uint32_t azimuth_step) const {
    const Line& line = lines_[azimuth_step % kPlaces];
    return line.azimuth_step == azimuth_step && line.count < kMostPoints;
  }
  // Begins a line. The slot for the line must be empty.
  void begin(std::uint32_t azimuth_step, const vehicle::Ranges& on_car) {
    lines_[azimuth_step % kPlaces] = {
        .azimuth_step = azimuth_step, .count = 0, .on_car = on_car, .behind = {}};
  }
  // Requires has_room(azimuth_step).
  [[nodiscard]] const vehicle::Ranges& on_car(std::uint32_t azimuth_step) const {
    return lines_[azimuth_step % kPlaces].on_car;
  }
  // Adds a point beyond the height band to the layer of this rank. Returns false if the layer
  // already has such a point.
  [[nodiscard]] bool add_behind(std::uint32_t azimuth_step, std::uint32_t rank) {
    return lines_[azimuth_step % kPlaces].behind.insert(rank);
  }
  void add(std::uint32_t azimuth_step, WaitingPoint point) {
    const std::uint32_t place = azimuth_step % kPlaces;
    points_[place][lines_[place].count] = point;
    ++lines_[place].count;
  }

  // If the slot of this step contains a line, calls carve(azimuth_step, points, behind) for this
  // line and empties the slot.
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
  // The points of a slot fill an odd number of cache lines, so that slots do not compete for the
  // same cache sets. The 2 in the condition below accounts for the beams beyond the band. At most
  // `enough_beams` of these beams are carved, and together they lower an index by less than two
  // beams of the strongest possible profile.
  static constexpr std::size_t kMostPoints = 136;
  static_assert(kMostPoints * sizeof(WaitingPoint) % 64 == 32 &&
                kMostPoints + 2 <= FreeSteps::kMaxBeams);

  std::array<Line, kPlaces> lines_{};
  alignas(32) std::array<std::array<WaitingPoint, kMostPoints>, kPlaces> points_{};
};

}  // namespace iog::grid
