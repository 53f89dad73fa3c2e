#include "lab/experiments/evidential/roc.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lab/experiments/evidential/grids.hpp"
#include "lab/experiments/experiments.hpp"

namespace iog::lab {
namespace {

namespace thesis = reference::evidential;

constexpr std::uint64_t kRocSeed = 21;
constexpr double kRocRegionM = 80;

void add_rows(std::string_view scene, std::string_view grid, std::string_view question,
              const Curve& curve, Table& table) {
  for (std::size_t threshold = 0; threshold < kThresholds; ++threshold) {
    const Curve::Counts counts = curve.at_least(threshold);
    table.row(scene, grid, question, threshold, counts.of_class, counts.others);
  }
}

void add_curves(std::string_view scene, std::string_view grid, const Curves& curves, Table& table) {
  add_rows(scene, grid, "moving", curves.moving, table);
  add_rows(scene, grid, "drivable", curves.drivable, table);
}

Curves curves_of_thesis(const EvidentialDrive& drive, thesis::MapOrder order) {
  Curves curves;
  run_grid(drive, drive.map, {.order = order}, [&](const auto& scan, const auto& grid) {
    const auto truth = drive.truth.find(scan.frame);
    if (truth != drive.truth.end()) {
      const auto probability = [&](const TruePoint& point, thesis::Set of) {
        return thesis::pignistic(grid.said(drive.region.cell_of(point.at)), of);
      };
      curves.add(
          truth->second, [&](const TruePoint& at) { return probability(at, thesis::kMoving); },
          [&](const TruePoint& at) { return probability(at, thesis::kDrivable); });
    }
  });
  return curves;
}

// A free cell is drivable where the map has a road; without a map wherever it is.
Curves curves_of_firmware(const EvidentialDrive& drive, bool has_map) {
  constexpr auto kFree = static_cast<std::uint8_t>(decision::Class::kFree);
  constexpr auto kMoving = static_cast<std::uint8_t>(decision::Class::kMoving);
  Curves curves;
  run_firmware(drive, 0.1, [&](const TrueScan& truth, const ByteOf& byte_of) {
    curves.add(
        truth, [&](const TruePoint& point) { return score_of(byte_of(point.at), kMoving); },
        [&](const TruePoint& point) {
          const bool is_road = point.map_classes == thesis::kRoad;
          return is_road || !has_map ? score_of(byte_of(point.at), kFree) : 0;
        });
  });
  return curves;
}

void add_drive(const EvidentialDrive& drive, Table& table) {
  using thesis::MapOrder;
  constexpr std::array<std::pair<std::string_view, MapOrder>, 3> kOrders{
      {{"map in every scan", MapOrder::kEveryScan},
       {"map at decision", MapOrder::kAtDecision},
       {"no map", MapOrder::kNever}}};
  for (const auto& [name, order] : kOrders) {
    add_curves(drive.name, name, curves_of_thesis(drive, order), table);
  }
  add_curves(drive.name, "the firmware's", curves_of_firmware(drive, true), table);
  add_curves(drive.name, "the firmware's, no map", curves_of_firmware(drive, false), table);
}

}  // namespace

void Curve::add(bool is_of_class, double score) {
  // Numbers that are a hundredth but for their last digit are one.
  const auto hundredths = static_cast<std::size_t>(std::floor(score * 100 + 1e-9));
  Counts& counts = by_score_[std::min(hundredths, kThresholds - 1)];
  ++(is_of_class ? counts.of_class : counts.others);
}

Curve::Counts Curve::at_least(std::size_t hundredths) const {
  Counts sum;
  for (std::size_t i = hundredths; i < kThresholds; ++i) {
    sum.of_class += by_score_[i].of_class;
    sum.others += by_score_[i].others;
  }
  return sum;
}

void Curves::add(const TrueScan& truth, const Score& moving_score, const Score& drivable_score) {
  for (const TruePoint& echo : truth.echoes) {
    const bool moves = echo.on == On::kMovingCar || echo.on == On::kMovingPerson;
    const bool stands = echo.on == On::kHouse || echo.on == On::kStopped || echo.on == On::kBeside;
    if (moves || stands) {
      moving.add(moves, moving_score(echo));
    }
  }
  for (const TruePoint& point : truth.ground) {
    drivable.add(point.on == On::kNothing && point.map_classes == thesis::kRoad,
                 drivable_score(point));
  }
}

double score_of(std::int8_t byte, std::uint8_t class_number) {
  constexpr double kHalf = 16'384;
  constexpr double kStep = 2'048;
  constexpr double kAll = 32'767;
  return byte / 8 == class_number ? (kHalf + kStep * (byte % 8 + 0.5)) / kAll : 0;
}

Tables evidential_roc(const Input& /*input*/) {
  Table table("evidential_roc",
              {"scene", "grid", "class", "threshold_percent", "of_class", "others"});
  add_drive(EvidentialDrive("city", kRocSeed, 6, 1, kRocRegionM), table);
  add_drive(EvidentialDrive("street", kRocSeed, 18, 201, kRocRegionM), table);
  return {std::move(table)};
}

}  // namespace iog::lab
