// Ours, and the thesis's as printed. Both start from scan points, as their packets are decoded: the
// direction of each beam and its fate are part of what is timed.
#include <algorithm>
#include <span>
#include <vector>

#include "fusion/frame_fusion.hpp"
#include "lab/baseline/printed_fusion.hpp"
#include "lab/peers/contender.hpp"

namespace iog::lab {
namespace {

CellCounts count_of(std::span<const index::OccupancyIndex> cells) {
  const auto is_free = [](index::OccupancyIndex index) { return index < 0; };
  const auto is_occupied = [](index::OccupancyIndex index) { return index > 0; };
  return {static_cast<std::size_t>(std::ranges::count_if(cells, is_free)),
          static_cast<std::size_t>(std::ranges::count_if(cells, is_occupied)), cells.size()};
}

class Ours final : public Contender {
 public:
  Ours(const PeerFrames& frames, vehicle::FusionRule rule)
      : frames_(&frames), vehicle_(with_rule(*frames.vehicle, rule)), fusion_(vehicle_) {}

  void fuse(std::size_t frame) override {
    for (const PeerBeam& beam : frames_->frames[frame]) {
      fusion_.add(vehicle_.sensors[beam.sensor], beam.point);
    }
    fusion_.finish();
  }
  void clear() override { fusion_.clear(); }
  [[nodiscard]] CellCounts count() const override {
    std::vector<index::OccupancyIndex> cells(geometry::kCellCount);
    fusion_.view().copy_cells(std::span(cells).first<geometry::kCellCount>());
    return count_of(cells);
  }

 private:
  static vehicle::Vehicle with_rule(vehicle::Vehicle vehicle, vehicle::FusionRule rule) {
    vehicle.rule = rule;
    return vehicle;
  }

  const PeerFrames* frames_;
  vehicle::Vehicle vehicle_;
  fusion::FrameFusion fusion_;
};

class Printed final : public Contender {
 public:
  Printed(const PeerFrames& frames, Extent extent)
      : frames_(&frames), fusion_(*frames.vehicle, extent) {}

  void fuse(std::size_t frame) override {
    for (const PeerBeam& beam : frames_->frames[frame]) {
      fusion_.add(frames_->vehicle->sensors[beam.sensor], beam.point);
    }
  }
  void clear() override { fusion_.clear(); }
  [[nodiscard]] CellCounts count() const override { return count_of(fusion_.cells()); }

 private:
  const PeerFrames* frames_;
  PrintedFusion fusion_;
};

}  // namespace

std::unique_ptr<Contender> make_hits_win(const PeerFrames& frames) {
  return std::make_unique<Ours>(frames, vehicle::FusionRule::kHitsWin);
}

std::unique_ptr<Contender> make_bayes(const PeerFrames& frames) {
  return std::make_unique<Ours>(frames, vehicle::FusionRule::kBayes);
}

std::unique_ptr<Contender> make_printed(const PeerFrames& frames) {
  return std::make_unique<Printed>(frames, Extent::kToScanPoint);
}

std::unique_ptr<Contender> make_printed_whole_beams(const PeerFrames& frames) {
  return std::make_unique<Printed>(frames, Extent::kWholeBeam);
}

}  // namespace iog::lab
