// The thesis's choices on the same simulated drives: discountings, rules, lidar models, where the
// map comes in; the firmware's grid beside them; a mapped house that is not there; sizes of cells.
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lab/experiments/evidential/grids.hpp"
#include "lab/experiments/evidential/names.hpp"
#include "lab/experiments/experiments.hpp"

namespace iog::lab {
namespace {

using reference::evidential::Ageing;
using reference::evidential::free_mass;
using reference::evidential::kBuilding;
using reference::evidential::LidarModel;
using reference::evidential::MapOrder;
using reference::evidential::PerceptionGrid;
using reference::evidential::Specialised;
using reference::evidential::TemporalRule;

constexpr std::uint64_t kSeed = 21;
constexpr double kRegionM = 80;  // table 7.1
constexpr std::uint64_t kSeedsOfSizes = 6;
constexpr std::array<std::pair<const char*, double>, 2> kLargerCells{
    {{"0.2 m", 0.2}, {"0.5 m", 0.5}}};

struct NamedChoice {
  std::string name;
  GridChoice choice;
};

// The thesis's own, and then what differs from it in one choice.
std::vector<NamedChoice> choices() {
  std::vector<NamedChoice> all{{"the thesis's", {}}};
  for (const auto& [name, ageing] : kAgeings) {
    if (ageing != Ageing::kConservative) {
      all.push_back({std::string(name), {.parameters = {.ageing = ageing}}});
    }
  }
  for (const auto& [name, rule] : kTemporalRules) {
    if (rule != TemporalRule::kThesis) {
      all.push_back({std::string(name), {.parameters = {.rule = rule}}});
    }
  }
  for (const auto& [name, model] : kLidarModels) {
    if (model != LidarModel::kMultiEcho) {
      all.push_back({std::string(name), {.lidar = {.model = model}}});
    }
  }
  all.push_back({"occupied sets", {.parameters = {.which = Specialised::kOccupiedSets}}});
  return all;
}

void add_choices(const EvidentialDrive& drive, WordTables& tables) {
  for (const NamedChoice& named : choices()) {
    tables.add(named.name, score_grid(drive, named.choice));
  }
}

// The map at the decision, by both decisions, and no map at all.
void add_late_maps(const EvidentialDrive& drive, WordTables& tables) {
  tables.add("no map", score_grid(drive, {.order = MapOrder::kNever}));
  Scores pignistic;
  Scores ours;
  run_grid(
      drive, drive.map, {.order = MapOrder::kAtDecision},
      [&](const DriveScan& scan, const PerceptionGrid& grid) {
        const auto truth = drive.truth.find(scan.frame);
        if (truth == drive.truth.end()) {
          return;
        }
        const auto cell_of = [&](const TruePoint& point) { return drive.region.cell_of(point.at); };
        pignistic.add(truth->second,
                      [&](const TruePoint& point) { return pignistic_word(grid, cell_of(point)); });
        ours.add(truth->second, [&](const TruePoint& point) {
          return our_word(grid, cell_of(point), point.map_classes);
        });
      });
  tables.add("map at decision", pignistic);
  tables.add("our decision", ours);
}

Scores score_firmware(const EvidentialDrive& drive, double cell_m) {
  Scores scores;
  run_firmware(drive, cell_m, [&](const TrueScan& truth, const ByteOf& byte_of) {
    scores.add(truth, [&](const TruePoint& point) {
      return word_of(static_cast<decision::Class>(byte_of(point.at) / 8), point.map_classes);
    });
  });
  return scores;
}

// The firmware's grid in larger cells, by size and seed.
Tables sizes_of(const std::string& name, std::string_view scene, std::uint32_t seconds,
                std::uint32_t first_frame) {
  WordTables words(name);
  for (std::uint64_t seed = kSeed; seed < kSeed + kSeedsOfSizes; ++seed) {
    const EvidentialDrive drive(scene, seed, seconds, first_frame, kRegionM);
    for (const auto& [size, cell_m] : kLargerCells) {
      words.add(std::string(size) + ", seed " + std::to_string(seed),
                score_firmware(drive, cell_m));
    }
  }
  return words.take();
}

// What is said of ground that is truly free and that the sensors alone call free, in a house that
// the map has where the street is.
Table ghost_drive(const EvidentialDrive& drive) {
  constexpr double kLengthM = 14;
  constexpr double kWidthM = 10;
  const double station = drive.drive.scene().cruise.station_at(drive.seconds / 2.0);
  const tools::Solid house = tools::box(
      tools::Material::kWall, drive.drive.scene().road.at(station, 0), kLengthM, kWidthM, 0, 8);
  SceneMap map = drive.map;
  map.add_ghost(house);
  Table table("evidential_ghost_drive", {"map", "time_s", "points", "free", "mapped", "unknown"});
  std::map<std::uint32_t, std::vector<std::size_t>> seen_free;  // by frame, places in its ground
  const auto add = [&](std::string_view name, const DriveScan& scan, const auto& say) {
    const std::vector<TruePoint>& ground = drive.truth.at(scan.frame).ground;
    std::array<std::uint64_t, kWordCount> words{};
    for (const std::size_t place : seen_free[scan.frame]) {
      ++words[static_cast<std::size_t>(say(drive.region.cell_of(ground[place].at)))];
    }
    const auto of = [&words](Word word) { return words[static_cast<std::size_t>(word)]; };
    table.row(name, scan.time_s, seen_free[scan.frame].size(),
              of(Word::kDrivable) + of(Word::kNonDrivable) + of(Word::kFree), of(Word::kMapped),
              of(Word::kUnknown));
  };
  const auto on_truth = [&](const auto& use) {
    return [&drive, use](const DriveScan& scan, const PerceptionGrid& grid) {
      if (drive.truth.contains(scan.frame)) {
        use(scan, grid);
      }
    };
  };
  const GridChoice late{.order = MapOrder::kAtDecision};
  run_grid(drive, map, late, on_truth([&](const DriveScan& scan, const auto& grid) {
             const std::vector<TruePoint>& ground = drive.truth.at(scan.frame).ground;
             for (std::size_t place = 0; place < ground.size(); ++place) {
               const LocalToWorld::Point& at = ground[place].at;
               if (ground[place].on == On::kNothing && tools::covers(house, at.x_m, at.y_m) &&
                   free_mass(grid.cell(drive.region.cell_of(at)).mass) >= 0.5) {
                 seen_free[scan.frame].push_back(place);
               }
             }
             add("decision", scan, [&](std::size_t cell) { return pignistic_word(grid, cell); });
             add("our decision", scan,
                 [&](std::size_t cell) { return our_word(grid, cell, kBuilding); });
           }));
  run_grid(drive, map, {}, on_truth([&](const DriveScan& scan, const auto& grid) {
             add("every scan", scan, [&](std::size_t cell) { return pignistic_word(grid, cell); });
           }));
  return table;
}

// A page's tables of a drive.
Tables tables_of(const std::string& name, const EvidentialDrive& drive) {
  WordTables tables(name);
  add_choices(drive, tables);
  add_late_maps(drive, tables);
  tables.add("the firmware's", score_firmware(drive, 0.1));
  return tables.take();
}

}  // namespace

Tables evidential_city(const Input& /*input*/) {
  const EvidentialDrive drive("city", kSeed, 6, 1, kRegionM);
  Tables all = tables_of("evidential_city", drive);
  all.push_back(ghost_drive(drive));
  return all;
}

// From 8 to 18 s of the street's act, in which a car parks, others leave and pass, people stop and
// cross.
Tables evidential_street(const Input& /*input*/) {
  return tables_of("evidential_street", EvidentialDrive("street", kSeed, 18, 201, kRegionM));
}

Tables evidential_sizes_city(const Input& /*input*/) {
  return sizes_of("evidential_sizes_city", "city", 6, 1);
}
Tables evidential_sizes_street(const Input& /*input*/) {
  return sizes_of("evidential_sizes_street", "street", 18, 201);
}

}  // namespace iog::lab
