// What each choice of the computation does to the grids of a drive, held against the simulator's
// truth and, on recordings, against the hits themselves.
#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "lab/evaluation/visibility.hpp"
#include "lab/experiments/detection_quality/choice_maps.hpp"
#include "lab/experiments/detection_quality/choice_values.hpp"
#include "lab/experiments/detection_quality/quality_choices.hpp"
#include "lab/experiments/experiments.hpp"

namespace iog::lab {
namespace {

constexpr std::uint32_t kFrameStep = 5;  // five frames a second are scored
constexpr double kRare = 1e-4;           // a share of the visibly free cells

// The drive under all_choices(), and its first frame to draw.
struct QualityDrive {
  KnownFrame first;
  Trials trials;
};

QualityDrive try_on_drive(const Input& input) {
  const tools::CatalogueEntry& car = tools::find_vehicle(tools::kDefaultVehicle);
  tools::Drive drive(car, input.seed, input.seconds);
  QualityDrive tried{{.car = &car, .points = {}, .truth = {}}, Trials(car, all_choices())};
  for (std::uint32_t frame = 0; frame < drive.frame_count(); frame += kFrameStep) {
    const FramePoints points = points_of(drive, frame, car);
    const std::vector<CellState> truth = visibility(car, drive.ego(frame), drive.solids(frame));
    tried.trials.add(points, truth);
    if (frame == 0) {
      tried.first.points = points;
      tried.first.truth = truth;
    }
  }
  return tried;
}

// How often a grid is right of the cells of a class, occupied or free: as evaluation/detection.hpp
// counts them.
Table classes(const Trials& trials) {
  Table table("detection_quality_classes",
              {"choice", "class", "visible_cells", "found_cells", "found_near_cells",
               "called_cells", "right_cells", "right_near_cells"});
  for (const Choice& choice : all_choices()) {
    const Detection& detection = trials.at(choice.name).detection;
    const auto add = [&](const char* name, const ClassScore& score) {
      table.row(choice.name, name, score.visible, score.found, score.found_near, score.called,
                score.right, score.right_near);
    };
    add("occupied", detection.occupied);
    add("free", detection.free);
  }
  return table;
}

// missed: of the visibly occupied cells, those that the grid calls free. ended: what became of the
// cells in which beams ended.
Table choices(const Trials& trials) {
  Table table("detection_quality",
              {"choice", "frames", "area_under_roc", "missed_cells", "missed_near_cells",
               "ended_occupied_cells", "ended_free_cells", "ended_unknown_cells"});
  for (const Choice& choice : all_choices()) {
    const Trial& trial = trials.at(choice.name);
    table.row(choice.name, trial.frames, trial.roc.area(), trial.detection.missed,
              trial.detection.missed_near, trial.ended.occupied, trial.ended.free,
              trial.ended.unknown);
  }
  return table;
}

// A curve of some hundred points at most, for a logarithmic axis: nothing at a rate of 0, and no
// point that lies within a hair of the one before.
void add_curve(const Trial& trial, Table& table) {
  constexpr double kHair = 0.002;
  std::pair<double, double> last{-1, -1};
  for (const auto& point : trial.roc.curve()) {
    const bool is_apart = point.first > last.first * (1 + 10 * kHair) ||
                          point.second > last.second + kHair || point.second == 1;
    if (point.first > 0 && is_apart) {
      table.row(trial.choice.name, point.first, point.second);
      last = point;
    }
  }
}

Table curves(const Trials& trials) {
  Table table("detection_quality_roc",
              {"choice", "share_of_visibly_free", "share_of_visibly_occupied"});
  for (const std::string& name :
       {std::string(kHitsWinName), std::string(kBayesName), std::string(kDoubleName),
        std::string(kPoolName), std::string(kMaximumName), nearest_name()}) {
    add_curve(trials.at(name), table);
  }
  return table;
}

// The best exact recall of occupied cells at any threshold that lets through no more free cells
// than hits_win does with every index above 0, or than few.
Table recalls(const Trials& trials) {
  Table table("detection_quality_recall",
              {"choice", "largest_share_of_visibly_free", "share_of_visibly_occupied"});
  const double rate = trials.at(kHitsWinName).roc.at_least(1).first;
  for (const std::string& name : {std::string(kHitsWinName), std::string(kBayesName),
                                  std::string(kDoubleName), nearest_name()}) {
    for (const double free_share : {rate, kRare}) {
      table.row(name, free_share, trials.at(name).roc.recall_within(free_share));
    }
  }
  return table;
}

Trials try_on(const Recording& recording) {
  const tools::CatalogueEntry& car = tools::find_vehicle(recording.vehicle);
  Trials trials(car, all_choices());
  for (const FramePoints& points : read_points(recording.pcap, car)) {
    trials.add(points);
  }
  return trials;
}

// A recording has no truth, but what its own beams hit.
Table recordings(const std::vector<Recording>& all) {
  Table table("detection_quality_recordings",
              {"recording", "choice", "frames", "ended_occupied_cells", "ended_free_cells",
               "ended_unknown_cells"});
  for (const Recording& recording : all) {
    const Trials trials = try_on(recording);
    for (const Choice& choice : all_choices()) {
      const Trial& trial = trials.at(choice.name);
      table.row(std::filesystem::path(recording.pcap).filename().string(), choice.name,
                trial.frames, trial.ended.occupied, trial.ended.free, trial.ended.unknown);
    }
  }
  return table;
}

}  // namespace

Tables detection_quality(const Input& input) {
  const QualityDrive drive = try_on_drive(input);
  Tables tables{choices(drive.trials),     classes(drive.trials),
                curves(drive.trials),      recalls(drive.trials),
                model_of_steps(),          indexes_of_steps(),
                recursive_sets_of_sweep(), displaced_hits(*drive.first.car, input.seed)};
  std::ranges::move(choice_maps(drive.first), std::back_inserter(tables));
  if (!input.recordings.empty()) {
    tables.push_back(recordings(input.recordings));
  }
  return tables;
}

}  // namespace iog::lab
