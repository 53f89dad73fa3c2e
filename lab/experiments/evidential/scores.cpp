#include "lab/experiments/evidential/scores.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "decision/cell.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::lab {
namespace {

namespace thesis = reference::evidential;

constexpr double kSeenM = 45;
constexpr double kLatticeM = 0.5;

const std::vector<std::string> kColumns{"grid",         "on",     "unknown",  "drivable",
                                        "non_drivable", "mapped", "moving",   "stopped",
                                        "unmapped",     "free",   "standing", "open"};

// What things really cover, without the 0.2 m by which TrueThings takes a point for near.
class Outlines {
 public:
  explicit Outlines(const TrueThings& things) {
    for (const auto& [thing, state] : things.states()) {
      const std::vector<tools::Solid> outlines = things.outlines_of(thing);
      solids_.insert(solids_.end(), outlines.begin(), outlines.end());
    }
  }
  [[nodiscard]] bool cover(const LocalToWorld::Point& at) const {
    return std::ranges::any_of(
        solids_, [&at](const tools::Solid& solid) { return covers(solid, at.x_m, at.y_m); });
  }

 private:
  std::vector<tools::Solid> solids_;
};

const description::Description& description() {
  return *tools::find_vehicle(tools::kDefaultVehicle).description;
}

}  // namespace

Word word_of(thesis::Set decision) {
  switch (decision) {
    case thesis::kDrivable:
      return Word::kDrivable;
    case thesis::kNonDrivable:
      return Word::kNonDrivable;
    case thesis::kMapped:
      return Word::kMapped;
    case thesis::kMoving:
      return Word::kMoving;
    case thesis::kStopped:
      return Word::kStopped;
    case thesis::kUnmapped:
      return Word::kUnmapped;
    default:
      return Word::kUnknown;
  }
}

// The classes of a grid without a map are completed by what the map has there.
Word word_of(decision::Class of, thesis::Set map_classes) {
  using decision::Class;
  constexpr std::array kWords{Word::kUnknown,  Word::kDrivable, Word::kNonDrivable,
                              Word::kFree,     Word::kMoving,   Word::kStopped,
                              Word::kStanding, Word::kMapped,   Word::kOpen};
  const auto word = [&](std::uint8_t number) { return kWords[number]; };
  if (of == Class::kFree) {
    return word(decision::kFreeClasses[map_classes]);
  }
  if (of == Class::kStoppedOrUnmapped) {
    return word(decision::kStandingClasses[map_classes]);
  }
  return word(static_cast<std::uint8_t>(of));
}

TrueScan truth_of(const DriveScan& scan, const tools::Scene& scene, const SceneMap& map,
                  const Region& region) {
  TrueScan truth;
  const auto point = [&](const LocalToWorld::Point& at, const TrueThings& things) {
    const thesis::Set classes = map.classes_at(at);
    return TruePoint{at, on_what(things.near(at.x_m, at.y_m), classes), classes};
  };
  for (const LidarScan& lidar : scan.lidars) {
    const TrueThings things(scene, lidar.time_s, description());
    for (const LocalToWorld::Point& echo : lidar.echoes) {
      if (region.contains(echo)) {
        truth.echoes.push_back(point(echo, things));
      }
    }
  }
  const TrueThings things(scene, scan.time_s, description());
  Region lattice = region;
  lattice.side =
      static_cast<std::size_t>(static_cast<double>(region.side) * region.cell_m / kLatticeM);
  lattice.cell_m = kLatticeM;
  const Outlines outlines(things);
  for (std::size_t i = 0; i < lattice.cell_count(); ++i) {
    const LocalToWorld::Point at = lattice.centre_of(i);
    const TruePoint seen = point(at, things);
    const bool is_near =
        std::max(std::abs(at.x_m - scan.car.x), std::abs(at.y_m - scan.car.y)) < kSeenM;
    if (is_near && (seen.on == On::kNothing || outlines.cover(at))) {
      truth.ground.push_back(seen);
    }
  }
  return truth;
}

void Scores::add(const TrueScan& truth, const Speaker& say) {
  const auto count = [&say](const std::vector<TruePoint>& points, WordCounts& counts) {
    for (const TruePoint& point : points) {
      ++counts[static_cast<std::size_t>(point.on)][static_cast<std::size_t>(say(point))];
    }
  };
  count(truth.echoes, echoes);
  count(truth.ground, ground);
}

WordTables::WordTables(const std::string& name)
    : echoes_(name + "_echoes", kColumns), ground_(name + "_ground", kColumns) {}

Tables WordTables::take() { return {std::move(echoes_), std::move(ground_)}; }

}  // namespace iog::lab
