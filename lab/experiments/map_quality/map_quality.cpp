#include "lab/experiments/map_quality/map_quality.hpp"

#include <cmath>
#include <utility>

#include "lab/experiments/experiments.hpp"
#include "lab/experiments/map_quality/scene_maps.hpp"
#include "lab/experiments/perception/truth.hpp"
#include "tools/simulate/truth/cell_truth.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::lab {
namespace {

// Nothing was tuned on these seeds.
constexpr std::array<std::uint64_t, 3> kMapSeeds{21, 22, 23};
constexpr std::uint32_t kMapSeconds = 6;
constexpr std::uint32_t kShownEvery = 10;
constexpr std::array<std::string_view, 3> kMapScenes{"city", "street", "ring_road"};
constexpr std::array<std::string_view, kClassCount> kClassNames{
    "unknown", "drivable", "non_drivable",        "free",
    "moving",  "stopped",  "stopped_or_unmapped", "infrastructure",
    "occupied"};
constexpr std::array<std::string_view, kNameTruthCount> kTruthNames{"road",    "beside", "moving",
                                                                    "stopped", "house",  "other"};
constexpr std::array<std::string_view, kWrongCount> kWrongNames{"ghost_beside", "ghost_on_road",
                                                                "missing"};

// What is true of the world's cells around the window of a perceived frame, at the frame's end.
class WorldCells {
 public:
  explicit WorldCells(const PerceivedFrame& frame)
      : area_{frame.window.first.x - kMargin, frame.window.first.y - kMargin,
              window::kCellsAcross + 2 * kMargin, window::kCellsAcross + 2 * kMargin},
        classes_(
            tools::true_classes(frame.drive->scene(),
                                static_cast<double>(frame.drive->frame_end_us(frame.number)) / 1e6,
                                area_, *tools::find_vehicle(tools::kDefaultVehicle).description)) {}

  // Of the cell of the world that holds a point in the window, or some metres beside it: poses are
  // wrong by centimetres.
  [[nodiscard]] tools::TrueClass at(const LocalToWorld::Point& point) const {
    const auto x = static_cast<std::int32_t>(std::floor(point.x_m / kWindowCellM)) - area_.x;
    const auto y = static_cast<std::int32_t>(std::floor(point.y_m / kWindowCellM)) - area_.y;
    return classes_[static_cast<std::size_t>(y) * static_cast<std::size_t>(area_.width) +
                    static_cast<std::size_t>(x)];
  }

 private:
  static constexpr std::int32_t kMargin = 100;  // cells

  tools::CellArea area_;
  std::vector<tools::TrueClass> classes_;
};

// Where a drawn map is wrong.
class WrongPlaces {
 public:
  explicit WrongPlaces(const tools::DrawnMap& map)
      : places_{tools::TrueGround(ghosts(map, tools::HouseDrawn::kGhostBeside)),
                tools::TrueGround(ghosts(map, tools::HouseDrawn::kGhostOnRoad)),
                tools::TrueGround(missing(map))} {}

  [[nodiscard]] bool has(std::size_t wrong, const LocalToWorld::Point& at) const {
    return places_[wrong].at(at.x_m, at.y_m) == tools::Ground::kHouse;
  }

 private:
  static tools::SitePlan ghosts(const tools::DrawnMap& map, tools::HouseDrawn how) {
    tools::SitePlan plan;
    for (const tools::DrawnHouse& drawn : map.houses) {
      if (drawn.how == how) {
        plan.houses.push_back(drawn.house);
      }
    }
    return plan;
  }

  static tools::SitePlan missing(const tools::DrawnMap& map) {
    constexpr double kWall = 0.3;
    tools::SitePlan plan{.roads = {}, .houses = map.missing};
    for (tools::PlannedHouse& house : plan.houses) {
      house.half_length_m += kWall;
      house.half_width_m += kWall;
    }
    return plan;
  }

  std::array<tools::TrueGround, kWrongCount> places_;
};

// Scores frames of one drive.
class MapScorer {
 public:
  MapScorer(const tools::Scene& scene, const tools::DrawnMap& last, std::size_t variants)
      : ground_(scene.plan), wrong_(last), scores_(variants) {}

  void add(const PerceivedFrame& frame, const LocalToWorld& to_world) {
    const WorldCells world(frame);
    for (std::size_t place = 0; place < frame.classes.front().size(); ++place) {
      if (frame.classes.front()[place] != 0) {
        const LocalToWorld::Point at = to_world.centre_of(frame.window.cell_at(place));
        count(frame, place, name_truth(world.at(at), ground_.at(at.x_m, at.y_m)), at);
      }
    }
  }

  [[nodiscard]] std::vector<MapScore> take() { return std::move(scores_); }

 private:
  void count(const PerceivedFrame& frame, std::size_t place, NameTruth truth,
             const LocalToWorld::Point& at) {
    std::array<bool, kWrongCount> is_wrong{};
    for (std::size_t wrong = 0; wrong < kWrongCount; ++wrong) {
      is_wrong[wrong] = wrong_.has(wrong, at);
    }
    for (std::size_t variant = 0; variant < scores_.size(); ++variant) {
      const auto called = static_cast<std::size_t>(frame.classes[variant][place]) / 8;
      const auto is = static_cast<std::size_t>(truth);
      ++scores_[variant].cells[called][is];
      scores_[variant].seen[called][is] += frame.evidence[place] != 0 ? 1U : 0U;
      for (std::size_t wrong = 0; wrong < kWrongCount; ++wrong) {
        scores_[variant].in_wrong[wrong][called] += is_wrong[wrong] ? 1U : 0U;
      }
    }
  }

  tools::TrueGround ground_;
  WrongPlaces wrong_;
  std::vector<MapScore> scores_;
};

class MapTables {
 public:
  void add(const MapDrive& drive, std::span<const MapVariant> variants,
           const std::vector<MapScore>& scores) {
    for (std::size_t i = 0; i < variants.size(); ++i) {
      for (std::size_t called = 1; called < kClassCount; ++called) {
        for (std::size_t truth = 0; truth < kNameTruthCount; ++truth) {
          cells_.row(drive.scene, drive.seed, variants[i].name, kClassNames[called],
                     kTruthNames[truth], scores[i].cells[called][truth],
                     scores[i].seen[called][truth]);
        }
        for (std::size_t place = 0; place < kWrongCount; ++place) {
          wrong_.row(drive.scene, drive.seed, variants[i].name, kWrongNames[place],
                     kClassNames[called], scores[i].in_wrong[place][called]);
        }
      }
    }
  }

  [[nodiscard]] Tables take() { return {std::move(cells_), std::move(wrong_)}; }

 private:
  Table cells_{"map_quality", {"scene", "seed", "map", "class", "truth", "cells", "seen_cells"}};
  Table wrong_{"map_quality_wrong", {"scene", "seed", "map", "place", "class", "cells"}};
};

}  // namespace

std::vector<MapVariant> map_variants() {
  constexpr tools::MapErrors kOff{.shift_east_m = 0.3, .shift_north_m = -0.4};
  return {{"none"},
          {"right", {}, 100},
          {"off, stated", kOff, 500},
          {"off, not stated", kOff, 100},
          {"wrong",
           {.noise_m = 0.2, .missing = 0.2, .ghosts = 6, .outdated = 0.2, .no_width = 0.5},
           500}};
}

std::vector<MapScore> score_maps(const MapDrive& drive, std::span<const MapVariant> variants) {
  const tools::MapPlace place;
  const tools::Scene scene = tools::find_scene(drive.scene).make(drive.seed, drive.seconds);
  std::vector<std::vector<std::uint8_t>> blocks;
  std::vector<PerceptionRule> rules;
  tools::DrawnMap drawn;
  for (const MapVariant& variant : variants) {
    drawn = tools::drawn_map(scene, variant.errors, drive.seed, drive.seconds);
    rules.push_back({variant.name});
    if (variant.accuracy_mm > 0) {
      blocks.push_back(block_of(drawn, place, variant.accuracy_mm));
      rules.back().map = blocks.back();
    }
  }
  PerceivedDrive perceived{.scene = drive.scene,
                           .seed = drive.seed,
                           .seconds = drive.seconds,
                           .shown_every = kShownEvery};
  perceived.poses.map = place.transform();
  MapScorer scorer(scene, drawn, variants.size());
  LocalToWorld to_world;
  perceive_drive(perceived, rules, [&](const PerceivedFrame& frame) {
    const FrameTruth truth(frame, to_world);
    to_world = truth.last().to_world;
    if (!frame.classes.empty() && frame.number >= drive.first_scored) {
      scorer.add(frame, to_world);
    }
  });
  return scorer.take();
}

Tables map_quality(const Input& /*input*/) {
  MapTables tables;
  const std::vector<MapVariant> variants = map_variants();
  for (const std::string_view scene : kMapScenes) {
    for (const std::uint64_t seed : kMapSeeds) {
      const MapDrive drive{.scene = scene, .seed = seed, .seconds = kMapSeconds};
      tables.add(drive, variants, score_maps(drive, variants));
    }
  }
  return tables.take();
}

}  // namespace iog::lab
