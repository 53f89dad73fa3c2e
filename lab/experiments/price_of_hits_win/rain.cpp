// What unflagged rain does to the grid of one frame.
#include <algorithm>
#include <array>

#include "lab/evaluation/visibility.hpp"
#include "lab/experiments/fusion_trial.hpp"
#include "lab/experiments/price_of_hits_win/false_echoes.hpp"
#include "lab/experiments/price_of_hits_win/priced_fusions.hpp"

namespace iog::lab {
namespace {

constexpr std::uint64_t kRainStream = 81;  // of the seed's random numbers

std::vector<Choice> compared_choices() {
  std::vector<Choice> choices;
  choices.reserve(kPricedFusions.size());
  for (const IndexFusion& fusion : kPricedFusions) {
    choices.push_back({.name = name_of(fusion), .fusion = fusion});
  }
  return choices;
}

constexpr std::array kRates{0.0, 0.001, 0.005, 0.01, 0.02, 0.05};
constexpr std::uint32_t kRainFrameStep = 10;
constexpr double kMoreThanOneHit = 3;  // a hit is +2

struct RainRow {
  double rate = 0;
  TrueEcho fate = TrueEcho::kComesLater;
  Trials trials;
  std::uint64_t drops = 0;
};

std::vector<RainRow> rain_on_drive(const Input& input) {
  const tools::CatalogueEntry& car = tools::find_vehicle(tools::kDefaultVehicle);
  std::vector<RainRow> rows;
  for (const TrueEcho fate : {TrueEcho::kComesLater, TrueEcho::kIsLost}) {
    for (const double rate : kRates) {
      if (rate > 0 || fate == TrueEcho::kComesLater) {
        rows.push_back({.rate = rate, .fate = fate, .trials = Trials(car, compared_choices())});
      }
    }
  }
  tools::Drive drive(car, input.seed, input.seconds);
  tools::Random random(input.seed, kRainStream);
  for (std::uint32_t frame = 0; frame < drive.frame_count(); frame += kRainFrameStep) {
    const FramePoints points = points_of(drive, frame, car);
    const std::vector<CellState> truth = visibility(car, drive.ego(frame), drive.solids(frame));
    for (RainRow& row : rows) {
      const Rained rained = with_rain(points, *car.vehicle, row.rate, row.fate, random);
      row.trials.add(rained.points, truth);
      row.drops += rained.drops;
    }
  }
  return rows;
}

}  // namespace

Table price_of_rain(const Input& input) {
  Table table("price_of_rain", {"rate", "true_echo", "fusion", "frames", "drops", "phantom_cells",
                                "visibly_occupied_cells", "missed_near_cells",
                                "share_of_visibly_free_at_1", "share_of_visibly_occupied_at_1",
                                "share_of_visibly_free_at_3", "share_of_visibly_occupied_at_3"});
  for (const RainRow& row : rain_on_drive(input)) {
    const char* const fate = row.fate == TrueEcho::kComesLater ? "comes second" : "is lost";
    for (const IndexFusion& fusion : kPricedFusions) {
      const Trial& trial = row.trials.at(name_of(fusion));
      const ClassScore& occupied = trial.detection.occupied;
      const auto [free_at_1, occupied_at_1] = trial.roc.at_least(1);
      const auto [free_at_3, occupied_at_3] = trial.roc.at_least(kMoreThanOneHit);
      table.row(row.rate, fate, name_of(fusion), trial.frames, row.drops,
                occupied.called - occupied.right_near, occupied.visible,
                trial.detection.missed_near, free_at_1, occupied_at_1, free_at_3, occupied_at_3);
    }
  }
  return table;
}

}  // namespace iog::lab
