// What each choice of the computation costs, held against the simulator's truth and, on recordings,
// against the hits themselves.
#include <algorithm>
#include <array>
#include <filesystem>
#include <string>

#include "lab/evaluation/visibility.hpp"
#include "lab/experiments/choice_tables.hpp"
#include "lab/experiments/quality_choices.hpp"
#include "lab/experiments/sections.hpp"

namespace iog::lab {
namespace {

using Rows = std::vector<std::vector<std::string>>;

constexpr std::uint32_t kFrameStep = 5;  // five frames a second are scored

// Every kFrameStep-th frame of the drive; the first of them is drawn.
QualityDrive try_on_drive(const TablesInput& input) {
  const tools::CatalogueEntry& car = tools::find_vehicle(tools::kDefaultVehicle);
  tools::Drive drive(car, input.seed, input.seconds);
  QualityDrive drawn{{.car = &car, .points = {}, .truth = {}}, Trials(car, all_choices())};
  for (std::uint32_t frame = 0; frame < drive.frame_count(); frame += kFrameStep) {
    drive.move_to(frame);
    const FramePoints points = points_of(drive, car);
    const std::vector<CellState> truth = visibility(car, drive.ego(), drive.solids());
    drawn.trials.add(points, truth);
    if (frame == 0) {
      drawn.picture.points = points;
      drawn.picture.truth = truth;
    }
  }
  return drawn;
}

void explain_measures(const Trials& trials, Markdown& body) {
  const Trial& shipped = trials.at(kHitsWinName);
  const Trial& all_known = trials.at(kDoubleName);
  body.paragraph(
      "Truth: the simulator knows what is solid, but a grid can only know what its scanners could "
      "see. So each layer of each LUX sends ideal beams through the simulated world, without width "
      "or noise, 1/16 of a degree apart, up to the first solid, the ground or 50 m. A cell is "
      "visibly occupied if such a beam ends on a solid in it inside the height band, whatever "
      "passes over it; visibly free if beams cross it inside the band, none ends in it and no "
      "solid covers it; anything else is not scored. No rule of fusion has a part in this.");
  body.item(
      "**recall**: of the cells that are visibly so, the share that the grid calls so. "
      "**precision**: of the scored cells that the grid calls so, the share that are visibly so. "
      "First exact, then with a tolerance of one cell, because a range 10 cm off lies in the next "
      "cell: right if the cell or one of its eight neighbours is (called, or visibly) so.");
  body.item(
      "**area under ROC**: the share of the pairs of a visibly occupied and a visibly free cell in "
      "which the occupied one has the higher index or probability, a tie counting half. What a "
      "scan does not reach scores 0 or 1/2, which keeps every area far from 1.");
  body.item(
      "**missed**: of the visibly occupied cells, the share that the grid calls free; then of "
      "those the ones without an occupied neighbour.");
  body.item(
      "**phantoms**: cells a frame that the grid calls occupied, that are visibly free and have no "
      "visibly occupied neighbour.");
  body.item(
      "**hits lost**: of the cells in which a beam of the frame ended and could mark, the share "
      "that comes out free.");
  body.paragraph(
      "Measured on " + std::to_string(shipped.frames) +
      " frames of the simulated drive, one in five: " +
      grouped(static_cast<double>(shipped.detection.occupied.visible)) + " visibly occupied and " +
      grouped(static_cast<double>(shipped.detection.free.visible)) +
      " visibly free cells. A LUX sends a beam every 0.5 degrees, 44 cm apart at 50 m, so its scan "
      "says something of only " +
      percent(all_known.detection.known_of_occupied(), 1) + " of the former and " +
      percent(all_known.detection.known_of_free(), 1) +
      " of the latter, which bounds exact recall. A probability within 1e-3 of 1/2 counts as "
      "unknown.");
}

// Whether `a` is better than `b` in all that weighs for an obstacle's sake.
bool detects_better(const Trial& a, const Trial& b) {
  return a.detection.occupied.recall() > b.detection.occupied.recall() &&
         a.roc.area() > b.roc.area() && a.detection.miss_rate() < b.detection.miss_rate() &&
         a.ended.lost() <= b.ended.lost();
}

std::string against(const Trial& a, const Trial& b) {
  const ClassScore& occupied = a.detection.occupied;
  const ClassScore& other = b.detection.occupied;
  return "occupied recall " + both(occupied.recall(), occupied.recall_near()) + " against " +
         both(other.recall(), other.recall_near()) + ", area " + fixed(a.roc.area(), 3) +
         " against " + fixed(b.roc.area(), 3) + ", missed " +
         both(a.detection.miss_rate(), a.detection.miss_rate_near()) + " against " +
         both(b.detection.miss_rate(), b.detection.miss_rate_near()) + ", hits lost " +
         percent(a.ended.lost(), 1) + " against " + percent(b.ended.lost(), 1) +
         "; on the other side phantoms, " + fixed(a.phantoms_per_frame(), 1) + " against " +
         fixed(b.phantoms_per_frame(), 1) + " a frame";
}

std::string words_on_rule(const Trials& trials) {
  const Trial& hits_win = trials.at(kHitsWinName);
  const Trial& bayes = trials.at(kBayesName);
  return std::string("**The rule**: ") +
         (detects_better(hits_win, bayes) ? "hits_win" : "not decided by this drive") +
         ". Against the sum: " + against(hits_win, bayes) +
         ". A perception output must not lose what a sensor saw; what it saw wrongly can still be "
         "sorted out by whoever follows cells over time. What that costs is in the next section.";
}

std::string words_on_quantisation(const Trials& trials) {
  const Trial& blurring = trials.at(kHitsWinName);
  const Trial& nearest = nearest_of(trials);
  const std::string comparison =
      "Nearest against blurring, both under hits_win: " + against(nearest, blurring) + ".";
  if (!detects_better(nearest, blurring)) {
    return "**The quantisation**: blurring, the default. " + comparison;
  }
  const auto [free, occupied] = blurring.roc.at_least(1);
  const double at_same_rate = nearest.roc.recall_within(free);
  const std::string ranking =
      "With a threshold that lets through no more visibly free cells than "
      "blurring does, " +
      percent(free, 2) + ", nearest recalls " + percent(at_same_rate, 1) + " exactly, blurring " +
      percent(occupied, 1) + ". ";
  const std::string change =
      " `quantisation` in a vehicle description is all that it takes to change it.";
  if (at_same_rate > occupied) {
    return "**The quantisation**: here the numbers speak against the default. " + comparison + " " +
           ranking + "So nearest is the one to ship." + change;
  }
  return "**The quantisation**: here the numbers do not speak for the default alone. " +
         comparison + " " + ranking +
         "So nearest is no better judge, it is a bolder one: who must find as much as a frame "
         "holds and follows cells over time should take it. The default stays blurring, which "
         "never says more than the sensor does (section 3.4.4.1), has the fewer phantoms, also "
         "for each drop of rain, and keeps gaps wider (next section)." +
         change;
}

void say_what_to_ship(const Trials& trials, Markdown& body) {
  body.subheading("Which settings to ship");
  body.item(words_on_rule(trials));
  body.item(words_on_quantisation(trials));
  body.item(
      "**Epsilon**: 0.05 in an int8. It is the smallest of the sweep at which nine beams fit a "
      "byte and p_-127 is below 1e-11. At 0.02 the same cells are marked as under nearest, with "
      "room for three beams; below that the bytes fill with one or two, and what is gained is k - "
      "1 and k + 2, within a hundredth of 1/2.");
  body.item(
      "**Traversal and sampling**: every cell that the line crosses, the hit in its own cell. They "
      "are the only ones here under which hits_win keeps every hit.");
}

Claim claim_on_lost_hits(const Trials& trials) {
  const double ours = trials.at(kHitsWinName).ended.lost();
  const double sum = trials.at(kSequentialName).ended.lost();
  return {.place = "equation 4.4",
          .what = "cells in which a beam ended that come out free, simulated drive",
          .paper = percent(sum, 1) + " under its sum, counted here",
          .ours = percent(ours, 1),
          .verdict = ours < sum ? Verdict::kBeats : Verdict::kFallsShort,
          .reason = "hits_win: a beam that passes over a cell does not erase a hit in it"};
}

Claim claim_on_float(const Trials& trials) {
  const double ours =
      trials
          .at(name_of(IndexFusion{
              .rule = IndexRule::kBayes, .epsilon = kWideSweep.back(), .limit = kNoLimit}))
          .roc.area();
  const double in_double = trials.at(kDoubleName).roc.area();
  const double difference = std::max(ours - in_double, in_double - ours);
  return {.place = "section 4.3.2.1",
          .what = "area under ROC of the index sum as epsilon falls to 0.001, wide",
          .paper = "that of floating-point Bayes, " + fixed(in_double, 3) + " counted here",
          .ours = fixed(ours, 3),
          .verdict = difference < 0.01 ? Verdict::kEquals : Verdict::kDeparts,
          .reason = difference < 0.01 ? "" : "values that epsilon still rounds to 1/2"};
}

Claim claim_on_maximum(const Trials& trials) {
  const ClassScore& maximum = trials.at(kMaximumName).detection.occupied;
  const ClassScore& bayes = trials.at(kDoubleName).detection.occupied;
  const bool is_so = maximum.called - maximum.right > bayes.called - bayes.right;
  return {.place = "section 2.4.4",
          .what = "wrongly occupied cells of the maximum policy",
          .paper = "favours false positives",
          .ours = grouped(static_cast<double>(maximum.called - maximum.right)) + " against " +
                  grouped(static_cast<double>(bayes.called - bayes.right)) + " of Bayes",
          .verdict = is_so ? Verdict::kEquals : Verdict::kDeparts,
          .reason = is_so ? "" : "this drive has too few false echoes"};
}

Claim claim_on_nearest(const Trials& trials) {
  const Trial& nearest = nearest_of(trials);
  const Trial& blurring = trials.at(kHitsWinName);
  const double recall = blurring.detection.occupied.recall();
  const double other = nearest.detection.occupied.recall();
  return {.place = "section 3.4.4.1",
          .what = "exact occupied recall, blurring (default) against nearest",
          .paper = percent(other, 1) + " with nearest, counted here",
          .ours = percent(recall, 1),
          .verdict = recall < other ? Verdict::kFallsShort : Verdict::kBeats,
          .reason = "nearest also marks behind a hit: " + fixed(nearest.phantoms_per_frame(), 1) +
                    " phantom cells a frame against " + fixed(blurring.phantoms_per_frame(), 1)};
}

std::string file_of(const Recording& recording) {
  std::string name("`");
  name.append(std::filesystem::path(recording.pcap).filename().string()).append("`");
  return name;
}

Trials try_on(const Recording& recording) {
  const tools::CatalogueEntry& car = tools::find_vehicle(recording.vehicle);
  Trials trials(car, all_choices());
  for (const FramePoints& points : read_points(recording.pcap, car)) {
    trials.add(points);
  }
  return trials;
}

std::string words_on(const Recording& recording, const Trials& trials) {
  const Trial& ours = trials.at(kHitsWinName);
  const auto lost = [&trials](const std::string& name) {
    return percent(trials.at(name).ended.lost(), 1);
  };
  return file_of(recording) + ": " + std::to_string(ours.frames) + " frames, " +
         grouped(static_cast<double>(ours.ended.all())) + " such cells. The thesis's sum loses " +
         lost(kSequentialName) + " of them and " +
         lost(name_of(IndexRule::kBayes, {.sampling = Sampling::kCentre})) +
         " if it is sampled at the cell centre, too; hits_win " + lost(kHitsWinName) + ".";
}

Claim claim_on(const Recording& recording, const Trials& trials) {
  const double ours = trials.at(kHitsWinName).ended.lost();
  const double sum = trials.at(kSequentialName).ended.lost();
  return {.place = "equation 4.4",
          .what = "hits lost on recording " + file_of(recording),
          .paper = percent(sum, 1) + " under its sum, counted here",
          .ours = percent(ours, 1),
          .verdict = ours < sum ? Verdict::kBeats : Verdict::kFallsShort,
          .reason = "hits_win: a beam that passes over a cell does not erase a hit in it"};
}

// One row for each choice that leaves any hit out on any recording, one sentence for the others.
void print_recordings(const std::vector<Trials>& trials, const std::vector<std::string>& columns,
                      Markdown& body) {
  Rows rows;
  std::string flawless;
  for (const Choice& choice : all_choices()) {
    std::vector<std::string> row{choice.name};
    bool keeps_all = true;
    for (const Trials& of_recording : trials) {
      const EndedCells& ended = of_recording.at(choice.name).ended;
      row.push_back(both(ended.lost(), ended.left_unknown()));
      keeps_all = keeps_all && ended.occupied == ended.all();
    }
    if (keeps_all) {
      flawless.append(flawless.empty() ? "" : "; ").append(choice.name);
    } else {
      rows.push_back(row);
    }
  }
  body.table(columns, rows);
  body.paragraph("Occupied is every such cell under: " + flawless + ".");
}

// A recording has no truth, but what its own beams hit.
void describe_recordings(const TablesInput& input, Section& section) {
  Markdown& body = section.body;
  body.subheading("Hits lost on each recording");
  body.paragraph(
      "A recording has no truth but its own hits: of the cells in which a beam ended and could "
      "mark, the share that comes out free / unknown.");
  std::vector<std::string> columns{"choice"};
  std::vector<Trials> trials;
  for (const Recording& recording : input.recordings) {
    columns.push_back(file_of(recording));
    trials.push_back(try_on(recording));
    body.item(words_on(recording, trials.back()));
    section.claims.push_back(claim_on(recording, trials.back()));
  }
  print_recordings(trials, columns, body);
  body.paragraph(
      "Where *bayes* loses fewer hits than *sequential*, or a small epsilon fewer than a large "
      "one, the reason is the int8: all carving comes first and stops at -127, and what the marks "
      "add is not carved again.");
}

}  // namespace

Section detection_quality(const TablesInput& input) {
  const QualityDrive drawn = try_on_drive(input);
  const Trials& trials = drawn.trials;
  Section section;
  section.claims = {claim_on_lost_hits(trials), claim_on_float(trials), claim_on_maximum(trials),
                    claim_on_nearest(trials)};
  Markdown& body = section.body;
  body.heading("What the choices cost: detection quality");
  explain_measures(trials, body);
  describe_fusion_rules(input, drawn, body);
  describe_quantisation(input, drawn, body);
  describe_traversal(input, drawn, body);
  describe_sampling(input, drawn, body);
  say_what_to_ship(trials, body);
  if (!input.recordings.empty()) {
    describe_recordings(input, section);
  }
  return section;
}

}  // namespace iog::lab
