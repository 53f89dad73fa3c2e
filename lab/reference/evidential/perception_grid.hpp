// A PerceptionGrid that stays where it is in the world (Kurdej 2015, sections 4.2.3, 5.1 and 5.2),
// with the map at one of two places.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lab/reference/evidential/lidar_models.hpp"
#include "lab/reference/evidential/perception.hpp"

namespace iog::lab::reference::evidential {

enum class MapOrder : std::uint8_t {
  kNever,
  kEveryScan,   // early_map: equation 5.2 inside 5.3, the thesis's order
  kAtDecision,  // what is known from scans does not know the map
};

class PerceptionGrid {
 public:
  // map_classes: of each cell, the sum of those that are possible, 7 where nothing is known.
  PerceptionGrid(std::span<const Set> map_classes, MapOrder order, double beta,
                 const ScanParameters& parameters);

  // What the sensors say of each cell, all lidars joined.
  void scan(std::span<const SourceMass> sources);

  [[nodiscard]] std::size_t cell_count() const { return cells_.size(); }
  [[nodiscard]] const PerceptionCell& cell(std::size_t number) const {
    return is_unseen_[number] ? unseen_[map_classes_[number]] : cells_[number];
  }
  // What the cell says with its map, without conflict. Vacuous if all it has is conflict.
  [[nodiscard]] MassFunction said(std::size_t number) const;

 private:
  void fuse(std::size_t number, const SourceMass& source);
  // What a scan says of a cell that it did not see.
  [[nodiscard]] const MassFunction& nothing_seen(Set map_classes) const {
    return order_ == MapOrder::kEveryScan ? map_evidence_[map_classes] : map_evidence_[0];
  }
  [[nodiscard]] const MassFunction& map_of(std::size_t number) const {
    return map_evidence_[map_classes_[number]];
  }

  std::vector<Set> map_classes_;
  MapOrder order_;
  ScanParameters parameters_;
  std::vector<MassFunction> map_evidence_;  // by the classes of a cell
  std::vector<PerceptionCell> cells_;
  std::vector<bool> is_unseen_;         // by every scan so far
  std::vector<PerceptionCell> unseen_;  // what such a cell is, by its map's classes
};

}  // namespace iog::lab::reference::evidential
