#include "tools/mount/mount_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "tools/program/fixed.hpp"

namespace iog::tools {
namespace {

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  if (values.size() % 2 == 1) {
    return *middle;
  }
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

// The standard deviation that the middle half of normally distributed values has, which no stray
// one moves.
double deviation_of(std::vector<double> values, double median) {
  std::ranges::transform(values, values.begin(),
                         [&](double value) { return std::abs(value - median); });
  return 1.4826 * median_of(std::move(values));
}

std::span<const TurnMount> part_of(std::span<const TurnMount> turns, std::size_t part) {
  const std::size_t first = turns.size() * part / kParts;
  return turns.subspan(first, turns.size() * (part + 1) / kParts - first);
}

FittedValue fitted(std::span<const TurnMount> turns, double TurnMount::*member) {
  const auto values_of = [&](std::span<const TurnMount> some) {
    std::vector<double> values(some.size());
    std::ranges::transform(some, values.begin(), member);
    return values;
  };
  const std::vector<double> all = values_of(turns);
  FittedValue fit;
  fit.value = median_of(all);
  fit.scatter = deviation_of(all, fit.value);
  for (std::size_t part = 0; part < kParts; ++part) {
    fit.parts[part] = median_of(values_of(part_of(turns, part)));
  }
  return fit;
}

double seconds_apart(std::span<const TurnMount> turns) {
  std::array<double, kParts> middles{};
  for (std::size_t part = 0; part < kParts; ++part) {
    const auto its = part_of(turns, part);
    const TurnMount& middle = its[its.size() / 2];
    middles[part] = static_cast<double>(middle.time_us) / 1e6;
  }
  double apart = std::abs(middles[1] - middles[0]);
  for (std::size_t part = 2; part < kParts; ++part) {
    apart = std::min(apart, std::abs(middles[part] - middles[part - 1]));
  }
  return apart;
}

std::string words_of_too_few(const MountFit& fit, std::uint64_t turns) {
  const auto of = [&](CarState state) {
    return std::to_string(fit.turns[static_cast<std::size_t>(state)]);
  };
  std::string words = std::to_string(fit.taken) + " of " + std::to_string(turns) +
                      " turns show the ground from a car that drives evenly, and " +
                      std::to_string(kFewestTurns) + " are needed";
  if (of(CarState::kStands) != "0" || of(CarState::kLeans) != "0") {
    words += " (it stood for " + of(CarState::kStands) +
             " more, and braked, sped up or turned in " + of(CarState::kLeans) + ")";
  }
  if (const auto count = fit.turns[0]; count > 0 && fit.taken == 0) {
    words += "; " + std::to_string(count) + " more have no pose within a second";
  }
  if (2 * std::accumulate(fit.turns.begin(), fit.turns.end(), std::uint64_t{0}) < turns) {
    words +=
        "; the search covers 10 degrees and 1 m around the car's file, whose pitch_deg is "
        "positive down";
  }
  return words;
}

// Of what is no mount, or not the one that was asked for.
std::string words_of_doubt(const MountFit& fit) {
  const bool is_pitch = fit.pitch_deg.difference() >= kMostDifferenceDeg;
  if (!is_pitch && fit.z_m.difference() < kMostDifferenceM) {
    return {};
  }
  return "three parts of the recording differ by " +
         (is_pitch ? fixed(fit.pitch_deg.difference(), 2) + " degrees of pitch"
                   : fixed(fit.z_m.difference(), 2) + " m of height") +
         ": a longer one is needed, on another road";
}

}  // namespace

double FittedValue::difference() const {
  const auto [least, most] = std::ranges::minmax(parts);
  return most - least;
}

MountFit fit_of(std::span<const TurnMount> mounts, std::uint64_t turns, const MotionLog& motion,
                std::size_t fewest) {
  MountFit fit;
  std::vector<TurnMount> taken;
  for (const TurnMount& turn : mounts) {
    const CarState its = motion.at(turn.time_us);
    ++fit.turns[static_cast<std::size_t>(its)];
    if (its == CarState::kDrives || (its == CarState::kUnknown && motion.is_empty())) {
      taken.push_back(turn);
    }
  }
  fit.taken = taken.size();
  if (fit.taken < fewest) {
    fit.refusal = words_of_too_few(fit, turns);
    return fit;
  }
  fit.apart_s = seconds_apart(taken);
  fit.pitch_deg = fitted(taken, &TurnMount::pitch_deg);
  fit.roll_deg = fitted(taken, &TurnMount::roll_deg);
  fit.z_m = fitted(taken, &TurnMount::z_m);
  fit.residual_m = fitted(taken, &TurnMount::residual_m).value;
  fit.refusal = words_of_doubt(fit);
  return fit;
}

MountFit fit_of(const UnitTurns& unit, const MotionLog& motion, std::size_t fewest) {
  MountFit fit = fit_of(unit.mounts(), unit.turns(), motion, fewest);
  if (unit.is_other_way_up()) {
    fit.refusal = "the unit ";
    fit.refusal += kOtherWayUp;
  }
  return fit;
}

}  // namespace iog::tools
