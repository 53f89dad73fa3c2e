// One cell of Kurdej's thesis: section 5.4 with its figures 5.6 and 5.7, the rates of table 7.1,
// and the lidar models of section 4.5 along one beam.
#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

#include "lab/experiments/evidential/names.hpp"
#include "lab/experiments/experiments.hpp"
#include "lab/reference/evidential/perception.hpp"

namespace iog::lab {
namespace {

using reference::evidential::dempster;
using reference::evidential::kAnything;
using reference::evidential::kFree;
using reference::evidential::kMapImages;
using reference::evidential::kMoving;
using reference::evidential::kRoad;
using reference::evidential::kStanding;
using reference::evidential::LidarModel;
using reference::evidential::map_evidence;
using reference::evidential::MassFunction;
using reference::evidential::PerceptionCell;
using reference::evidential::ScanParameters;
using reference::evidential::sector_masses;
using reference::evidential::Set;
using reference::evidential::source_evidence;
using reference::evidential::SourceMass;

constexpr int kScans = 35;
constexpr double kMapBelief = 0.98;  // section 5.4 gives none; chapter 7's text has this one
constexpr std::array kGains{0.05, 0.15};

// Section 5.4: free in scans 1 to 5, occupied to 24, then free.
SourceMass source_of(int scan) {
  return scan >= 6 && scan <= 24 ? SourceMass{.occupied = 0.8} : SourceMass{.free = 0.7};
}

MassFunction sensor_grid_of(int scan, Set map_class) {
  const SourceMass source = source_of(scan);
  return dempster(source_evidence(source.free, source.occupied),
                  map_evidence(map_class, kMapBelief));
}

// Figures 5.6 and 5.7. What stands can be {S} on a road, {S, U} beside it.
void add_curves(std::string_view context, Set map_class, double gain, Table& table) {
  const Set standing = kMapImages[map_class == kRoad ? 1 : 2] & kStanding;
  const Set free = kMapImages[map_class == kRoad ? 1 : 2] & kFree;
  PerceptionCell cell;
  for (int scan = 1; scan <= kScans; ++scan) {
    cell.scan(sensor_grid_of(scan, map_class), {.gain = gain});
    const SourceMass source = source_of(scan);
    table.row(context, gain, scan, source.free, source.occupied, cell.mass[free],
              cell.mass[kMoving], cell.mass[standing | kMoving], cell.mass[standing],
              cell.mass[kAnything], cell.accumulator);
  }
}

// The first scan from the sixth on in which what stands has more than what moves; 0: none.
int scan_of_stopping(Set map_class, const ScanParameters& parameters) {
  const Set standing = kMapImages[map_class == kRoad ? 1 : 2] & kStanding;
  PerceptionCell cell;
  for (int scan = 1; scan <= 24; ++scan) {
    cell.scan(sensor_grid_of(scan, map_class), parameters);
    if (scan >= 6 && cell.mass[standing] > cell.mass[kMoving]) {
      return scan;
    }
  }
  return 0;
}

void add_stops(std::string_view rates, const ScanParameters& of_rates, Table& table) {
  for (const auto& [name, ageing] : kAgeings) {
    for (const auto& [context, map_class] : {kContexts[1], kContexts[2]}) {
      for (const double gain : kGains) {
        ScanParameters parameters = of_rates;
        parameters.ageing = ageing;
        parameters.gain = gain;
        table.row(context, name, rates, gain, scan_of_stopping(map_class, parameters));
      }
    }
  }
}

// Section 4.5.2: an echo alone, and two of one cell, with a third beyond.
Table lidar_models() {
  constexpr double kCellM = 0.5;
  constexpr std::size_t kCells = 16;
  constexpr std::array kEchoesM{3.30, 5.10, 5.30, 6.45};
  Table table("evidential_lidar_models", {"model", "sigma_m", "cell_from_m", "free", "occupied"});
  for (const auto& [name, model] : kLidarModels) {
    for (const double sigma_m : {0.1, 0.3}) {
      if (sigma_m > 0.1 && model != LidarModel::kImprecise) {
        continue;  // of no effect
      }
      const auto masses =
          sector_masses(kEchoesM, kCellM, kCells, {.model = model, .sigma_m = sigma_m});
      for (std::size_t i = 0; i < masses.size(); ++i) {
        table.row(name, sigma_m, static_cast<double>(i) * kCellM, masses[i].free,
                  masses[i].occupied);
      }
    }
  }
  return table;
}

}  // namespace

Tables evidential_cell(const Input& /*input*/) {
  Table curves("evidential_curves",
               {"context", "gain", "scan", "source_free", "source_occupied", "free", "moving",
                "movable", "standing", "ignorance", "accumulator"});
  for (const auto& [context, map_class] : {kContexts[1], kContexts[2]}) {
    for (const double gain : kGains) {
      add_curves(context, map_class, gain, curves);
    }
  }
  Table stops("evidential_stops", {"context", "ageing", "rates", "gain", "scan"});
  add_stops("exchanged", {}, stops);
  add_stops("as printed", {.dynamic_loss = 0.01, .static_loss = 0.10}, stops);
  return {std::move(curves), std::move(stops), lidar_models()};
}

}  // namespace iog::lab
