// What unflagged rain does to the grid of one frame.
#include <algorithm>
#include <array>

#include "lab/evaluation/visibility.hpp"
#include "lab/experiments/false_echoes.hpp"
#include "lab/experiments/fusion_trial.hpp"
#include "lab/experiments/price_tables.hpp"

namespace iog::lab {
namespace {

using Rows = std::vector<std::vector<std::string>>;

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

  [[nodiscard]] const Trial& of(std::size_t fusion) const {
    return trials.at(name_of(kPricedFusions[fusion]));
  }
  [[nodiscard]] double drops_per_frame() const {
    return static_cast<double>(drops) / static_cast<double>(of(kHitsWinPlace).frames);
  }
  [[nodiscard]] double phantoms(std::size_t fusion) const {
    return of(fusion).phantoms_per_frame();
  }
};

std::vector<RainRow> rain_on_drive(const TablesInput& input) {
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
    drive.move_to(frame);
    const FramePoints points = points_of(drive, car);
    const std::vector<CellState> truth = visibility(car, drive.ego(), drive.solids());
    for (RainRow& row : rows) {
      const Rained rained = with_rain(points, *car.vehicle, row.rate, row.fate, random);
      row.trials.add(rained.points, truth);
      row.drops += rained.drops;
    }
  }
  return rows;
}

void print_rain(const std::vector<RainRow>& rain, Markdown& body) {
  Rows rows;
  for (const RainRow& row : rain) {
    const bool is_dry = row.rate == 0;
    rows.push_back({percent(row.rate, 1),
                    is_dry                              ? "-"
                    : row.fate == TrueEcho::kComesLater ? "comes second"
                                                        : "is lost",
                    fixed(row.drops_per_frame(), 1)});
    for (std::size_t i = 0; i < kPricedFusions.size(); ++i) {
      rows.back().push_back(fixed(row.phantoms(i), 1));
    }
    for (const std::size_t i : {kHitsWinPlace, kBayesPlace}) {
      rows.back().push_back(percent(row.of(i).detection.miss_rate_near(), 1));
    }
  }
  auto columns = columns_before_fusions({"beams hit", "true echo", "drops a frame"});
  columns.emplace_back("missed, hits_win");
  columns.emplace_back("missed, bayes");
  body.table(columns, rows);
}

Plot plot_of_rain(const std::vector<RainRow>& rain) {
  Plot plot{.title = "Unflagged drops, the true echo comes second",
            .x_label = "beams with a drop, %",
            .y_label = "phantoms a frame",
            .series = {}};
  for (std::size_t i = 0; i < kPricedFusions.size(); ++i) {
    Series series{
        .name = name_of(kPricedFusions[i]), .points = {}, .style = Series::Style::kLineAndPoints};
    for (const RainRow& row : rain) {
      if (row.fate == TrueEcho::kComesLater) {
        series.points.emplace_back(100 * row.rate, row.phantoms(i));
      }
    }
    plot.series.push_back(series);
  }
  return plot;
}

const RainRow& row_at(const std::vector<RainRow>& rain, double rate) {
  return *std::find_if(rain.begin(), rain.end(),
                       [rate](const RainRow& row) { return row.rate == rate; });
}

// Phantoms for each drop.
double price_of_drop(const std::vector<RainRow>& rain, std::size_t fusion) {
  const RainRow& wet = row_at(rain, kRates.back());
  return (wet.phantoms(fusion) - rain.front().phantoms(fusion)) / wet.drops_per_frame();
}

}  // namespace

void describe_rain(const TablesInput& input, Section& section) {
  const std::vector<RainRow> rain = rain_on_drive(input);
  Markdown& body = section.body;
  const RainRow& wet = row_at(rain, 0.01);
  body.subheading("Rain that the sensor does not flag");
  body.paragraph(
      "Frames of the simulated drive, one in ten. A drop stands somewhere between 1 m and the "
      "first echo of the given share of the beams; the true echo becomes the beam's second, which "
      "marks, or is lost with all behind it. Under each rule: phantoms, cells a frame that come "
      "out occupied although they are visibly free and have no visibly occupied neighbour. "
      "*Missed*: visibly occupied cells that come out free and have no occupied neighbour.");
  print_rain(rain, body);
  body.picture(draw(input, "price_of_rain.svg", plot_of_rain(rain)),
               "Phantoms by the share of beams that meet a drop");
  const auto [wet_free, wet_occupied] = wet.of(kHitsWinPlace).roc.at_least(1);
  const auto [sure_free, sure_occupied] = wet.of(kHitsWinPlace).roc.at_least(kMoreThanOneHit);
  body.paragraph("A drop costs hits_win " + fixed(price_of_drop(rain, kHitsWinPlace), 2) +
                 " phantoms, with nearest " + fixed(price_of_drop(rain, kNearestPlace), 2) +
                 " (it marks what lies behind the drop, too), the sum " +
                 fixed(price_of_drop(rain, kBayesPlace), 2) +
                 ": there the other beams through the same cell outvote it.");
  body.paragraph(
      "It is paid for drops alone that the sensor does not flag: flagged rain and dirt are taken "
      "out before fusion. Against the others a reader has two means. A drop is never in the same "
      "place twice, so a tracker, or a sum over a few frames, does not see it. And a drop is one "
      "hit, +2: with a threshold above that, in 1 % rain the visibly free cells that come out "
      "occupied fall from " +
      percent(wet_free, 3) + " to " + percent(sure_free, 3) + ", at the price of recall, from " +
      percent(wet_occupied, 1) + " to " + percent(sure_occupied, 1) + " exactly.");
  section.claims.push_back(
      {.place = "equation 4.4",
       .what = "phantom cells a frame, 1 % of the beams meet unflagged rain",
       .paper = fixed(wet.phantoms(kBayesPlace), 1) + " under its sum, counted here",
       .ours = fixed(wet.phantoms(kHitsWinPlace), 1),
       .verdict = wet.phantoms(kHitsWinPlace) > wet.phantoms(kBayesPlace) ? Verdict::kFallsShort
                                                                          : Verdict::kBeats,
       .reason = "the price of hits_win: it believes every echo that is not flagged"});
}

}  // namespace iog::lab
