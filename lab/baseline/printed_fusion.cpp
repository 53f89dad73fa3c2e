// Names of the paper: S = (l_s, m_s) and T are the ends of the beam in subcells, (l, m) the
// south-west corner of the cell at hand, r the subcells of a cell's side, e the error.
//
// Ranges: |delta| and |l - l_s| below 2^20 subcells, e below 2^31 as in src/traversal/walk.hpp. A
// projection has 2^21 half subcells times 2^41 times at most 1 / (2 r) 1D cells, below 2^52.
#include "lab/baseline/printed_fusion.hpp"

#include <algorithm>

#include "geometry/grid.hpp"

namespace iog::lab {
namespace {

using index::OccupancyIndex;
using vehicle::Beam;
using vehicle::Sensor;

constexpr std::int32_t kSide = geometry::kResolution;

// A point without an echo is so far away that all of its beam lies well before it.
constexpr std::int32_t kNoScanPoint = 1 << 20;

// Fraction bits of the 1D cells that half a subcell of x and y is worth.
constexpr int kFractionBits = 41;

// 2^41 * (1D cells along the beam) per half subcell along one axis: 2^41 * extent * L / (2 Delta
// |T - S|^2). Divided in parts of 2^26 and 2^15, so that it fits 64 bits for L < 2^17 mm; what that
// loses moves a 1D cell by less than 2^-20 of its length.
std::int64_t projection(std::int32_t extent, std::int64_t squared_length, const Sensor& sensor) {
  constexpr int kLowBits = 15;
  const std::uint64_t magnitude = static_cast<std::uint32_t>(extent < 0 ? -extent : extent);
  const std::uint64_t numerator = magnitude * sensor.range.mm() << (kFractionBits - kLowBits);
  const std::uint64_t denominator =
      static_cast<std::uint64_t>(squared_length) * 2 * sensor.precision_mm >> kLowBits;
  const auto quotient = static_cast<std::int64_t>(numerator / denominator);
  return extent < 0 ? -quotient : quotient;
}

std::int32_t extent_of(const traversal::Axis<kSide>& axis) {
  return axis.step() * static_cast<std::int32_t>(axis.length());
}

}  // namespace

// What TRAVERSE is called with.
struct PrintedFusion::Segment {
  std::int32_t l_s;
  std::int32_t m_s;
  std::int32_t delta_l;  // of T - S
  std::int32_t delta_m;
  std::int32_t l0;  // the first cell
  std::int32_t m0;
  std::uint32_t borders;  // to cross from there
};

// The local 1D grid of a scan point, and how the 2D grid's cells project onto it.
struct PrintedFusion::LocalGrid {
  std::int32_t l_s;
  std::int32_t m_s;
  std::int64_t along_l;
  std::int64_t along_m;
  std::int32_t k;  // the scan point's 1D cell
  std::int32_t last_step;
  const Table* table;
};

PrintedFusion::PrintedFusion(const vehicle::Vehicle& vehicle, Extent extent)
    : vehicle_(&vehicle), extent_(extent) {
  for (std::size_t i = 0; i < vehicle.sensors.size(); ++i) {
    Tables& tables = tables_[i];
    for (std::int32_t step = -kTableReach; step <= kTableReach; ++step) {
      const std::int32_t place = step + kTableReach;
      const auto slot = static_cast<std::size_t>(place);
      const OccupancyIndex index = vehicle.sensors[i].profile.at(step);
      tables.carves_and_marks[slot] = index;
      (step < 0 ? tables.carves : tables.marks)[slot] = index;
    }
  }
}

void PrintedFusion::add(const Sensor& sensor, const lidar::ScanPoint& point) {
  const Beam beam = vehicle::aim(sensor, point.layer, point.azimuth_ticks);
  const vehicle::Classification classification = vehicle::classify(sensor, beam, point);
  if (!classification.evidence.is_any()) {
    return;
  }
  const std::optional<Segment> segment = segment_of(sensor, beam, point);
  if (!segment) {
    return;
  }
  const std::int64_t squared_length = std::int64_t{segment->delta_l} * segment->delta_l +
                                      std::int64_t{segment->delta_m} * segment->delta_m;
  const std::uint32_t along_mm = sensor.layers[point.layer].along_line_mm(point.range_mm);
  const auto k = static_cast<std::int32_t>(sensor.precision.divide(along_mm));
  const bool stops = extent_ == Extent::kToScanPoint;
  const Tables& tables = tables_[static_cast<std::size_t>(&sensor - vehicle_->sensors.data())];
  traverse(*segment, {.l_s = segment->l_s,
                      .m_s = segment->m_s,
                      .along_l = projection(segment->delta_l, squared_length, sensor),
                      .along_m = projection(segment->delta_m, squared_length, sensor),
                      .k = point.range_mm > 0 ? k : kNoScanPoint,
                      .last_step = stops ? sensor.profile.near_after_count : kNoScanPoint,
                      .table = &tables.of(classification)});
}

std::optional<PrintedFusion::Segment> PrintedFusion::segment_of(
    const Sensor& sensor, const Beam& beam, const lidar::ScanPoint& point) const {
  const vehicle::BeamLine& line = beam.line;
  const bool has_echo = point.range_mm > 0;
  const std::uint32_t reach_mm =
      std::min(sensor.layers[point.layer].along_line_mm(has_echo ? point.range_mm
                                                                 : sensor.no_return_clears_mm),
               sensor.range.mm());
  const std::optional<traversal::Stretch> stretch = line.clip(geometry::kGridArea);
  const vehicle::BandPart part =
      vehicle::part_in_band(vehicle_->band(), sensor, beam.end_z, reach_mm);
  if (!stretch || part.is_empty) {
    return std::nullopt;
  }
  const traversal::Share whole{1, 1};
  const traversal::Share end = has_echo ? whole : traversal::Share{reach_mm, sensor.range.mm()};
  traversal::Position first = stretch->first;
  std::uint32_t last = std::min(stretch->last.crossed(), line.before(end).crossed());
  if (!part.is_whole) {
    const traversal::Position enters = line.through(part.from);
    first = enters.crossed() > first.crossed() ? enters : first;
    last = std::min(last, line.before(part.to).crossed());
  }
  if (first.crossed() > last) {
    return std::nullopt;
  }
  const geometry::Cell cell = line.cell(first);
  return Segment{.l_s = sensor.origin.x,
                 .m_s = sensor.origin.y,
                 .delta_l = extent_of(line.x()),
                 .delta_m = extent_of(line.y()),
                 .l0 = cell.x * kSide,
                 .m0 = cell.y * kSide,
                 .borders = last - first.crossed()};
}

// Appendix B.3. The corner that the error is that of: north-east and south-west where both axes
// run alike, south-east and north-west where they do not.
void PrintedFusion::traverse(const Segment& s, const LocalGrid& local) {
  const std::int32_t step_l = s.delta_l >= 0 ? kSide : -kSide;
  const std::int32_t step_m = s.delta_m >= 0 ? kSide : -kSide;
  std::int32_t l = s.l0;
  std::int32_t m = s.m0;
  const std::int64_t corner_l = std::int64_t{l} + (step_l > 0 ? kSide : 0) - s.l_s;
  const std::int64_t corner_m = std::int64_t{m} + (step_m > 0 ? kSide : 0) - s.m_s;
  auto e = static_cast<std::int32_t>(corner_m * s.delta_l - corner_l * s.delta_m);
  bool goes_on = sample(l, m, local);
  auto left = static_cast<std::int32_t>(s.borders);
  if (step_l == step_m) {
    while (goes_on && left > 0) {
      if (e == 0) {
        l += step_l;
        m += step_m;
        e += step_m * s.delta_l - step_l * s.delta_m;
        left -= 2;
      } else if (e > 0) {
        l += step_l;
        e -= step_l * s.delta_m;
        --left;
      } else {
        m += step_m;
        e += step_m * s.delta_l;
        --left;
      }
      goes_on = sample(l, m, local);
    }
    return;
  }
  while (goes_on && left > 0) {
    if (e == 0) {
      l += step_l;
      m += step_m;
      e += step_m * s.delta_l - step_l * s.delta_m;
      left -= 2;
    } else if (e > 0) {
      m += step_m;
      e += step_m * s.delta_l;
      --left;
    } else {
      l += step_l;
      e -= step_l * s.delta_m;
      --left;
    }
    goes_on = sample(l, m, local);
  }
}

// SampleISM. False if nothing is left to sample behind this cell.
bool PrintedFusion::sample(std::int32_t l, std::int32_t m, const LocalGrid& local) {
  const std::int32_t centre_l = 2 * (l - local.l_s) + kSide;
  const std::int32_t centre_m = 2 * (m - local.m_s) + kSide;
  const auto j = static_cast<std::int32_t>((centre_l * local.along_l + centre_m * local.along_m) >>
                                           kFractionBits);
  const std::int32_t step = j - local.k;
  if (step > local.last_step) {
    return false;
  }
  const std::int32_t slot = std::clamp(step, -kTableReach, kTableReach) + kTableReach;
  const auto row = static_cast<std::uint32_t>(m) / kSide;
  OccupancyIndex& cell =
      cells_[row * geometry::kCellsPerSide + static_cast<std::uint32_t>(l) / kSide];
  cell = index::sat_add(cell, (*local.table)[static_cast<std::size_t>(slot)]);
  return true;
}

}  // namespace iog::lab
