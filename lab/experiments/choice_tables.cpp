// The tables of the choices: one function each.
#include "lab/experiments/choice_tables.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

#include "lab/experiments/choice_pictures.hpp"
#include "lab/experiments/quality_choices.hpp"
#include "tools/simulate/random.hpp"

namespace iog::lab {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::vector<std::string> row_of(const Trial& trial) {
  const ClassScore& occupied = trial.detection.occupied;
  const ClassScore& free = trial.detection.free;
  return {trial.choice.name,
          both(occupied.recall(), occupied.recall_near()),
          both(occupied.precision(), occupied.precision_near()),
          both(free.recall(), free.recall_near()),
          fixed(100 * free.precision(), 2) + " / " + percent(free.precision_near(), 2),
          fixed(trial.roc.area(), 3),
          both(trial.detection.miss_rate(), trial.detection.miss_rate_near()),
          fixed(trial.phantoms_per_frame(), 1),
          percent(trial.ended.lost(), 1)};
}

const std::vector<std::string> kColumns{"choice",      "occupied recall", "precision",
                                        "free recall", "precision",       "area under ROC",
                                        "missed",      "phantoms",        "hits lost"};

void print_table(const Trials& trials, const std::vector<Choice>& choices, Markdown& body) {
  Rows rows;
  for (const Choice& choice : choices) {
    rows.push_back(row_of(trials.at(choice.name)));
  }
  body.table(kColumns, rows);
}

// A curve of some hundred points at most, for the logarithmic axis: nothing at a rate of 0, and no
// point that lies within a hair of the one before.
Series roc_series(const std::string& name, const Roc& roc) {
  constexpr double kHair = 0.002;
  Series series{.name = name, .points = {}, .style = Series::Style::kSteps};
  std::pair<double, double> last{-1, -1};
  for (const auto& point : roc.curve()) {
    const bool is_apart = point.first > last.first * (1 + 10 * kHair) ||
                          point.second > last.second + kHair || point.second == 1;
    if (point.first > 0 && is_apart) {
      series.points.push_back(point);
      last = point;
    }
  }
  return series;
}

void draw_roc(const TablesInput& input, const Trials& trials, Markdown& body) {
  Plot plot{.title = "Occupied from free cells",
            .x_label = "share of the visibly free cells at or above the threshold",
            .y_label = "share of the visibly occupied cells",
            .has_log_x = true,
            .series = {}};
  const std::string nearest = name_of(IndexFusion{.policy = index::Quantisation::kNearest});
  for (const std::string& name :
       {std::string(kHitsWinName), std::string(kBayesName), std::string(kDoubleName),
        std::string(kPoolName), std::string(kMaximumName), nearest}) {
    plot.series.push_back(roc_series(name, trials.at(name).roc));
  }
  body.picture(draw(input, "choice_roc.svg", plot),
               "ROC of the fusion rules; the jump at the right is what a scan does not reach");
}

template <typename Value>
Value value_of(const ByStep<Value>& values, int step) {
  return values[slot_of(step)];
}

std::string list_of(const ByStep<std::int32_t>& values) {
  std::string text;
  for (const int step : {-kFarSteps, -2, -1, 0, 1, 2}) {
    text += (text.empty() ? "" : ", ") + std::to_string(value_of(values, step));
  }
  return text;
}

// The model's probability of that step, as the text names it: "0.542".
std::string named(int step) { return fixed(value_of(probabilities({}), step), 3); }

// The largest epsilon of the sweep at which that is so of the indexes by blurring.
std::string first_of_sweep(const std::function<bool(const ByStep<std::int32_t>&)>& is_so) {
  const ByStep<double> model = probabilities({});
  const auto* const epsilon = std::find_if(kSweep.begin(), kSweep.end(), [&](double each) {
    return is_so(indexes(model, each, index::Quantisation::kBlurring));
  });
  return epsilon == kSweep.end() ? "none" : fixed(*epsilon, 3);
}

// What a scan point is worth under each epsilon, and how far a byte of it reaches.
void print_values(Markdown& body) {
  const ByStep<double> model = probabilities({});
  Rows rows;
  for (const double epsilon : kSweep) {
    for (const auto policy : {index::Quantisation::kBlurring, index::Quantisation::kNearest}) {
      const bool is_nearest = policy == index::Quantisation::kNearest;
      if (is_nearest && epsilon != kDefaultEpsilon) {
        continue;
      }
      const index::RecursiveSet set(epsilon);
      const ByStep<std::int32_t> values = indexes(model, epsilon, policy);
      rows.push_back({fixed(epsilon, 3), is_nearest ? "nearest" : "blurring", list_of(values),
                      scientific(set.probability(-kInt8Limit), 1),
                      std::to_string(kInt8Limit / -values.front() + 1)});
    }
  }
  body.table({"epsilon", "policy", "indexes of up to k-3, k-2, k-1, k, k+1, k+2", "p of -127",
              "beams that fill an int8"},
             rows);
}

// Of hits at random ranges and directions, the share whose own cell does not take the index of
// cell k.
double displaced(const tools::CatalogueEntry& car, std::uint64_t seed, Sampling sampling) {
  constexpr int kPoints = 20'000;
  constexpr std::uint64_t kStream = 77;
  tools::Random random(seed, kStream);
  std::uint64_t hits = 0;
  std::uint64_t own = 0;
  for (int i = 0; i < kPoints; ++i) {
    const auto ticks = static_cast<std::int32_t>(random.below(3200)) - 1600;
    const lidar::ScanPoint point{
        .range_mm = 1000 + static_cast<std::uint32_t>(random.below(48'000)),
        .azimuth_ticks = static_cast<std::uint16_t>(ticks < 0 ? ticks + 11'520 : ticks),
        .layer = static_cast<std::uint8_t>(random.below(4))};
    const std::size_t sensor = random.below(car.sensors.size());
    const FrameEvidence evidence =
        project(*car.vehicle, {{.sensor = sensor, .point = point}}, {.sampling = sampling});
    if (!evidence.hits.empty()) {
      ++hits;
      own += std::any_of(evidence.cells.begin(), evidence.cells.end(),
                         [&](const CellEvidence& seen) {
                           return seen.step == 0 && seen.cell == evidence.hits.front();
                         })
                 ? 1U
                 : 0U;
    }
  }
  return 1 - static_cast<double>(own) / static_cast<double>(hits);
}

}  // namespace

void describe_fusion_rules(const TablesInput& input, const QualityDrive& drive, Markdown& body) {
  const Trials& trials = drive.trials;
  const Trial& hits_win = trials.at(kHitsWinName);
  const Trial& bayes = trials.at(kBayesName);
  const Trial& in_double = trials.at(kDoubleName);
  const Trial& pool = trials.at(kPoolName);
  const Trial& maximum = trials.at(kMaximumName);
  const Trial& fine = trials.at(name_of(IndexFusion{.epsilon = 0.005}));
  body.subheading("Fusion rule");
  print_table(trials, rule_choices(), body);
  body.paragraph(
      "Under every form of Bayes a beam that passes through a cell weighs seven times a hit in it "
      "(-14 against +2), and four layers are projected on one plane: " +
      percent(bayes.ended.lost(), 1) +
      " of the cells in which a beam ended come out free under the index sum, " +
      percent(in_double.ended.lost(), 1) +
      " under Bayes in double, so that is no fault of the integers. The linear opinion pool "
      "averages, which changes nothing of that: " +
      percent(pool.ended.lost(), 1) + ". hits_win loses " + percent(hits_win.ended.lost(), 1) +
      " and misses " + percent(hits_win.detection.miss_rate_near(), 1) +
      " of the visibly occupied cells by more than a cell, the sum " +
      percent(bayes.detection.miss_rate_near(), 1) + ". It pays with " +
      fixed(hits_win.phantoms_per_frame(), 1) + " phantom cells a frame, the sum has " +
      fixed(bayes.phantoms_per_frame(), 1) + ".");
  body.paragraph("The maximum policy loses no hit either, and its area under the curve is " +
                 fixed(maximum.roc.area(), 3) + ", that of hits_win " +
                 fixed(hits_win.roc.area(), 3) +
                 ". That is the quantisation's doing, not the rule's: in double the cells k + 1 (" +
                 named(1) + ") and k + 2 (" + named(2) +
                 ") behind a hit count as occupied, which blurring at epsilon = 0.05 calls "
                 "unknown. hits_win at epsilon = 0.005, where they count, too, calls " +
                 grouped(static_cast<double>(fine.detection.occupied.called)) +
                 " scored cells occupied, the maximum policy " +
                 grouped(static_cast<double>(maximum.detection.occupied.called)) +
                 ". What the maximum lacks is reinforcement: one hit or ten are the same to it.");
  body.picture(draw(input, "choice_of_rule.png", picture_of(drive.picture, rule_choices())),
               "One frame under each fusion rule, the truth that it is scored by, and its hits");
  draw_roc(input, trials, body);
  const double rate = hits_win.roc.at_least(1).first;
  const auto within = [&trials](const std::string& name, double free_share) {
    return percent(trials.at(name).roc.recall_within(free_share), 1);
  };
  constexpr double kRare = 1e-4;
  body.paragraph(
      "Indexes also rank cells, and a reader may set a threshold above 0. If no more visibly free "
      "cells may come out occupied than under hits_win with every index above 0, " +
      percent(rate, 2) + ", the exact recall is " + within(kHitsWinName, rate) +
      " under hits_win, " + within(kBayesName, rate) + " under the sum, " +
      within(kDoubleName, rate) + " under Bayes in double; if only one in 10,000 may, " +
      within(kHitsWinName, kRare) + ", " + within(kBayesName, kRare) + " and " +
      within(kDoubleName, kRare) +
      ": where beams disagree hits_win keeps nothing but the hits, so its high indexes tell less. "
      "What it buys with that are the hits and obstacles that it keeps at all: see missed and hits "
      "lost.");
}

void describe_quantisation(const TablesInput& input, const QualityDrive& drive, Markdown& body) {
  const Trials& trials = drive.trials;
  const auto sum_at = [&trials](double epsilon, std::int32_t limit) -> const Trial& {
    return trials.at(
        name_of(IndexFusion{.rule = IndexRule::kBayes, .epsilon = epsilon, .limit = limit}));
  };
  const Trial& blurring = trials.at(kHitsWinName);
  const Trial& nearest = nearest_of(trials);
  body.subheading("Quantisation and epsilon");
  print_values(body);
  print_table(trials, quantisation_choices(), body);
  body.paragraph(
      "What tells is the sign of an index. At epsilon = 0.2 a hit, " + named(0) +
      ", is below p_1 = " + fixed(index::RecursiveSet(kSweep.front()).probability(1), 3) +
      ", and blurring leaves nothing of it: no cell is ever occupied. Nearest, or an epsilon of " +
      first_of_sweep([](const auto& values) { return value_of(values, 1) > 0; }) +
      " and less, turn cell k + 1 (" + named(1) +
      ") from unknown to occupied, so that a hit marks two cells or more of its beam: exact recall "
      "goes from " +
      percent(blurring.detection.occupied.recall(), 1) + " to " +
      percent(nearest.detection.occupied.recall(), 1) +
      " under nearest. A range that came out short marks the surface's true cell that way; one "
      "that was right marks the cell behind the surface, mostly inside the solid, where nothing is "
      "scored, but also free ones behind what is thin or seen from the side: phantoms go from " +
      fixed(blurring.phantoms_per_frame(), 1) + " to " + fixed(nearest.phantoms_per_frame(), 1) +
      " a frame. From " +
      first_of_sweep([](const auto& values) { return value_of(values, -1) < 0; }) +
      " on cell k - 1 (" + named(-1) + ") is carved, too.");
  const double smallest = kSweep.back();
  body.paragraph(
      "Saturation: from epsilon = " +
      first_of_sweep([](const auto& values) { return values.front() < -kInt8Limit; }) +
      " on a single beam fills an int8, so ten beams and one say the same. Under hits_win no sign "
      "can change by that, and only the order of the cells among themselves is lost. Under the sum "
      "it helps the hits: carving stops at -127 while a hit is worth more and more. At epsilon = " +
      fixed(smallest, 3) + " the sum loses " +
      percent(sum_at(smallest, kInt8Limit).ended.lost(), 1) + " of the hits in an int8 and " +
      percent(sum_at(smallest, kNoLimit).ended.lost(), 1) + " in a wide index, Bayes in double " +
      percent(trials.at(kDoubleName).ended.lost(), 1) +
      ": what looks like a gain is a limit that was run into.");
  std::vector<Choice> drawn_choices;
  for (const IndexFusion& fusion :
       {IndexFusion{}, IndexFusion{.policy = index::Quantisation::kNearest},
        IndexFusion{.epsilon = 0.2}, IndexFusion{.epsilon = 0.02}, IndexFusion{.epsilon = 0.005},
        IndexFusion{.epsilon = 0.001}}) {
    drawn_choices.push_back({.name = name_of(fusion), .fusion = fusion});
  }
  body.picture(draw(input, "choice_of_epsilon.png", picture_of(drive.picture, drawn_choices)),
               "The same frame under hits_win with other quantisations; int8");
}

void describe_traversal(const TablesInput& input, const QualityDrive& drive, Markdown& body) {
  const Trials& trials = drive.trials;
  const Trial& crossed = trials.at(kHitsWinName);
  const Trial& bresenham = trials.at(name_of(IndexRule::kHitsWin, {.path = Path::kBresenham}));
  const EndedCells& ended = bresenham.ended;
  body.subheading("Traversal");
  print_table(trials, traversal_choices(), body);
  body.paragraph(
      "Bresenham visits one cell per step of the longer axis, not every cell that the beam "
      "crosses: free recall falls from " +
      percent(crossed.detection.free.recall(), 1) + " to " +
      percent(bresenham.detection.free.recall(), 1) +
      ". And the cell that it visits at the hit's step is not always the one that holds the hit: "
      "of the cells that hold one " +
      percent(ended.lost(), 1) + " come out free and " + percent(ended.left_unknown(), 1) +
      " unknown under hits_win, which loses none on the cells that the line really crosses. That "
      "the sum loses fewer hits on Bresenham's path is no merit: it carves fewer cells.");
  body.picture(
      draw(input, "choice_of_traversal.png", picture_of(drive.picture, traversal_choices())),
      "The same frame with the cells that a beam crosses and with those of Bresenham");
}

void describe_sampling(const TablesInput& input, const QualityDrive& drive, Markdown& body) {
  const Trials& trials = drive.trials;
  const Trial& exact = trials.at(kHitsWinName);
  const Trial& centre = trials.at(name_of(IndexRule::kHitsWin, {.sampling = Sampling::kCentre}));
  const Trial& entry = trials.at(name_of(IndexRule::kHitsWin, {.sampling = Sampling::kEntry}));
  const tools::CatalogueEntry& car = *drive.picture.car;
  body.subheading("Sampling");
  print_table(trials, sampling_choices(), body);
  body.paragraph(
      "From which cell of the local 1D grid does a 2D cell take its index? By default exactly the "
      "cell that holds the scan point takes that of k. Sampled where the cell's centre projects "
      "to, as figure 4.8 has it, " +
      percent(displaced(car, input.seed, Sampling::kCentre), 1) +
      " of 20,000 hits at random ranges and directions do not mark the cell that holds them, " +
      percent(displaced(car, input.seed, Sampling::kEntry), 1) + " where the beam enters it, and " +
      percent(displaced(car, input.seed, Sampling::kContract), 1) +
      " by the default. On the drive hits_win then loses " + percent(centre.ended.lost(), 1) +
      " and " + percent(entry.ended.lost(), 1) + " of the hits to free, and " +
      percent(centre.ended.left_unknown(), 1) + " and " + percent(entry.ended.left_unknown(), 1) +
      " stay unknown.");
  body.paragraph(
      "At the cell centre a hit marks no, one or two cells, " +
      grouped(static_cast<double>(centre.detection.occupied.called)) +
      " scored ones in all against " +
      grouped(static_cast<double>(exact.detection.occupied.called)) +
      "; that is why its recall is " + percent(centre.detection.occupied.recall(), 1) +
      " against " + percent(exact.detection.occupied.recall(), 1) +
      " although it loses hits: with noise of 7 cm a second cell is right about as often as the "
      "first. Whoever wants that should take nearest, which marks a second cell and loses no hit.");
  body.picture(draw(input, "choice_of_sampling.png", picture_of(drive.picture, sampling_choices())),
               "The same frame with the default sampling, at the cell's centre and at its entry");
}

std::string both(double exact, double near) {
  return fixed(100 * exact, 1) + " / " + percent(near, 1);
}

const Trial& nearest_of(const Trials& trials) {
  return trials.at(name_of(IndexFusion{.policy = index::Quantisation::kNearest}));
}

}  // namespace iog::lab
