// A way to make a grid of a frame's points, and how well it does over many frames.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "index/recursive_set.hpp"
#include "lab/evaluation/cell_state.hpp"
#include "lab/evaluation/detection.hpp"
#include "lab/evaluation/roc.hpp"
#include "lab/evidence/fusion_rules.hpp"
#include "lab/evidence/projection.hpp"
#include "lab/evidence/values.hpp"

namespace iog::lab {

inline constexpr double kDefaultEpsilon = 0.05;
inline constexpr std::int32_t kInt8Limit = 127;
inline constexpr std::int32_t kNoLimit = 1 << 30;

struct IndexFusion {
  IndexRule rule = IndexRule::kHitsWin;
  double epsilon = kDefaultEpsilon;
  index::Quantisation policy = index::Quantisation::kBlurring;
  std::int32_t limit = kInt8Limit;
};

struct Choice {
  std::string name;
  std::variant<IndexFusion, ProbabilityRule> fusion;
  Geometry geometry = {};
};

// A grid of indexes or of probabilities.
struct FusedGrid {
  std::variant<std::vector<std::int32_t>, std::vector<double>> cells;
  double epsilon = kDefaultEpsilon;  // of the indexes

  [[nodiscard]] std::vector<CellState> states() const;

  // What the cell's occupancy is as an index at the default epsilon, not rounded.
  [[nodiscard]] double index_at(std::size_t cell) const;
};

[[nodiscard]] FusedGrid fuse(const FrameEvidence& evidence, const ByStep<double>& probabilities,
                             const Choice& choice);

// The model of a vehicle whose sensors are all alike.
[[nodiscard]] ModelConfig model_of(const tools::CatalogueEntry& car);

// One choice's frames, added up.
struct Trial {
  Choice choice;
  Detection detection;  // of the frames whose truth is known
  Roc roc;              // of the same
  EndedCells ended;     // of all
  std::uint64_t frames = 0;

  // A frame's cells that are called occupied, are visibly free and have no visibly occupied
  // neighbour; mean.
  [[nodiscard]] double phantoms_per_frame() const;
};

// Several choices on the same frames. What they share is computed once.
class Trials {
 public:
  Trials(const tools::CatalogueEntry& car, const std::vector<Choice>& choices);

  void add(const FramePoints& points);
  void add(const FramePoints& points, std::span<const CellState> truth);

  // std::out_of_range if there is no choice of that name.
  [[nodiscard]] const Trial& at(const std::string& name) const;

 private:
  void add_to(Trial& trial, const FrameEvidence& evidence, std::span<const CellState> truth) const;

  const tools::CatalogueEntry* car_;
  ByStep<double> probabilities_;
  std::vector<Trial> trials_;
};

}  // namespace iog::lab
