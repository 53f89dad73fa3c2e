// What the order of a frame's scan points is worth, to the thesis's sum and to the firmware's
// rules.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "grid/frame_fusion.hpp"
#include "lab/evidence/frame_points.hpp"
#include "lab/evidence/fusion_rules.hpp"
#include "lab/experiments/experiments.hpp"
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
constexpr std::array kOrderNames{"reversed", "by_sensor", "shuffled"};

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
  Difference from_bayes;    // the sequential sum in the order of arrival, and the firmware's bayes
  std::array<Difference, kOrders.size()> from_order;  // the same sum in another order
  std::uint64_t above_bayes = 0;                      // cells in which any order gave more
  std::uint64_t firmware = 0;  // cells in which an order shows under hits_win or bayes
};

struct Drives {
  std::string name;
  std::uint32_t frames = 0;
  std::array<Outcome, kPolicies.size()> outcomes;
};

void count_signs(const FrameEvidence& evidence, Outcome& outcome) {
  std::vector<std::uint8_t> signs(geometry::kCellCount);
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
  Difference firmware;
  for (std::size_t i = 0; i < kOrders.size(); ++i) {
    const auto other = fuse(reordered[i], IndexRule::kSequential);
    outcome.from_order[i].add(sequential, other);
    outcome.above_bayes += cells_above(other, bayes);
    firmware.add(bayes, fuse(reordered[i], IndexRule::kBayes));
    firmware.add(hits_win, fuse(reordered[i], IndexRule::kHitsWin));
  }
  outcome.firmware += firmware.cells;
}

class Measurement {
 public:
  Measurement(const std::string& name, const tools::CatalogueEntry& car) : car_(&car) {
    drives_.name = name;
    const description::SensorConfig& sensor = car.sensors[0];
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

Drives simulated(const Input& input) {
  const tools::CatalogueEntry& car = tools::find_vehicle(kCar);
  Measurement measurement("simulated drive", car);
  tools::Drive drive(car, input.seed, input.seconds);
  for (std::uint32_t frame = 0; frame < drive.frame_count(); ++frame) {
    measurement.add(points_of(drive, frame, car));
  }
  return measurement.drives();
}

Drives recorded(const Recording& recording) {
  const tools::CatalogueEntry& car = tools::find_vehicle(recording.vehicle);
  Measurement measurement(std::filesystem::path(recording.pcap).filename().string(), car);
  for (const FramePoints& points : read_points(recording.pcap, car)) {
    measurement.add(points);
  }
  return measurement.drives();
}

// suffix: of the tables' names.
Tables tables_of(const std::vector<Drives>& all, const std::string& suffix) {
  Table outcomes("order_of_fusion" + suffix,
                 {"drive", "policy", "frames", "known_cells", "cells_of_both_signs",
                  "cells_above_bayes_in_any_order", "cells_changed_under_firmware_rules"});
  Table differences("order_of_fusion_differences" + suffix,
                    {"drive", "policy", "sequential_sum_against", "cells", "cells_of_other_sign",
                     "frames", "largest_difference"});
  for (const Drives& drives : all) {
    for (std::size_t i = 0; i < kPolicies.size(); ++i) {
      const Outcome& outcome = drives.outcomes[i];
      outcomes.row(drives.name, kPolicyNames[i], drives.frames, outcome.known, outcome.both,
                   outcome.above_bayes, outcome.firmware);
      const auto add = [&](const char* against, const Difference& found) {
        differences.row(drives.name, kPolicyNames[i], against, found.cells, found.signs,
                        found.frames, found.largest);
      };
      add("bayes", outcome.from_bayes);
      for (std::size_t order = 0; order < kOrders.size(); ++order) {
        add(kOrderNames[order], outcome.from_order[order]);
      }
    }
  }
  return {std::move(outcomes), std::move(differences)};
}

}  // namespace

Tables order_of_fusion(const Input& input) {
  Tables tables = tables_of({simulated(input)}, "");
  if (!input.recordings.empty()) {
    std::vector<Drives> all;
    for (const Recording& recording : input.recordings) {
      all.push_back(recorded(recording));
    }
    std::ranges::move(tables_of(all, "_recordings"), std::back_inserter(tables));
  }
  return tables;
}

}  // namespace iog::lab
