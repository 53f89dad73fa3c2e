// What the papers compare with, in float: the traversal of Amanatides and Woo, Theorem 6 by a table
// of the 1D cell that a cell's centre projects to, and Bayes's rule on probabilities (equation 3.2)
// or on log-odds (equation 2.46), one measurement after the other.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "lab/evidence/values.hpp"
#include "lab/peers/contender.hpp"
#include "lab/reference/fusion.hpp"
#include "lab/reference/traversal.hpp"
#include "vehicle/beam.hpp"

namespace iog::lab {
namespace {

using reference::CellPoint;

// Behind the scan point Theorem 6 gives 0.5 from here on (Table 4.3).
constexpr int kCellsBehind = 2;

using Table = std::array<float, kStepCount>;

// Lengths in cells of the grid.
struct FloatBeam {
  CellPoint<float> start;
  CellPoint<float> end;
  float along_x;  // 1D cells per cell of the grid
  float along_y;
  std::int32_t k;
  bool marks;
};

float in_cells(double metres) { return static_cast<float>((metres + kHalfSideM) / kCellM); }

FloatBeam prepare(const vehicle::Vehicle& car, const PeerBeam& beam) {
  const vehicle::Sensor& sensor = car.sensors[beam.sensor];
  const double x_m = beam.end.x - beam.origin.x;
  const double y_m = beam.end.y - beam.origin.y;
  const vehicle::BeamLine line =
      vehicle::aim(sensor, beam.point.layer, beam.point.azimuth_ticks).line;
  // The local grid has its 1D cells along the beam, of which the plane sees the cosine.
  const double plane_m =
      std::hypot(line.x().length(), line.y().length()) / geometry::kSubcellsPerMetre;
  const double range_m = std::hypot(x_m, y_m);
  const double behind_m = beam.marks ? (kCellsBehind + 1) * sensor.precision_mm / 1000.0 : 0;
  const double share = std::min(range_m + behind_m, plane_m) / range_m;
  const double cells_along = sensor.range.mm() / static_cast<double>(sensor.precision_mm);
  const double per_cell = kCellM * cells_along / plane_m / range_m;
  return {.start = {in_cells(beam.origin.x), in_cells(beam.origin.y)},
          .end = {in_cells(beam.origin.x + share * x_m), in_cells(beam.origin.y + share * y_m)},
          .along_x = static_cast<float>(x_m * per_cell),
          .along_y = static_cast<float>(y_m * per_cell),
          .k = static_cast<std::int32_t>(beam.point.range_mm / sensor.precision_mm),
          .marks = beam.marks};
}

// Fusion of a stored value with a measured one; the table has what is measured.
struct Bayes {
  static constexpr float kUnknown = 0.5F;
  static constexpr float kHardlyAny = 0.01F;  // 0.505 and the like say nothing
  static float measured(double probability) { return static_cast<float>(probability); }
  static float fuse(float p, float q) { return p * q / (p * q + (1 - p) * (1 - q)); }
};

struct LogOdds {
  static constexpr float kUnknown = 0;
  static constexpr float kHardlyAny = 4 * Bayes::kHardlyAny;  // the slope at 1/2
  static float measured(double probability) {
    return static_cast<float>(reference::log_odds(probability));
  }
  static float fuse(float p, float q) { return p + q; }
};

template <typename Rule>
class Float final : public Contender {
 public:
  explicit Float(const PeerFrames& frames) : cells_(kCells, Rule::kUnknown) {
    for (const PeerFrame& frame : frames.frames) {
      std::vector<FloatBeam>& beams = frames_.emplace_back();
      for (const PeerBeam& beam : frame) {
        beams.push_back(prepare(*frames.vehicle, beam));
      }
    }
    const ByStep<double> model = probabilities({});
    carves_.fill(Rule::kUnknown);
    for (std::size_t i = 0; i < model.size(); ++i) {
      carves_and_marks_[i] = Rule::measured(model[i]);
      carves_[i] = i < kFarSteps ? carves_and_marks_[i] : Rule::measured(0.5);
    }
  }

  void fuse(std::size_t frame) override {
    for (const FloatBeam& beam : frames_[frame]) {
      const Table& table = beam.marks ? carves_and_marks_ : carves_;
      reference::walk_amanatides_woo(beam.start, beam.end, [&](geometry::Cell cell) {
        if (!geometry::kGridArea.contains(cell)) {
          return;
        }
        const float x = static_cast<float>(cell.x) + 0.5F - beam.start.x;
        const float y = static_cast<float>(cell.y) + 0.5F - beam.start.y;
        const auto j = static_cast<std::int32_t>(std::floor(x * beam.along_x + y * beam.along_y));
        const std::int32_t step = std::clamp(j - beam.k, -kFarSteps, kFarSteps);
        float& stored = cells_[offset_of(cell)];
        stored = Rule::fuse(stored, table[slot_of(step)]);
      });
    }
  }

  void clear() override { std::ranges::fill(cells_, Rule::kUnknown); }

  [[nodiscard]] CellCounts count() const override {
    const auto is_free = [](float value) { return value < Rule::kUnknown - Rule::kHardlyAny; };
    const auto is_occupied = [](float value) { return value > Rule::kUnknown + Rule::kHardlyAny; };
    return {static_cast<std::size_t>(std::ranges::count_if(cells_, is_free)),
            static_cast<std::size_t>(std::ranges::count_if(cells_, is_occupied)), cells_.size()};
  }

 private:
  static constexpr std::size_t kCells =
      std::size_t{geometry::kCellsPerSide} * geometry::kCellsPerSide;

  static std::size_t offset_of(geometry::Cell cell) {
    const std::int32_t offset = cell.y * geometry::kCellsPerSide + cell.x;
    return static_cast<std::size_t>(offset);
  }

  std::vector<std::vector<FloatBeam>> frames_;
  Table carves_and_marks_{};
  Table carves_{};
  std::vector<float> cells_;
};

}  // namespace

std::unique_ptr<Contender> make_float_bayes(const PeerFrames& frames) {
  return std::make_unique<Float<Bayes>>(frames);
}

std::unique_ptr<Contender> make_float_log_odds(const PeerFrames& frames) {
  return std::make_unique<Float<LogOdds>>(frames);
}

}  // namespace iog::lab
