#include "lab/reference/evidential/perception_grid.hpp"

namespace iog::lab::reference::evidential {
namespace {

constexpr Set kEveryMapClass = kBuilding | kRoad | kIntermediate;

}  // namespace

PerceptionGrid::PerceptionGrid(std::span<const Set> map_classes, MapOrder order, double beta,
                               const ScanParameters& parameters)
    : map_classes_(map_classes.begin(), map_classes.end()),
      order_(order),
      parameters_(parameters),
      cells_(map_classes.size()),
      is_unseen_(map_classes.size(), true),
      unseen_(kEveryMapClass + 1) {
  for (Set classes = 0; classes <= kEveryMapClass; ++classes) {
    map_evidence_.push_back(map_evidence(classes, classes == 0 ? 0 : beta));
  }
}

// Cells of one map class that nobody has seen are alike, and are kept once.
void PerceptionGrid::scan(std::span<const SourceMass> sources) {
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const bool is_seen = sources[i].free > 0 || sources[i].occupied > 0;
    if (is_seen && is_unseen_[i]) {
      cells_[i] = unseen_[map_classes_[i]];
      is_unseen_[i] = false;
    }
    if (is_seen) {
      fuse(i, sources[i]);
    } else if (!is_unseen_[i]) {
      cells_[i].scan(nothing_seen(map_classes_[i]), parameters_);
    }
  }
  for (Set classes = 0; classes <= kEveryMapClass; ++classes) {
    unseen_[classes].scan(nothing_seen(classes), parameters_);
  }
}

void PerceptionGrid::fuse(std::size_t number, const SourceMass& source) {
  MassFunction sensor_grid = source_evidence(source.free, source.occupied);
  if (order_ == MapOrder::kEveryScan) {
    sensor_grid = dempster(sensor_grid, map_of(number));
  }
  cells_[number].scan(sensor_grid, parameters_);
}

MassFunction PerceptionGrid::said(std::size_t number) const {
  const MassFunction& mass = cell(number).mass;
  if (mass[0] >= 1) {
    return MassFunction(kPerceptionElements);
  }
  return order_ == MapOrder::kAtDecision ? dempster(mass, map_of(number)) : normalised(mass);
}

}  // namespace iog::lab::reference::evidential
