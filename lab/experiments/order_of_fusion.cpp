// What the order of a frame's scan points is worth: to the thesis's sum it matters, to the
// contract's rules it must not.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "grid/frame_fusion.hpp"
#include "lab/evidence/frame_points.hpp"
#include "lab/evidence/fusion_rules.hpp"
#include "lab/experiments/sections.hpp"
#include "tools/simulate/random.hpp"

namespace iog::lab {
namespace {

using index::Quantisation;

constexpr const char* kCar = "reference_car";
constexpr double kEpsilon = 0.05;
constexpr std::int32_t kInt8Limit = 127;
constexpr std::array kPolicies{Quantisation::kBlurring, Quantisation::kNearest};
constexpr std::array kPolicyNames{"blurring", "nearest"};

// Orders other than that of arrival.
enum class Order : std::uint8_t { kReversed, kOtherSensorFirst, kShuffled };
constexpr std::array kOrders{Order::kReversed, Order::kOtherSensorFirst, Order::kShuffled};

FramePoints in_order(FramePoints points, Order order, std::uint64_t seed) {
  switch (order) {
    case Order::kReversed:
      std::ranges::reverse(points);
      break;
    case Order::kOtherSensorFirst:
      std::ranges::stable_sort(points, std::ranges::greater{}, &SensorPoint::sensor);
      break;
    case Order::kShuffled: {
      tools::Random random(seed);
      for (std::size_t i = points.size(); i > 1; --i) {
        std::swap(points[i - 1], points[random.below(i)]);
      }
      break;
    }
  }
  return points;
}

// How many cells of two grids differ.
struct Difference {
  std::uint64_t cells = 0;
  std::uint64_t signs = 0;   // occupied, free and unknown exchanged
  std::uint64_t frames = 0;  // with at least one such cell
  std::int32_t largest = 0;  // of indexes

  void add(const std::vector<std::int32_t>& one, const std::vector<std::int32_t>& other) {
    const std::uint64_t before = cells;
    for (std::size_t i = 0; i < one.size(); ++i) {
      if (one[i] != other[i]) {
        ++cells;
        signs += sign_of(one[i]) != sign_of(other[i]) ? 1U : 0U;
        largest = std::max(largest, std::abs(one[i] - other[i]));
      }
    }
    frames += cells > before ? 1U : 0U;
  }

 private:
  static int sign_of(std::int32_t index) { return (index > 0 ? 1 : 0) - (index < 0 ? 1 : 0); }
};

// The frames of one drive or recording under one policy.
struct Outcome {
  ByStep<std::int32_t> values;
  std::uint64_t known = 0;  // cells that some index was added to
  std::uint64_t both = 0;   // of these, cells with indexes of both signs
  Difference from_bayes;    // the sequential sum in the order of arrival, and the contract's bayes
  std::array<Difference, kOrders.size()> from_order;  // the same sum in another order
  std::uint64_t above_bayes = 0;                      // cells in which any order gave more
  std::uint64_t contract = 0;                         // cells in which an order shows in its rules
};

struct Drives {
  std::string name;
  std::uint32_t frames = 0;
  std::array<Outcome, kPolicies.size()> outcomes;
};

void count_signs(const FrameEvidence& evidence, Outcome& outcome) {
  std::vector<std::uint8_t> signs(grid::kCellCount);
  for (const CellEvidence& seen : evidence.cells) {
    const std::int32_t value = outcome.values[slot_of(seen.step)];
    const unsigned sign = value < 0 ? 1U : 2U;
    signs[seen.cell] |= static_cast<std::uint8_t>(value == 0 ? 0U : sign);
  }
  for (const std::uint8_t sign : signs) {
    outcome.known += sign != 0 ? 1U : 0U;
    outcome.both += sign == 3 ? 1U : 0U;
  }
}

std::uint64_t cells_above(const std::vector<std::int32_t>& one,
                          const std::vector<std::int32_t>& other) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    count += one[i] > other[i] ? 1U : 0U;
  }
  return count;
}

void add_frame(const FrameEvidence& arrival,
               const std::array<FrameEvidence, kOrders.size()>& reordered, Outcome& outcome) {
  const auto fuse = [&](const FrameEvidence& evidence, IndexRule rule) {
    return fuse_indexes(evidence, outcome.values, rule, kInt8Limit);
  };
  count_signs(arrival, outcome);
  const auto sequential = fuse(arrival, IndexRule::kSequential);
  const auto bayes = fuse(arrival, IndexRule::kBayes);
  const auto hits_win = fuse(arrival, IndexRule::kHitsWin);
  outcome.from_bayes.add(sequential, bayes);
  outcome.above_bayes += cells_above(sequential, bayes);
  Difference contract;
  for (std::size_t i = 0; i < kOrders.size(); ++i) {
    const auto other = fuse(reordered[i], IndexRule::kSequential);
    outcome.from_order[i].add(sequential, other);
    outcome.above_bayes += cells_above(other, bayes);
    contract.add(bayes, fuse(reordered[i], IndexRule::kBayes));
    contract.add(hits_win, fuse(reordered[i], IndexRule::kHitsWin));
  }
  outcome.contract += contract.cells;
}

class Experiment {
 public:
  Experiment(const std::string& name, const tools::CatalogueEntry& car) : car_(&car) {
    drives_.name = name;
    const vehicle::SensorConfig& sensor = car.sensors[0];
    const auto model =
        probabilities({.sigma_m = sensor.sigma_m, .cell_length_m = sensor.precision_mm / 1000.0});
    for (std::size_t i = 0; i < kPolicies.size(); ++i) {
      drives_.outcomes[i].values = indexes(model, kEpsilon, kPolicies[i]);
    }
  }

  void add(const FramePoints& points) {
    const FrameEvidence arrival = project(*car_->vehicle, points, {});
    std::array<FrameEvidence, kOrders.size()> reordered;
    for (std::size_t i = 0; i < kOrders.size(); ++i) {
      reordered[i] = project(*car_->vehicle, in_order(points, kOrders[i], drives_.frames), {});
    }
    for (Outcome& outcome : drives_.outcomes) {
      add_frame(arrival, reordered, outcome);
    }
    ++drives_.frames;
  }

  [[nodiscard]] const Drives& drives() const { return drives_; }

 private:
  const tools::CatalogueEntry* car_;
  Drives drives_;
};

Drives simulated(const TablesInput& input) {
  const tools::CatalogueEntry& car = tools::find_vehicle(kCar);
  Experiment experiment("simulated drive", car);
  tools::Drive drive(car, input.seed, input.seconds);
  for (std::uint32_t frame = 0; frame < drive.frame_count(); ++frame) {
    drive.move_to(frame);
    experiment.add(points_of(drive, car));
  }
  return experiment.drives();
}

Drives recorded(const Recording& recording) {
  const tools::CatalogueEntry& car = tools::find_vehicle(recording.vehicle);
  Experiment experiment(std::filesystem::path(recording.pcap).filename().string(), car);
  for (const FramePoints& points : read_points(recording.pcap, car)) {
    experiment.add(points);
  }
  return experiment.drives();
}

std::string share(std::uint64_t part, std::uint64_t whole, int decimals) {
  return percent(whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole), decimals);
}

std::string count(std::uint64_t cells) { return grouped(static_cast<double>(cells)); }

// One row for each drive and policy.
void add_table(Markdown& body, const std::vector<Drives>& all,
               const std::vector<std::string>& columns,
               const std::function<std::vector<std::string>(const Outcome&)>& cells_of) {
  std::vector<std::vector<std::string>> rows;
  for (const Drives& drives : all) {
    for (std::size_t i = 0; i < kPolicies.size(); ++i) {
      std::vector<std::string> row{drives.name, kPolicyNames[i]};
      std::ranges::copy(cells_of(drives.outcomes[i]), std::back_inserter(row));
      rows.push_back(row);
    }
  }
  std::vector<std::string> all_columns{"frames of", "policy"};
  std::ranges::copy(columns, std::back_inserter(all_columns));
  body.table(all_columns, rows);
}

void print(Markdown& body, const std::vector<Drives>& all) {
  add_table(body, all,
            {"known cells", "of both signs", "sequential is not bayes", "of known",
             "of those of both signs", "other sign", "largest difference"},
            [](const Outcome& outcome) -> std::vector<std::string> {
              const Difference& found = outcome.from_bayes;
              return {count(outcome.known),
                      count(outcome.both),
                      count(found.cells),
                      share(found.cells, outcome.known, 3),
                      share(found.cells, outcome.both, 1),
                      count(found.signs),
                      count(static_cast<std::uint64_t>(found.largest))};
            });
  add_table(body, all,
            {"not reversed", "other sign", "not by sensor", "other sign", "not shuffled",
             "other sign", "of those of both signs"},
            [](const Outcome& outcome) {
              std::vector<std::string> cells;
              for (const Difference& found : outcome.from_order) {
                cells.push_back(count(found.cells));
                cells.push_back(count(found.signs));
              }
              cells.push_back(share(outcome.from_order.back().cells, outcome.both, 1));
              return cells;
            });
}

std::uint64_t sum_of(const std::vector<Drives>& all, std::uint64_t Outcome::*of) {
  std::uint64_t sum = 0;
  for (const Drives& drives : all) {
    for (const Outcome& outcome : drives.outcomes) {
      sum += outcome.*of;
    }
  }
  return sum;
}

// Neither paper says anything on order: whatever is found here is a departure, or a fault.
constexpr const char* kPlace = "equation 4.4";
constexpr const char* kNotSaid = "order not mentioned";

Claim claim_on_grids(const Drives& drives) {
  std::uint64_t grids = 0;
  for (const Outcome& outcome : drives.outcomes) {
    grids += outcome.from_order.back().frames;
  }
  return {.place = kPlace,
          .what = "grids that a shuffle of their points changes, sequential sum",
          .paper = kNotSaid,
          .ours = count(grids) + " of " + count(drives.frames * kPolicies.size()),
          .verdict = Verdict::kDeparts,
          .reason = "a saturated sum of both signs is not associative"};
}

Claim claim_on_sequential(const std::vector<Drives>& all, const std::string& where) {
  std::string ours;
  for (std::size_t i = 0; i < kPolicies.size(); ++i) {
    const auto differing = [i](const Drives& drives) {
      const Outcome& outcome = drives.outcomes[i];
      return outcome.known == 0 ? 0.0
                                : static_cast<double>(outcome.from_bayes.cells) /
                                      static_cast<double>(outcome.known);
    };
    const auto [least, most] = std::ranges::minmax(all, {}, differing);
    const std::string from = all.size() == 1 ? "" : fixed(100 * differing(least), 3) + " to ";
    ours += (i == 0 ? "" : ", ") + from + percent(differing(most), 3) + " " + kPolicyNames[i];
  }
  return {.place = kPlace,
          .what = "known cells in which the sequential sum is not `bayes`, " + where,
          .paper = kNotSaid,
          .ours = ours,
          .verdict = Verdict::kDeparts,
          .reason = "it forgets what came before the saturation of a cell"};
}

Claim claim_on_contract(const std::vector<Drives>& all, const std::string& where) {
  const std::uint64_t cells = sum_of(all, &Outcome::contract);
  return {.place = kPlace,
          .what = "cells that change with the order under `hits_win` and `bayes`, " + where,
          .paper = kNotSaid,
          .ours = count(cells),
          .verdict = cells == 0 ? Verdict::kDeparts : Verdict::kFallsShort,
          .reason = cells == 0 ? "all carving first, then all marking: sums of one sign commute"
                               : "a fault: no order may show"};
}

void describe(Markdown& body, const Drives& drives) {
  body.paragraph(
      "The thesis adds the indexes of a cell one after the other (equation 4.4) and saturates at "
      "+-127. Neither paper says in which order measurements come, nor that it matters. It does: "
      "sat(sat(120 + 14) - 14) is 113, sat(sat(120 - 14) + 14) is 120. And the order is chance: "
      "scanners send at the same time, and the network decides.");
  body.paragraph(
      "Measured here: the *sequential* sum in the order of arrival against the contract's `bayes`, "
      "and against itself when the same scan points come in another order: reversed, by sensor "
      "from the last to the first, shuffled. Counted are the cells that differ, and those in which "
      "occupied, free and unknown have changed places. epsilon = 0.05, int8, the " +
      std::to_string(drives.frames) +
      " frames of the simulated drive of four LUX together. Known cells are those that any index "
      "was added to.");
}

void explain(Markdown& body) {
  body.item(
      "Only a cell that has indexes of both signs and reaches +-127 can show an order. Ten free "
      "beams or 64 hits reach it; a LUX has few cells with both, a scanner of 16 layers in a small "
      "room many.");
  body.item(
      "The sum forgets what came before it saturated. At the lower end these are the hits that "
      "came early. `bayes` marks last, and its result is the largest of all orders: a mark that is "
      "put off never lowers the sum.");
}

void count_exceptions(Markdown& body, const std::vector<Drives>& all) {
  body.paragraph("Cells in which any order gave more than `bayes`: " +
                 count(sum_of(all, &Outcome::above_bayes)) +
                 ". Cells that change under the contract's rules, `hits_win` and `bayes`, on the "
                 "same frames in the same orders: " +
                 count(sum_of(all, &Outcome::contract)) + ".");
}

}  // namespace

Section order_of_fusion(const TablesInput& input) {
  const std::vector<Drives> drive{simulated(input)};
  Section section;
  section.claims = {claim_on_grids(drive[0]), claim_on_sequential(drive, "simulated"),
                    claim_on_contract(drive, "simulated")};
  Markdown& body = section.body;
  body.heading("The order of fusion");
  describe(body, drive[0]);
  print(body, drive);
  explain(body);
  count_exceptions(body, drive);
  if (!input.recordings.empty()) {
    std::vector<Drives> all;
    for (const Recording& recording : input.recordings) {
      all.push_back(recorded(recording));
    }
    section.claims.push_back(claim_on_sequential(all, "recordings"));
    section.claims.push_back(claim_on_contract(all, "recordings"));
    body.subheading("The order of fusion on recordings");
    print(body, all);
    count_exceptions(body, all);
  }
  return section;
}

}  // namespace iog::lab
